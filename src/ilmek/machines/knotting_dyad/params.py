"""What may be asked of a knotting dyad."""

from dataclasses import dataclass
from typing import Any

from ilmek.errors import ParameterError
from ilmek.machines.text_lists import read_angles, read_points
from ilmek.params import Params, param
from ilmek.synthesis.burmester.constant_distance import require_task
from ilmek.units import deg, format_quantity, g, mm, ms


def _length(default: float | None, doc: str, symbol: str = "", at_most: float = 50 * mm) -> Any:
    return param(default, unit="mm", at_least=0.01 * mm, at_most=at_most, doc=doc, symbol=symbol)


def _most(default: float, unit: str, rate: str, of: str) -> Any:
    return param(default, unit=unit, above=0.0, at_most=1e9, doc=f"greatest {rate} of a {of}")


def _some(default: float, unit: str, at_most: float, doc: str) -> Any:
    return param(default, unit=unit, at_least=0.0, at_most=at_most, doc=doc)


@dataclass(frozen=True, slots=True)
class KnottingDyadParams(Params):
    """What may be asked of a knotting dyad: a knot, or four timed points of one's own."""

    knot: str = param("symmetric", choices=("symmetric", "asymmetric"), doc="knot to tie")
    opens: str = param("left", choices=("left", "right"), doc="side on which an asymmetric knot is open")
    warp_pitch: float = _length(2 * mm, "distance between two warps", "p")
    warp_diameter: float = _length(0.8 * mm, "diameter of a warp", "D")
    yarn_diameter: float = _length(0.8 * mm, "diameter of the pile yarn")
    opening: float = param(
        0.0,
        unit="mm",
        at_least=0.0,
        at_most=50 * mm,
        doc="by which a warp opener pushes the neighbours of the pair aside",
        symbol="o",
    )
    needle_diameter: float = _length(0.5 * mm, "diameter of the grippers where they pass between warps", "d")
    needle_breadth: float = _length(2 * mm, "breadth of the arms' needles, blades, along the warps")
    link_width: float = _length(4 * mm, "width of the links elsewhere")
    clearance: float = param(
        0.1 * mm,
        unit="mm",
        at_least=0.0,
        at_most=50 * mm,
        doc="asked between all that moves and the warps, and between the arms",
        symbol="c",
    )
    leg: float = _length(10 * mm, "height above the warps at which the ends are taken and left", "a", at_most=0.5)
    depth: float | None = param(
        None,
        unit="mm",
        at_least=0.01 * mm,
        at_most=0.5,
        doc="of the hand-over behind the warps; none: two pitches, more where the clearance asks for it",
        symbol="h",
    )
    pivot_room: float = _length(40 * mm, "least distance between the pivots of both arms, for their motors", at_most=2)
    bend_limit: float = param(
        30 * deg, unit="deg", at_least=1 * deg, below=90 * deg, doc="least angle between the links, off straight"
    )
    points: str | None = param(
        None, doc="four points to go through instead of the knot's, like (12mm,4mm) (18.5mm,9.5mm) …"
    )
    angles: str | None = param(None, doc="angles of the first link at these points, like 20deg 65deg …", symbol="θ1")
    link_limit: float = _length(150 * mm, "longest link that the machine has room for", at_most=5.0)
    joint_speed: float = _most(40.0, "rad/s", "speed", "joint")
    joint_acceleration: float = _most(2e3, "rad/s^2", "acceleration", "joint")
    joint_jerk: float = _most(2e5, "rad/s^3", "jerk", "joint")
    centre_speed: float = _most(2.0, "m/s", "speed", "centre gripper")
    centre_acceleration: float = _most(50.0, "m/s^2", "acceleration", "centre gripper")
    centre_jerk: float = _most(5e3, "m/s^3", "jerk", "centre gripper")
    grasp_time: float = _some(20 * ms, "ms", 10.0, "for a gripper to take an end")
    release_time: float = _some(10 * ms, "ms", 10.0, "for a gripper to let an end go")
    elbow_drive: str = param(
        "belt", choices=("belt", "direct"), doc="second link by a belt from the pivot, or by a servo in the elbow"
    )
    elbow_mass: float = _some(0.0, "g", 100.0, "mass in the elbow, such as a servo's")
    link_thickness: float = _length(3 * mm, "thickness of the links, across their plane")
    density: float = param(2700.0, unit="kg/m^3", above=0.0, at_most=1e5, doc="density of the links; aluminium")
    gripper_mass: float = _some(2 * g, "g", 10.0, "mass of the gripper in an arm's tip")
    yarn_pull: float = _some(0.5, "N", 1e4, "force of the yarn on a tip that leads it, against its motion")
    gravity: float = _some(9.81, "m/s^2", 1e3, "free fall, in the section's plane and away from the pile; 0: it lies")
    gear_ratio: float | None = param(
        None,
        above=0.0,
        at_most=1e4,
        doc="turns of a servo for one of its joint; unsaid: the least with which the smallest servo will do",
    )
    gear_efficiency: float = param(0.9, above=0.0, at_most=1.0, doc="efficiency of the gears", symbol="η")
    rotor_inertia: float = param(
        5e-6, unit="kg*m^2", at_least=0.0, at_most=1.0, doc="of a servo's rotor; 100 W classes have about 5e-6"
    )
    servo_overload: float = param(
        3.0, at_least=1.0, at_most=10.0, doc="short peaks of torque that a servo bears, over its lasting torque"
    )

    def check_together(self) -> None:
        """Points and angles go together, four of each; warps stand apart, and the hand-over behind them."""
        if (self.points is None) != (self.angles is None):
            said, unsaid = ("points", "angles") if self.angles is None else ("angles", "points")
            raise ParameterError(f"{said} are given without {unsaid}", allowed="both, or neither", do=f"set {unsaid}")
        if self.points is None or self.angles is None:
            self._check_section()
            return
        points, angles = read_points("points", self.points), read_angles("angles", self.angles)
        require_task("timed point", points, angles, 4, "knotting-dyad")

    def _check_section(self) -> None:
        if self.warp_pitch <= self.warp_diameter:
            raise ParameterError(
                f"warps of {format_quantity(self.warp_diameter, 'mm')} at a pitch of "
                f"{format_quantity(self.warp_pitch, 'mm')} touch each other",
                allowed=f"a pitch above {format_quantity(self.warp_diameter, 'mm')}",
                do="take a finer warp, or a wider pitch",
            )
        least = (self.warp_diameter + self.needle_diameter) / 2
        if self.leg < least + self.clearance:
            raise ParameterError(
                f"ends taken {format_quantity(self.leg, 'mm')} above the warps' axes are among the warps",
                allowed=f"a leg of {format_quantity(least + self.clearance, 'mm')} or more",
            )
        if self.depth is not None and self.depth < least:
            raise ParameterError(
                f"a hand-over {format_quantity(self.depth, 'mm')} behind the warps' axes is among the warps",
                allowed=f"a depth of {format_quantity(least, 'mm')} or more",
                do="leave depth out to have it chosen",
            )
