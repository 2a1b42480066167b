"""The twin behind the ports of the controller: `LoomPort` on `loom.twin.step`, by a clock or as fast as it goes.

`receive` runs the loom to the next instant with reports, and the loom's clock stands while the caller works: orders
sent before the next call begin at exactly that instant, at every speed. With a speed, `receive` waits until the
caller's clock has come as far; without, the loom goes from event to event.
"""

import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Protocol

from ilmek.errors import LoomError
from ilmek.loom.control.ports import ChangePackages, Done, EndRow, Order, PortReport, Sensors, Tie
from ilmek.loom.operations import LoomSetup, RowEnd
from ilmek.loom.twin.model import NO_FAULTS, FaultRates, plant_model
from ilmek.loom.twin.state import Act, Halt, PlantInput, PlantState, PowerOn, SetSpeed, next_instant, sensors_of
from ilmek.loom.twin.step import step
from ilmek.loom.twin.woven import Woven
from ilmek.units import BILLION

SLOWEST, FASTEST = 0.001, 1e6
"""Bounds of a speed: time of the loom over that of the caller."""

LARGEST_LAG = 1.0
"""Time that the loom makes up for after a caller who worked long [s]; what is beyond it is dropped."""


class Clock(Protocol):
    """The caller's clock, which never goes back."""

    def now(self) -> float:
        """Time [s], from any origin."""

    def wait(self, seconds: float, woken: threading.Event) -> None:
        """Wait for a time [s], or until the event is set."""


class MonotonicClock:
    """The clock of the system."""

    def now(self) -> float:
        """Time since the system's start [s]."""
        return time.monotonic()

    def wait(self, seconds: float, woken: threading.Event) -> None:
        """Wait for a time [s], or until the event is set."""
        woken.wait(seconds)


class TwinPort:
    """A simulated loom.

    woven   the carpet that it weaves, and the state that it starts in     speed  SLOWEST to FASTEST; None: no waiting
    rates   of random faults        record  is given every input with its time [ns], in order
    `act` may be called from any thread; all else from one. Raises LoomError for a speed out of bounds.
    """

    def __init__(
        self,
        setup: LoomSetup,
        woven: Woven,
        *,
        speed: float | None = None,
        rates: FaultRates = NO_FAULTS,
        clock: Clock | None = None,
        record: Callable[[int, PlantInput], None] | None = None,
    ) -> None:
        if speed is not None and not SLOWEST <= speed <= FASTEST:
            raise LoomError(f"speed {speed:g}x", allowed=f"{SLOWEST:g}x to {FASTEST:g}x, or max")
        self.plant = plant_model(setup, rates)
        self._state, self._woven, self._speed = woven.restored(self.plant), woven, speed
        self._clock, self._record = clock or MonotonicClock(), record
        self._inputs: list[PlantInput] = [PowerOn()]
        self._acts: deque[Act] = deque()
        self._woken = threading.Event()
        self._origin = self._clock.now(), self._state.time

    @property
    def state(self) -> PlantState:
        """State of the loom."""
        return self._state

    @property
    def time(self) -> int:
        """Time of the loom's clock [ns]."""
        return self._state.time

    def send(self, orders: Sequence[Order]) -> None:
        """Begin operations, at the loom's time. `receive` raises LoomError for one that the loom cannot carry out."""
        self._take_acts()
        self._inputs += orders

    def halt(self) -> None:
        """Bring every motion to a stop at once."""
        self._take_acts()
        self._inputs.append(Halt())

    def set_speed(self, factor: float) -> None:
        """Speed of the operations that begin from now on, as a fraction of the programme's, to a thousandth."""
        self._inputs.append(SetSpeed(round(1000 * factor)))

    def act(self, *acts: Act) -> None:
        """What an operator does, and faults: at the loom's time of the next `receive`, or in the one in progress."""
        self._acts.extend(acts)
        self._woken.set()

    def receive(self, timeout: float) -> tuple[PortReport, ...]:
        """What happens up to the next instant with a report, but no longer than a time [s] of the caller's clock.

        Without anything in progress it waits, so that a loop around it does not keep the processor busy.
        """
        self._take_acts()
        if self._inputs:
            found = self._step(self._state.time)
            if found:
                return found
        instant = next_instant(self._state)
        if self._speed is None:
            if instant is not None:
                return self._step(instant)
            self._wait(timeout)
            return ()
        return self._paced(self._speed, instant, timeout)

    def _paced(self, speed: float, instant: int | None, timeout: float) -> tuple[PortReport, ...]:
        now = self._clock.now()
        reached = self._reached(now, speed)
        if instant is None or instant > reached:
            ahead = timeout if instant is None else min(timeout, (instant - reached) / (BILLION * speed))
            self._wait(ahead)
            reached = self._reached(self._clock.now(), speed)
        until = reached if instant is None else min(instant, reached)
        return self._step(max(until, self._state.time))

    def _reached(self, now: float, speed: float) -> int:
        """The loom's time by the caller's clock; a long lag moves the origin."""
        begin, base = self._origin
        reached = base + int((now - begin) * speed * BILLION)
        if reached - self._state.time > LARGEST_LAG * speed * BILLION and next_instant(self._state) is not None:
            self._origin = now - LARGEST_LAG, self._state.time
            reached = self._state.time + int(LARGEST_LAG * speed * BILLION)
        return reached

    def _wait(self, seconds: float) -> None:
        self._clock.wait(max(seconds, 0.0), self._woken)
        self._woken.clear()  # the acts themselves are taken before the next wait

    def _take_acts(self) -> None:
        while self._acts:
            self._inputs.append(self._acts.popleft())

    def _step(self, until: int) -> tuple[PortReport, ...]:
        inputs, self._inputs = self._inputs, []
        if self._record is not None:
            for one in inputs:
                self._record(self._state.time, one)
        self._state, reports = step(self.plant, self._state, inputs, until - self._state.time)
        for report in reports:
            if type(report) is Done:
                self._weave(report)
        return reports

    def _weave(self, report: Done) -> None:
        order, state = report.order, self._state
        if type(order) is Tie:
            head = state.heads[order.head]
            self._woven.tie(order.row, order.column, head.condition.yarns[order.tube])
            self._woven.keep_knot(report.time, order.head, head)
        elif type(order) is EndRow:
            self._woven.end(order.row, order.operation)
            self._woven.keep(state)
        elif type(order) is ChangePackages:
            self._woven.keep(state)

    def sensors(self) -> Sensors:
        """What the sensors show now."""
        return sensors_of(self.plant, self._state)

    def knotted(self, row: int, column: int) -> bool | None:
        """Whether the sensor finds a knot on a warp pair; None: it cannot tell."""
        return self._answer("knotted", self._woven.times_tied(row, column) > 0)

    def ended(self, row: int, operation: RowEnd) -> bool | None:
        """Whether an operation after the knots of a row has been carried out; None: the sensor cannot tell."""
        return self._answer("ended", self._woven.times_ended(row, operation) > 0)

    def _answer(self, sensor: str, true: bool) -> bool | None:
        for fault in self._state.condition.faulty:
            if fault.sensor == sensor:
                return None if fault.value is None else bool(fault.value)
        return true
