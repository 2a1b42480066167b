"""Reducers: torque, efficiency, self-locking; stock ratios of planetary gears; classes of flanges, sizes of worm gears.

A reducer of ratio i and efficiency eta: M_motor = M_load / (i eta). With the same friction losses in back-driving,
eta_back = 2 - 1/eta, so a self-locking reducer (eta_back <= 0) has eta <= 1/2: a worm can be self-locking or efficient,
not both. Makers of worm gears rely on self-locking below 0.45 and call 0.45 to 0.55 uncertain, since friction changes
with speed, lubricant and temperature.                                           [inclined plane with friction; derived]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.report import Check, at_most
from ilmek.units import format_quantity, mm


@dataclass(frozen=True, slots=True)
class Reducer:
    """A speed reducer: ratio (input turns per output turn) and efficiency, above 0 and at most 1."""

    ratio: float
    efficiency: float

    def motor_torque(self, load_torque: float) -> float:
        """Torque at the input [N m] for a load torque at the output [N m]: M / (i eta)."""
        return load_torque / (self.ratio * self.efficiency)

    def input_torque(self, load_torque: RealField, speed: RealField) -> FloatArray:
        """Torque at the input [N m] for a torque [N m] and a speed [rad/s] at the output, broadcast.

        M / (i eta) where the motor drives, M eta_back / i where the load drives (negative for a self-locking reducer),
        and at rest M max(eta_back, 0) / i.
        """
        backwards = self.back_driving_efficiency
        power = np.multiply(load_torque, speed)
        factor = np.where(power > 0, 1 / self.efficiency, np.where(power < 0, backwards, max(backwards, 0.0)))
        return np.asarray(factor * load_torque / self.ratio)

    def output_torque(self, motor_torque: float) -> float:
        """Torque at the output [N m] for one at the input [N m]: M i eta."""
        return motor_torque * self.ratio * self.efficiency

    @property
    def back_driving_efficiency(self) -> float:
        """Efficiency with the load driving, 2 - 1/eta; 0 or less for a self-locking reducer."""
        return 2 - 1 / self.efficiency

    @property
    def kind(self) -> str:
        """What has such an efficiency: a worm locks itself."""
        return "worm reducer" if self.self_locking else "planetary reducer"

    @property
    def self_locking(self) -> bool:
        """Whether the load cannot drive it backwards: efficiency at most 1/2."""
        return self.back_driving_efficiency <= 0


DIRECT = Reducer(1.0, 1.0)

PLANETARY = tuple(
    Reducer(float(ratio), efficiency)
    for ratios, efficiency in (((3, 4, 5, 7, 10), 0.97), ((16, 20, 25, 35, 50, 70, 100), 0.94))
    for ratio in ratios
)
"""Stock planetary reducers of one and of two stages, with usual efficiencies."""


@dataclass(frozen=True, slots=True)
class ReducerFlange:
    """The side of a reducer's output up to a torque [N m]: face [m], circle of its screws [m], these by name, their
    number, mass of the reducer [kg].
    """

    torque: float
    face: float
    circle: float
    thread: str
    number: int
    mass: float

    @property
    def waist(self) -> float:
        """Diameter of the housing behind the flange, beside the heads of its screws [m]."""
        return self.circle - SOCKET_SCREWS[self.thread].sink - 2 * mm


REDUCER_FLANGES = tuple(
    ReducerFlange(torque, face * mm, circle * mm, thread, number, mass)
    for torque, face, circle, thread, number, mass in (
        (20.0, 40, 34, "M4", 4, 0.45),
        (50.0, 60, 52, "M5", 4, 1.1),
        (130.0, 80, 70, "M6", 4, 2.6),
        (290.0, 115, 100, "M10", 4, 8.0),
        (900.0, 160, 145, "M12", 4, 22.0),
        (2000.0, 200, 180, "M12", 4, 45.0),
        (5000.0, 280, 250, "M16", 6, 95.0),
        (9000.0, 340, 310, "M16", 6, 160.0),
        (14000.0, 450, 420, "M16", 6, 260.0),
    )
)
"""Classes of reducers of two and three stages, from the smallest; makers differ, in masses by a third. Those above
2,000 N m are industrial ones; their sizes and masses are assumed, and their screws hold the torque by friction."""


def flange_for(torque: float, face: float = 0.0, waist: float = 0.0) -> ReducerFlange:
    """The smallest class for a torque [N m] with a face and a waist of at least some sizes [m]; the largest where none
    is.

    >>> flange_for(100.0).face, flange_for(100.0, 0.1).thread
    (0.08, 'M10')
    """
    enough = (row for row in REDUCER_FLANGES if row.torque >= torque and row.face >= face - 1e-9)
    return next((row for row in enough if row.waist >= waist), REDUCER_FLANGES[-1])


def reducer_check(title: str, by: Reducer, motor_torque: float, load: float, part: str) -> Check:
    """The torque of a load on a reducer [N m] against that of its class, which bears its motor's too [N m]."""
    row = flange_for(max(by.output_torque(motor_torque), load))
    source = f"class with a flange of {format_quantity(row.face, 'mm')}; the largest is of 14 kNm"
    return at_most(f"torque of the {title}", load, row.torque, "Nm", source).with_cure(
        "set a lower tension, or a narrower loom", part
    )


@dataclass(frozen=True, slots=True)
class WormSize:
    """A size of worm reducers: its hollow shaft lies across the motor's, apart by the centre distance; in m and kg.

    centre  distance of both axes             torque, single  slow, of a last stage of 50:1, of 100:1 [N m]
    bore    largest of its hollow shaft       length   of that, beyond both covers
    motor   from its axis to the motor's      half     from its axis to the housing's sides along the worm and away
    top     beyond the worm                   cover    from the middle of its length to a cover
    pilot   diameter of the covers' pilots    circle   of the screws in a cover, of a thread
    arm     from its axis to the eye of its torque arm, of a screw      mass
    """

    centre: float
    torque: float
    single: float
    bore: float
    length: float
    motor: float
    half: float
    top: float
    cover: float
    pilot: float
    circle: float
    thread: str
    arm: float
    screw: str
    mass: float

    @property
    def name(self) -> str:
        """Its class, for people."""
        return f"size {self.centre / mm:g}"

    def holds(self, ratio: float) -> float:
        """Torque at the output [N m]: a ratio above `SINGLE` has a stage before a last one of 50:1."""
        return self.single if _LAST < ratio <= SINGLE else self.torque

    def first(self, ratio: float) -> "WormSize | None":
        """The size of the worm before it, above a ratio of `SINGLE`: makers join 63 to 130, 40 to 90."""
        return None if ratio <= SINGLE else next(row for row in WORM_SIZES if row.centre >= _FIRST * self.centre)


SINGLE, _LAST, _FIRST = 100.0, 50.0, 0.42
"""Largest ratio of a worm, ratio of the last of two stages, and centre distance of the first over that of the last."""

WORM_SIZES = tuple(
    WormSize(
        centre=centre * mm,
        torque=torque,
        single=single,
        bore=bore * mm,
        length=length * mm,
        motor=motor * mm,
        half=half * mm,
        top=top * mm,
        cover=cover * mm,
        pilot=pilot * mm,
        circle=circle * mm,
        thread=thread,
        arm=arm * mm,
        screw=screw,
        mass=mass,
    )
    for centre, torque, single, bore, length, motor, half, top, cover, pilot, circle, thread, arm, screw, mass in (
        (63, 145, 100, 28, 112, 95, 72, 102, 53, 80, 95, "M8", 150, "M8", 6.2),
        (75, 320, 230, 35, 120, 112.5, 86, 117, 57, 95, 115, "M8", 200, "M12", 9.0),
        (90, 560, 410, 38, 140, 129.5, 103, 133, 67, 110, 130, "M10", 200, "M12", 13.0),
        (110, 1000, 746, 42, 155, 160, 127.5, 167.5, 74, 130, 165, "M10", 250, "M16", 35.0),
        (130, 1550, 1100, 45, 170, 180, 147.5, 187.5, 81, 180, 215, "M12", 250, "M16", 48.0),
        (150, 2330, 1650, 50, 200, 210, 170, 230, 96, 180, 215, "M12", 250, "M16", 84.0),
        (185, 4400, 3100, 60, 247, 260, 210, 284, 118, 222, 265, "M16", 370, "M16", 158.0),
        (250, 10800, 7600, 110, 334, 350, 283, 384, 160, 300, 358, "M16", 445, "M16", 390.0),
        (315, 21000, 15000, 130, 420, 441, 357, 483, 202, 378, 450, "M16", 520, "M16", 780.0),
    )
)
"""Motovario's SW, sizes and masses by its catalogue; torques of its two-stage units at less than 1 rpm. Those above 150
are assumed: sizes by the centre distance, torques and masses by its cube. The arms above 150 are assumed too."""


def worm_for(torque: float, ratio: float, bore: float = 0.0) -> WormSize:
    """The smallest size for a torque [N m] with a hollow shaft of at least a bore [m]; the largest where none is.

    >>> worm_for(700.0, 100.0).name, worm_for(700.0, 150.0, 0.045).name
    ('size 110', 'size 130')
    """
    enough = (row for row in WORM_SIZES if row.holds(ratio) >= torque and row.bore >= bore - 1e-9)
    return next(enough, WORM_SIZES[-1])


def worm_check(title: str, row: WormSize, ratio: float, load: float, part: str) -> Check:
    """The torque of a load on a worm reducer [N m] against that of its size."""
    source = f"{row.name}, slow; the largest is of {format_quantity(WORM_SIZES[-1].holds(ratio), 'Nm')}"
    return at_most(f"torque of the {title}", load, row.holds(ratio), "Nm", source).with_cure(
        "set a lower tension, or a narrower loom", part
    )


RATIOS = (1.0, *(reducer.ratio for reducer in PLANETARY))
"""Gears to choose from: none, and the stock planetary ones of one and two stages."""
