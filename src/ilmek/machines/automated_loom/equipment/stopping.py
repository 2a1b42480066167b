"""How long a loom takes to stand after its guard is opened: the response of the safety circuit, and the slowest brake.

    T = t guard + t relay + t control + max v / a        over the axes, v greatest speed, a allowed deceleration

A controlled stop, category 1 of IEC 60204-1: each axis is braked as hard as it may be accelerated; the beat as hard as
its own motion is, the shedding cams in the time in which they stop for a beat.
"""

from ilmek.elements.field_devices import CONTROLLER, GRID, INTERLOCK, RELAY
from ilmek.machines.automated_loom.cyclogram import BEATER, HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.records import record
from ilmek.timing.track import peak_acceleration, peak_speed


@record
class StoppingTime:
    """Time of the circuit [s], and the slowest axis with its time to stand [s]."""

    circuit: float
    axis: str
    braking: float

    @property
    def whole(self) -> float:
        """From the opening of a door, or the release of a button, to the standstill [s]."""
        return self.circuit + self.braking


def stopping_time(loom: LoomDesign) -> StoppingTime:
    """The stopping time of a loom."""
    row, params, weft = loom.row_cyclogram, loom.params, loom.weft.params
    beater, carrier = row.track(BEATER), loom.row_timing.carrier
    times = {
        "shedding cams": params.shed_stop,
        carrier: peak_speed(row.track(carrier), row.period) / weft.acceleration,
        "beat": peak_speed(beater, row.period) / peak_acceleration(beater, row.period),
    }
    if loom.heads:
        carriage = loom.weaver.params
        times["heads' retreat"] = peak_speed(row.track(HEADS), row.period) / params.retreat_acceleration
        times["carriages"] = carriage.carriage_speed / carriage.carriage_acceleration
    guard = INTERLOCK if loom.heads else GRID
    axis = max(times, key=times.__getitem__)
    return StoppingTime(guard.response + RELAY.response + CONTROLLER.response, axis, times[axis])
