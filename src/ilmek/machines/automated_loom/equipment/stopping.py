"""How long a loom takes to stand after its guard is opened: the response of the safety circuit, and the slowest brake.

    T = t guard + t relay + t control + max v / a        over the axes, v greatest speed, a allowed deceleration

Where a hand may come near a body alone, the time is that of the axis of this body.

A controlled stop, category 1 of IEC 60204-1: each axis is braked as hard as it may be accelerated; the beat as hard as
its own motion is, the shedding cams in the time in which they stop for a beat.
"""

from collections.abc import Mapping

from ilmek.elements.field_devices import CONTROLLER, GRID, INTERLOCK, RELAY, FieldDevice
from ilmek.machines.automated_loom.cyclogram import BEATER, HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.beat import BeatDrive
from ilmek.machines.beat_up.design import BeatUp
from ilmek.records import record
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import peak_acceleration, peak_speed

BEAT, CARRIER = "beat", "carrier of the weft"
"""Names of axes."""


@record
class StoppingTime:
    """Time of the circuit [s], and the time of each axis to stand [s]."""

    circuit: float
    axes: Mapping[str, float]

    @property
    def axis(self) -> str:
        """The slowest axis."""
        return max(self.axes, key=self.axes.__getitem__)

    @property
    def braking(self) -> float:
        """Time of the slowest axis to stand [s]."""
        return self.axes[self.axis]

    def axis_of(self, body: str) -> str:
        """The axis that moves a body of the loom; the slowest one where it is not known."""
        return {"weft": CARRIER, "beat-up": BEAT, "hammer": BEAT}.get(body.partition("/")[0], self.axis)

    def of(self, body: str) -> float:
        """From the opening of the guard to the standstill of a body [s]."""
        return self.circuit + self.axes[self.axis_of(body)]

    @property
    def whole(self) -> float:
        """From the opening of a door, or the release of a button, to the standstill [s]."""
        return self.circuit + self.braking


def stopping_time(loom: LoomDesign) -> StoppingTime:
    """The stopping time of a loom."""
    row, params, weft = loom.row_cyclogram, loom.params, loom.weft.params
    carrier = loom.row_timing.carrier
    times = {
        "shedding cams": params.shed_stop,
        CARRIER: peak_speed(row.track(carrier), row.period) / weft.acceleration,
        BEAT: beat_stop(loom.beat, row),
    }
    if loom.heads:
        carriage = loom.weaver.params
        times["heads' retreat"] = peak_speed(row.track(HEADS), row.period) / params.retreat_acceleration
        times["carriages"] = carriage.carriage_speed / carriage.carriage_acceleration
    return StoppingTime(circuit_time(INTERLOCK if loom.heads else GRID), times)


def circuit_time(guard: FieldDevice) -> float:
    """Response of the safety circuit with a device of the guards [s]."""
    return guard.response + RELAY.response + CONTROLLER.response


def beat_stop(beat: BeatDrive, row: Cyclogram) -> float:
    """Time in which what beats stands, and the slide of a travelling beater [s]."""
    beater = row.track(BEATER)
    stops = peak_speed(beater, row.period) / peak_acceleration(beater, row.period)
    if not isinstance(beat.design, BeatUp):
        return stops
    across = beat.use.travel
    return max(stops, float(across.step.speed / across.params.acceleration))
