"""What a machine consists of and what it works: lines of a parts list, and work of its acts."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

from ilmek.records import value_record

NOT_WEIGHED = math.nan


@dataclass(frozen=True, slots=True)
class ProcessStep:
    """A step in the making of a piece: its material, or a process, with what its price depends on.

    kind    of material or process                 mass      bought, or treated [kg]
    length  cut or joined [m]                      area      cut, finished or coated [m²]
    volume  removed [m³]                           features  piercings, bores, folds
    """

    kind: str
    mass: float = 0.0
    length: float = 0.0
    area: float = 0.0
    volume: float = 0.0
    features: int = 0


class Joints(NamedTuple):
    """Joints to fit: pins, slides, and contacts (cams, rolling, screws, transmissions)."""

    pins: float = 0.0
    slides: float = 0.0
    contacts: float = 0.0


@value_record
class BillLine:
    """A line of a parts list.

    kind    by which it is priced                  mass    of one [kg]; nan: not weighed
    length  of one [m], power  of one [W]: where its price depends on them
    drives  how many drive an axis together; 0: none           part    id of the part in the machine's tree; "": in none
    steps   in the making of one; none: it is bought           joints  of the bodies that it leads, for one of it
    """

    name: str
    number: int
    description: str
    material: str
    kind: str
    mass: float = NOT_WEIGHED
    length: float = 0.0
    power: float = 0.0
    drives: int = 0
    part: str = ""
    steps: tuple[ProcessStep, ...] = field(default=(), repr=False)
    joints: Joints = field(default=Joints(), repr=False)

    @property
    def mass_all(self) -> float:
        """Mass of all of them [kg], 0 where they are not weighed."""
        return 0.0 if math.isnan(self.mass) else self.number * self.mass


@dataclass(frozen=True, slots=True)
class Work:
    """Work of one act at its drive.

    name    of the share of the energy, `shedding`
    energy  of one act [J]
    per     what the act is done for: knot, colour change, row, beat, pass, carpet
    """

    name: str
    energy: float
    per: str
