"""A picture on a tufting machine: time, yarn, cost, and whether the programme tufts the picture.

    t = strokes 2 pi / (w u)        w speed of the main shaft, u share of the time for which it runs

The cost is that of a carpet alone on the machine, its needles threaded anew, by the formulas of the loom's carpets.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float, UInt8
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.machines.tufting_machine.layout import layout
from ilmek.machines.tufting_machine.price import tufting_price
from ilmek.records import JsonObject, computed, record
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm, turn
from ilmek.weaving.tufting.programme import BARE, TuftProgramme
from ilmek.weaving.tufting.twin import TuftedFace
from ilmek.weaving.tufts import Cone

FLAT = 0.1 * mm
"""Allowed deviation of a loop that is seen from the height of the pile; assumed by this project."""


@record
class TuftedPicture:
    """A programme, what the twin tufts by it, and the machine.

    labels   colour that each place is to have, row 0 at the top; BARE: none      cones  by the number of each colour
    heights  of the loops of each place [m], (rows, columns)
    knotted  the cost of the same carpet on the loom, its yarn included; None: not known
    deadline for the whole carpet [s]
    """

    machine: TuftingMachine
    programme: TuftProgramme
    face: TuftedFace
    labels: UInt8[np.ndarray, "rows columns"]
    heights: Float[np.ndarray, "rows columns"]
    cones: tuple[Cone, ...]
    knotted: float | None
    deadline: float | None

    needle_strokes = computed("1", "strokes of the needles", lambda it: int(it.programme.shifts.size))
    loops = computed("1", "loops of all needles, those that are hidden too", lambda it: it.face.loops)
    misplaced = computed("1", "tufts that are not one loop of their colour in sight", lambda it: it.wrong)
    tufted_yarn = computed("m", "yarn of the whole carpet", lambda it: float(it.face.yarn.sum()))
    tufted_yarn_mass = computed("kg", "its mass", lambda it: sum(it.masses))
    tufted_mass_per_area = computed("g/m^2", "its mass over the carpet's area", lambda it: sum(it.masses) / it.area)
    tufting_time = computed("h", "time on the machine, with the share in which it runs", lambda it: it.time)
    tufting_production = computed("m^2/h", "carpet over that time", lambda it: it.area / it.time)

    @computed("", "tufts and yarn of each colour, in the order of the creel")
    def tufting_colours(self) -> list[JsonObject]:
        """Name, tufts, yarn [m], mass [kg], price."""
        tufts = np.bincount(self.labels[self.labels != BARE], minlength=len(self.cones)).tolist()
        columns = zip(self.cones, tufts, self.face.yarn.tolist(), self.masses, strict=True)
        return [
            {"name": cone.name, "tufts": number, "yarn": yarn, "mass": mass, "price": cone.price_of(mass)}
            for cone, number, yarn, mass in columns
        ]

    @computed("", "cost of the carpet by cause, their sum, and beside it the same carpet knotted on a loom")
    def tufting_cost(self) -> Mapping[str, float | None]:
        prices = [cone.price_of(mass) for cone, mass in zip(self.cones, self.masses, strict=True)]
        known = [price for price in prices if price is not None]
        yarn = sum(known) if len(known) == len(prices) else None
        shares: dict[str, float] = self.cost.cost_shares
        whole = None if yarn is None else yarn + sum(shares.values())
        return {"yarn": yarn, **shares, "sum": whole, "knotted": self.knotted}

    @property
    def cost(self) -> CarpetCost:
        """The cost on the machine, without yarn."""
        machine, params, laid = self.machine, self.machine.params, layout(self.machine)
        power = float(np.mean(machine.shafts.torque)) * params.needle.speed
        aisle, (first, last) = 2 * params.cost.aisle, laid.ends
        return CarpetCost(
            rates=params.cost,
            knots=int(np.count_nonzero(self.labels != BARE)),
            area=self.area,
            time=self.time,
            energy=power * self.time * params.running,
            dressing=params.pattern.threading * self.programme.threads.size,
            floor=(last - first + aisle) * (laid.front - laid.rear + aisle),
            machine=tufting_price(machine).cost,
        )

    @property
    def area(self) -> float:
        """Area of the carpet [m²]."""
        grid = self.programme.grid
        return self.labels.size * grid.gauge * grid.stitch

    @property
    def time(self) -> float:
        """Time on the machine [s]."""
        params = self.machine.params
        return self.programme.shifts.size * turn / params.needle.speed / params.running

    @property
    def masses(self) -> list[float]:
        """Mass of the yarn of each colour [kg]."""
        return [length * self.machine.params.yarn_density for length in self.face.yarn.tolist()]

    @property
    def wrong(self) -> int:
        """Places without one loop of their colour in sight, and those with one that are to have none."""
        return int(np.count_nonzero((self.face.colours != self.labels) | (self.face.number != (self.labels != BARE))))

    @property
    def checks(self) -> tuple[Check, ...]:
        """Each tuft in its colour, the height of the pile, deadline."""
        low, source = self.programme.grid.low, "twin of the machine, by the programme"
        apart = float(np.nanmax(abs(self.face.heights - self.heights), initial=0.0))
        checks = (
            at_most("tufts off their colour", self.wrong, 0, "1", source).with_cure("set a lower pattern.hidden"),
            at_most("pile off its height", apart, FLAT, "mm", source).with_cure("set a higher pile_height"),
            at_least("pile over the hidden loops", low - self.face.hidden, low / 2, "mm", source).with_cure(
                "set a lower pattern.hidden"
            ),
        )
        if self.deadline is None:
            return checks
        late = at_most("tufting time", self.time, self.deadline, "h", "deadline")
        return (*checks, late.with_cure("set a higher needle.speed, or take fewer colours"))
