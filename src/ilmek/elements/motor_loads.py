"""What a motor draws by its kind and power, and the fuse, the amplifier and the wires that bear it.

    servo     up to 2 kW amplifier between a phase and N, 230 V, above on three phases, 400 V;
              drawn I = P / (U e), P / (sqrt(3) U e);    in each winding I = P / (sqrt(3) U e)
    stepper   I = P / (U e),  U 48 V      solenoid  alike, U 24 V

e is efficiency times power factor, 0.75; all assumed by this project.
"""

import math
from dataclasses import dataclass

from ilmek.elements.cabinet_devices import Fuse, fuse_of
from ilmek.elements.field_devices import AMPLIFIERS
from ilmek.elements.motors import STEPPER
from ilmek.elements.wiring import fuse_for, section_for

MAINS, PHASE, STEPPER_VOLTS, CONTROL_VOLTS, EFFICIENCY = 400.0, 230.0, 48.0, 24.0, 0.75

SOLENOID = "solenoid"

_DIRECT, _PHASES = {STEPPER: STEPPER_VOLTS, SOLENOID: CONTROL_VOLTS}, {STEPPER: 2, SOLENOID: 1}

_MOST_OF_A_PHASE = 2000.0
"""Power of a servo whose amplifier a single phase feeds [W], at most: usual series."""


@dataclass(frozen=True, slots=True)
class MotorLoad:
    """A motor: its kind, rated power [W]."""

    kind: str
    power: float

    @property
    def volts(self) -> float:
        """Of what feeds its amplifier [V]."""
        return _DIRECT.get(self.kind) or (PHASE if self.power <= _MOST_OF_A_PHASE else MAINS)

    @property
    def poles(self) -> int:
        """Fused poles of its amplifier's feed."""
        return 3 if self.volts == MAINS else 1

    @property
    def apparent(self) -> float:
        """Power that its amplifier draws [VA]."""
        return self.power if self.kind == SOLENOID else self.power / EFFICIENCY

    @property
    def drawn(self) -> float:
        """Current that its amplifier draws [A]."""
        return self.apparent / (self.volts * (math.sqrt(3) if self.poles == 3 else 1.0))

    @property
    def current(self) -> float:
        """Current of its windings at the rated power [A]."""
        return self.drawn if self.kind in _DIRECT else self.apparent / (math.sqrt(3) * self.volts)

    @property
    def fuse(self) -> float:
        """Rating of its fuse [A]."""
        return fuse_for(self.drawn)

    @property
    def fused(self) -> Fuse:
        """The fuse of each of its poles."""
        return fuse_of(self.fuse, self.volts)

    @property
    def phases(self) -> int:
        """Phases of its windings."""
        return _PHASES.get(self.kind, 3)

    @property
    def wires(self) -> int:
        """Wires of its cable: both ends of each winding on direct current, or three phases; and the protective one."""
        return {1: 2, 2: 4, 3: 3}[self.phases] + 1

    @property
    def amplifier(self) -> float:
        """Rated current of its amplifier [A]; nan above the series."""
        return next((rated for rated in AMPLIFIERS if rated >= self.current), math.nan)

    @property
    def loss(self) -> float:
        """Heat of its amplifier in the cabinet [W]: at rest, and a share of its power; assumed by this project."""
        return _AT_REST + _LOST * self.power

    def section(self, together: int = 1) -> float:
        """Section of its wires [mm²], of so many cables that lie together."""
        return section_for(self.fuse, together)


_AT_REST, _LOST = 5.0, 0.03
