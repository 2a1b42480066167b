"""Parameters of a knotting dyad."""

from dataclasses import dataclass
from typing import Any

from ilmek.errors import ParameterError
from ilmek.machines.knotting_dyad.strength import ArmStrengthParams
from ilmek.params import Params, kind, nested
from ilmek.params.text_lists import read_angles, read_points
from ilmek.synthesis.burmester.constant_distance import require_task
from ilmek.units import deg, format_quantity, mm, ms
from ilmek.weaving.cloth import Cloth


def _size(default: float | None, doc: str, symbol: str = "", at_most: float = 50 * mm) -> Any:
    return kind.length(default, at_least=0.01 * mm, at_most=at_most, doc=doc, symbol=symbol)


@dataclass(frozen=True, slots=True)
class ArmRoom(Params):
    """Where a head has room for what drives its arms."""

    level: float = _size(
        32 * mm, "from the needles' middle to the plate that bears the arms, along the warps", at_most=0.5
    )
    face: float | None = _size(
        None, "from the warps' axes to the face that carries this plate; default: behind the links", at_most=0.5
    )
    depth: float = _size(160 * mm, "from the warps' axes to the servos of the first links", at_most=1.0)
    below: float = _size(
        16 * mm, "from the needles' middle to the solenoids of the arms' jaws, along the warps", at_most=0.5
    )
    aside: float = _size(23 * mm, "from the middle of the pair to the servos", at_most=0.5)
    plates: float | None = _size(
        None, "from the sides of a warp opener's plates to the elbows, which pass them; default: no plates", at_most=0.5
    )


@dataclass(frozen=True, slots=True)
class KnottingDyadParams(Params):
    """The knot, or four timed points; the section, the links, the drives and their limits."""

    knot: str = kind.choice("symmetric", ("symmetric", "asymmetric"), doc="knot to tie")
    opens: str = kind.choice("left", ("left", "right"), doc="side on which an asymmetric knot is open")
    cloth: Cloth = nested(Cloth, doc="warps and pile yarn")
    opening: float | None = kind.length(
        None,
        at_least=0.0,
        at_most=50 * mm,
        doc="by which a warp opener widens the gaps beside the pair; default: room for needle and yarn",
        symbol="o",
    )
    pair_opened: float | None = kind.length(
        None,
        above=0.0,
        at_most=50 * mm,
        doc="the pair of warps in the opener's slots; default: the pitch, or room for needle and yarn",
    )
    needle_diameter: float = _size(0.5 * mm, "diameter of the grippers where they pass between warps", "d")
    needle_breadth: float = _size(2 * mm, "breadth of the arms' needles, blades, along the warps")
    link_width: float = _size(4 * mm, "width of the links elsewhere")
    clearance: float = kind.length(
        0.1 * mm,
        at_least=0.0,
        at_most=50 * mm,
        doc="required between all that moves and the warps, and between the arms",
        symbol="c",
    )
    leg: float = _size(10 * mm, "height above the warps at which the ends are taken and left", "a", at_most=0.5)
    depth: float | None = _size(
        None, "of the hand-over behind the warps; default: two pitches, more for the clearance", "h", at_most=0.5
    )
    pivot_room: float = _size(40 * mm, "least distance between the pivots of both arms, for their motors", at_most=2)
    bend_limit: float = kind.angle(
        30 * deg, at_least=1 * deg, below=90 * deg, doc="least angle of the links off straight"
    )
    points: str | None = kind.text(None, doc="four points instead of the knot's, like (12mm,4mm) (18.5mm,9.5mm) …")
    angles: str | None = kind.text(None, doc="angles of the first link at these points: 20deg 65deg …", symbol="θ1")
    link_limit: float = _size(150 * mm, "longest link that the machine has room for", at_most=5.0)
    joint_speed: float = kind.angular_speed(40.0, unit="rad/s", above=0.0, at_most=1e9, doc="greatest speed of a joint")
    joint_acceleration: float = kind.angular_acceleration(
        2e3, above=0.0, at_most=1e9, doc="greatest acceleration of a joint"
    )
    joint_jerk: float = kind.angular_jerk(2e5, above=0.0, at_most=1e9, doc="greatest jerk of a joint")
    centre_speed: float = kind.speed(2.0, above=0.0, at_most=1e9, doc="greatest speed of the centre gripper")
    centre_acceleration: float = kind.acceleration(
        50.0, above=0.0, at_most=1e9, doc="greatest acceleration of the same"
    )
    centre_jerk: float = kind.jerk(5e3, above=0.0, at_most=1e9, doc="greatest jerk of the same")
    grasp_time: float = kind.time(20 * ms, unit="ms", at_least=0.0, at_most=10.0, doc="time of a grasp")
    release_time: float = kind.time(10 * ms, unit="ms", at_least=0.0, at_most=10.0, doc="time of a release")
    elbow_drive: str = kind.choice(
        "belt", ("belt", "direct"), doc="second link by a belt from the pivot, or by a servo in the elbow"
    )
    elbow_mass: float = kind.mass(
        0.0, unit="g", at_least=0.0, at_most=100.0, doc="mass in the elbow, such as a servo's"
    )
    link_thickness: float = _size(3 * mm, "thickness of the links, across their plane")
    strength: ArmStrengthParams = nested(ArmStrengthParams, doc="what the links and joints of the arms bear")
    density: float = kind.density(2700.0, above=0.0, at_most=1e5, doc="density of the links; aluminium")
    grip_safety: float = kind.ratio(1.5, at_least=1.0, at_most=10.0, doc="grip of the jaws over the yarn's pull")
    tail: float = kind.length(2 * mm, at_least=0.0, at_most=0.05, doc="yarn held in a gripper, each end")
    buckling_safety: float = kind.ratio(
        3.0, at_least=1.0, at_most=100.0, doc="load under which a needle buckles, over the yarn's pull, at least"
    )
    yarn_pull: float = kind.force(0.5, at_least=0.0, at_most=1e4, doc="force of the yarn against the tip that leads it")
    gravity: float = kind.acceleration(
        9.81, at_least=0.0, at_most=1e3, doc="gravity, in the section's plane and away from the pile; 0: horizontal"
    )
    room: ArmRoom = nested(ArmRoom, doc="room for the drives of the arms")
    gear_ratio: float | None = kind.ratio(
        None,
        above=0.0,
        at_most=1e4,
        doc="turns of a servo for one of its joint; default: the least with which the smallest servo is enough",
    )
    gear_efficiency: float = kind.ratio(0.9, above=0.0, at_most=1.0, doc="efficiency of the gears", symbol="η")
    rotor_inertia: float = kind.inertia(5e-6, at_least=0.0, at_most=1.0, doc="of the rotor; 100 W servos: about 5e-6")
    servo_overload: float = kind.ratio(
        3.0, at_least=1.0, at_most=10.0, doc="short peaks of torque that a servo bears, over its continuous torque"
    )

    def check_together(self) -> None:
        """Points and angles go together, four of each; warps stand apart, and the hand-over behind them."""
        if (self.points is None) != (self.angles is None):
            given, missing = ("points", "angles") if self.angles is None else ("angles", "points")
            raise ParameterError(
                f"{given} are given without {missing}", allowed="both, or neither", do=f"set {missing}"
            )
        if self.points is None or self.angles is None:
            self._check_section()
            return
        points, angles = read_points("points", self.points), read_angles("angles", self.angles)
        require_task("timed point", points, angles, 4, "knotting-dyad")

    @property
    def warp(self) -> float:
        """Diameter of a warp [m]."""
        return self.cloth.carpet_yarns.warp.diameter

    @property
    def yarn(self) -> float:
        """Diameter of the pile yarn [m]."""
        return self.cloth.carpet_yarns.pile.diameter

    @property
    def pressed(self) -> float:
        """Thickness of the pile yarn pressed beside a needle [m]."""
        return self.cloth.carpet_yarns.pressed

    def _check_section(self) -> None:
        least = (self.warp + self.needle_diameter) / 2
        if self.leg < least + self.clearance:
            given = f"ends taken {format_quantity(self.leg, 'mm')} above the warps' axes are among the warps"
            raise ParameterError(given, allowed=f"a leg of {format_quantity(least + self.clearance, 'mm')} or more")
        if self.depth is not None and self.depth < least:
            given = f"a hand-over {format_quantity(self.depth, 'mm')} behind the warps' axes is among the warps"
            allowed = f"a depth of {format_quantity(least, 'mm')} or more"
            raise ParameterError(given, allowed=allowed, do="leave depth out to have it chosen")
