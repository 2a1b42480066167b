"""What a machine consists of and what it works: lines of a parts list, and work of its acts."""

import math
from dataclasses import dataclass

NOT_WEIGHED = math.nan


@dataclass(frozen=True, slots=True)
class BillLine:
    """A line of a parts list.

    kind    by which it is priced                  mass    of one [kg]; nan: not weighed
    length  of one [m], power  of one [W]: where its price depends on them
    drives  how many drive an axis together; 0: none           part    id of the part in the machine's tree; "": in none
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
