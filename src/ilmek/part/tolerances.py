"""What the features of made parts must hold: sizes with their fits, form and position, surfaces; each with its reason.

A feature is a cylinder or a plane of a part's shape that meets one of another part, as the joints of the tree say. Its
fit is that of the pair, and both parts read it from there; no part types it a second time.
"""

from enum import StrEnum

from ilmek.part.placement import Placement
from ilmek.records import record


class FeatureKind(StrEnum):
    """What a feature is."""

    BORE = "bore"
    JOURNAL = "journal"
    THREAD = "thread"
    SHAFT_KEYWAY = "keyway of a shaft"
    HUB_KEYWAY = "keyway of a hub"
    FACE = "face"


class Characteristic(StrEnum):
    """What a geometric tolerance limits: ISO 1101."""

    FLATNESS = "flatness"
    CYLINDRICITY = "cylindricity"
    PERPENDICULARITY = "perpendicularity"
    POSITION = "position"
    RUN_OUT = "circular run-out"
    TOTAL_RUN_OUT = "total run-out"


@record
class GeometricTolerance:
    """A tolerance of form, orientation, position or run-out.

    value      width or diameter of its zone [m]          round   the zone is a cylinder: its value is a diameter
    datums     letters of the datums, the first one first
    reason     why it is needed: the bearing, the joint, the check
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
    position  of a cylinder: where it begins, z along its axis into it; of a keyway: its floor's middle, z out of the
              floor, x along it; of a face: a point on it, z out of the part; in the part's own axes
    length    along the axis, or of a keyway [m]; 0: of a face
    nominal   diameter of a cylinder or thread, width of a keyway [m]; 0: of a face
    tolerance class by ISO 286, `H7`, or of a thread by ISO 965, `6H`; empty: none
    lower, upper  limit deviations of the nominal size [m]
    depth     of a keyway: from the opposite side of the shaft or bore to its floor (d - t1, d + t2) [m]; else 0
    depth_lower, depth_upper   limit deviations of the depth [m]
    roughness  Ra [m]: ISO 21920
    datum     letter, where other features are measured from it      geometric  its tolerances of form and position
    mates     ids of the parts that meet it       reason  the joint by which it does, for people
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
    depth: float = 0.0
    depth_lower: float = 0.0
    depth_upper: float = 0.0
    datum: str = ""
    geometric: tuple[GeometricTolerance, ...] = ()
    mates: tuple[str, ...] = ()
    reason: str = ""
