"""What a feature of a made part must hold: size with its class, form and position, surface; each with its reason.

They follow from what meets in the joints of a tree: `tolerancing`.
"""

import math
from enum import StrEnum

from ilmek.part.placement import Placement
from ilmek.records import record
from ilmek.units import format_quantity, mm, um

GROOVE_SHARE, GROOVE_STEP = 0.05, 0.05 * mm
"""Allowed error of the position of a groove in a row over their pitch, and its step [m]; assumed by this project."""


def groove_tolerance(pitch: float) -> float:
    """Tolerance ± of the middle of each groove of a row from the end of the part [m]: errors do not add up.

    >>> round(groove_tolerance(2e-3), 9), round(groove_tolerance(4e-3), 9)
    (0.0001, 0.0002)
    """
    return max(math.floor(GROOVE_SHARE * pitch / GROOVE_STEP + 1e-9), 1) * GROOVE_STEP


class FeatureKind(StrEnum):
    """What a feature is."""

    BORE = "bore"
    JOURNAL = "journal"
    SQUARE_BORE = "square bore"
    SQUARE = "square"
    THREAD = "thread"
    OUTER_THREAD = "outer thread"
    SHAFT_KEYWAY = "shaft keyway"
    HUB_KEYWAY = "hub keyway"
    FACE = "face"


class FitDuty(StrEnum):
    """What a feature does on what it meets."""

    HOUSING = "seat of a rolling bearing's outer ring"
    BEARING = "seat of a rolling bearing's inner ring"
    RUNNING = "runs"
    KEYED = "carries a hub with a key"
    FIXED = "is fixed"
    SCREWED = "takes a screw or a nut"
    GUIDING = "seats a guide"
    SLIDING = "slides on a face"
    ROLLING = "rolls on a track"
    TRACK = "has a track"


class Characteristic(StrEnum):
    """What a geometric tolerance limits: ISO 1101."""

    FLATNESS = "flatness"
    CYLINDRICITY = "cylindricity"
    POSITION = "position"
    RUN_OUT = "circular run-out"
    TOTAL_RUN_OUT = "total run-out"


@record
class GeometricTolerance:
    """A tolerance of form, orientation, position or run-out.

    value      width or diameter of its zone [m]          round   the zone is a cylinder: its value is a diameter
    datums     letters of the datums, the first one first; two letters with a dash are one common axis: `A-B`
    reason     why it is needed
    """

    characteristic: Characteristic
    value: float
    datums: tuple[str, ...] = ()
    round: bool = False
    reason: str = ""


@record
class ToleratedFeature:
    """A feature of a part, with all that it must hold.

    part      id of its part          name   unique on it: `bore-1`
    position  in the part's own axes: where a cylinder or square begins, z along its axis into it; of a keyway the same
              of its bore or shaft, x out of the axis through the middle of the keyway; of a face the middle of what
              sits on it, z out of the part
    length    along the axis [m]; of a face 0
    nominal   diameter, width across flats, width of a keyway, length of what sits on a face [m]
    tolerance class by ISO 286, `H7`, or of a thread by ISO 965, `6H`, `× 2 - 6g`; of a face none
    lower, upper  limit deviations of the nominal size [m]; of a thread those of ISO 965, here 0
    depth     of a keyway: from the opposite side of the shaft or bore to its floor, d - t1 or d + t2 [m]; else 0
    depth_lower, depth_upper   limit deviations of the depth [m]
    roughness  Ra [m]: ISO 21920
    datum     letter, where other features are measured from it      geometric  its tolerances of form and position
    duty      what it does          mates     ids of the parts that meet it
    joint     id of the body that moves in it, or that it is fixed in; empty: its mate is not in the tree
    """

    part: str
    name: str
    kind: FeatureKind
    position: Placement
    length: float
    nominal: float
    tolerance: str
    lower: float
    upper: float
    roughness: float
    duty: FitDuty
    depth: float = 0.0
    depth_lower: float = 0.0
    depth_upper: float = 0.0
    datum: str = ""
    geometric: tuple[GeometricTolerance, ...] = ()
    mates: tuple[str, ...] = ()
    joint: str = ""

    @property
    def label(self) -> str:
        """Size, class and limits in one line: `bore 25 mm H7, 0 to 21 um`."""
        text = f"{self.kind} {format_quantity(self.nominal, 'mm')} {self.tolerance}"
        limits = f", {_microns(self.lower)} to {_microns(self.upper)} um" if self.lower or self.upper else ""
        deep = f", {format_quantity(self.depth, 'mm')} across" if self.depth else ""
        return f"{text}{limits}{deep}"

    @property
    def reason(self) -> str:
        """Why it must hold this: what it does, and with what."""
        return " ".join((self.duty.value, *(f"[{name}]" for name in self.mates[:1])))


def _microns(deviation: float) -> str:
    return f"{deviation / um:+.3g}" if deviation else "0"
