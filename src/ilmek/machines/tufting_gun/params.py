"""Parameters of a tufting gun on a gantry: rows, yarn, gun, gantry, costs; values assumed by this project."""

from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.params import Params, kind, param
from ilmek.units import deg, format_quantity, g, hour, m, mm, turn

LOWEST, TALLEST = 1 * mm, 60 * mm
"""Bounds of the height of a pile; assumed by this project."""


@dataclass(frozen=True, slots=True)
class TuftingGunParams(Params):
    """Rows and yarn of the carpet, gun, gantry, and what they cost; values assumed by this project."""

    row_spacing: float = kind.length(
        3 * mm, at_least=1 * mm, at_most=20 * mm, doc="distance of the rows, and the width that one covers"
    )
    smallest: float | None = kind.length(
        None, at_least=1 * mm, at_most=0.2, doc="smallest feature that is tufted; default: 5/3 of row_spacing"
    )
    stitch: float = kind.length(3 * mm, at_least=0.5 * mm, at_most=20 * mm, doc="distance of the stitches in a row")
    pile_height: float = kind.length(10 * mm, at_least=LOWEST, at_most=TALLEST, doc="height of the pile")
    backing_thickness: float = kind.length(0.5 * mm, at_least=0.0, at_most=5 * mm, doc="thickness of the backing")
    yarn_density: float = kind.line_density(
        1.0 * g / m, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of all yarn in the needle"
    )
    waste: float = kind.length(30 * mm, at_least=0.0, at_most=1.0, doc="yarn cut off at each end of a stroke")
    cones: int = kind.count(12, at_least=1, at_most=255, doc="colours that the creel holds")
    stitch_rate: float = param(20.0, unit="1/s", above=0.0, at_most=100.0, doc="stitches of the gun in a second")
    travel_speed: float = kind.speed(0.5, above=0.0, at_most=5.0, doc="speed with the gun lifted")
    acceleration: float = kind.acceleration(2.0, above=0.0, at_most=50.0, doc="acceleration of the gantry")
    turning_speed: float = kind.angular_speed(turn, unit="rpm", above=0.0, at_most=10 * turn, doc="gun about its axis")
    corner: float = kind.angle(
        30 * deg, at_least=1 * deg, at_most=180 * deg, doc="turn of the path beyond which the gun stops to turn"
    )
    lift: float = kind.length(25 * mm, at_least=1 * mm, at_most=0.3, doc="lift of the gun between strokes")
    lift_time: float = kind.time(0.4, at_least=0.0, at_most=60.0, doc="lift and lowering, with the start of the gun")
    change_time: float = kind.time(90.0, at_least=0.0, at_most=3600.0, doc="threading of another colour")
    room_width: float = kind.length(2.2, unit="m", at_least=0.1, at_most=20.0, doc="travel of the gantry, across")
    room_length: float = kind.length(3.2, unit="m", at_least=0.1, at_most=20.0, doc="travel of the gantry, along")
    most_lost: float = kind.ratio(
        0.1, unit="%", at_least=0.0, at_most=1.0, doc="largest share of the picture finer than smallest that is lost"
    )
    least_coverage: float = kind.ratio(0.99, unit="%", at_least=0.0, at_most=1.0, doc="share of each region to cover")
    least_covered: float = kind.ratio(0.97, unit="%", at_least=0.0, at_most=1.0, doc="share of the carpet to cover")
    backing_price: float = kind.ratio(6.0, at_least=0.0, at_most=1e4, doc="price of a square metre of backing [EUR]")
    machine_rate: float = param(
        4 / hour, unit="1/h", at_least=0.0, at_most=1.0, doc="cost of an hour of gun and gantry [EUR]"
    )
    wage: float = param(8 / hour, unit="1/h", at_least=0.0, at_most=1.0, doc="cost of an hour of a person [EUR]")
    attendance: float = kind.ratio(0.5, unit="%", at_least=0.0, at_most=1.0, doc="share of the time of a person")

    @property
    def feature(self) -> float:
        """Smallest feature that is tufted [m]."""
        return self.row_spacing * 5 / 3 if self.smallest is None else self.smallest

    @property
    def feed(self) -> float:
        """Speed of the gun while it tufts [m/s]."""
        return self.stitch * self.stitch_rate

    def check_together(self) -> None:
        """Raise ParameterError for a smallest feature narrower than a row."""
        if self.feature < self.row_spacing:
            given = f"smallest={format_quantity(self.feature, 'mm')}"
            allowed = f"at least row_spacing={format_quantity(self.row_spacing, 'mm')}: one row is as wide"
            raise ParameterError(given, allowed=allowed, do="set a larger smallest, or a smaller row_spacing")
