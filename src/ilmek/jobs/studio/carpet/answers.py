"""Requests and answers of the carpet's view: plain data."""

from dataclasses import dataclass, field

from ilmek.carpet.bill import YarnNeed
from ilmek.jobs.studio.checks import ShownCheck
from ilmek.records import JsonObject

RECIPE = "carpet.toml"
"""The recipe of a project."""

MOST_MERGED = 3
"""Colours that are named beside one with the same yarn."""


@dataclass(frozen=True, eq=False, slots=True)
class ChartRequest:
    """A chart of a recipe.

    recipe  data of the recipe, saved or not      path  of its file in the project
    draft   quick, while a slider moves: colours of a large photo are rounded before their yarns are chosen
    source  key of the fitted picture that the caller has: it is not sent again
    """

    recipe: JsonObject
    path: str = RECIPE
    draft: bool = False
    source: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class ProposalRequest:
    """Shades that suit the picture of a recipe best: at most `count`."""

    recipe: JsonObject
    count: int = 8
    path: str = RECIPE


@dataclass(frozen=True, eq=False, slots=True)
class RowRequest:
    """A row of the chart of a recipe, from 1 at the lower edge."""

    recipe: JsonObject
    row: int
    path: str = RECIPE


@dataclass(frozen=True, eq=False, slots=True)
class SpecksRequest:
    """The specks of the chart of a recipe: its patches of at most `most` knots that are no dots of a pattern."""

    recipe: JsonObject
    most: int = 3
    path: str = RECIPE


@dataclass(frozen=True, slots=True)
class PictureRequest:
    """A picture of the project, and the longest side at which it is sent [pixels].

    corners, turn  as in a recipe: the picture is first straightened and turned      page  of a PDF file, from 1
    """

    picture: str
    most: int = 1400
    corners: str = ""
    turn: str = ""
    page: int = 1


@dataclass(frozen=True, slots=True)
class ChartYarn:
    """A yarn of the chart, in the order of its indices, and what is needed of it.

    srgb    `#rrggbb`              symbol  as on the printed chart and in rows.txt
    length, mass  [m], [kg]; 0 where no knot has it      to_buy  mass with the reserve [kg]
    price         of what is to buy; None: not known     hanks   to buy, whole ones
    """

    name: str
    srgb: str
    symbol: str
    knots: int = 0
    length: float = 0.0
    mass: float = 0.0
    to_buy: float = 0.0
    price: float | None = None
    hanks: int = 0


@dataclass(frozen=True, slots=True)
class ListedYarn:
    """A yarn of the list: name and colour `#rrggbb`."""

    name: str
    srgb: str


@dataclass(frozen=True, slots=True)
class AssignedColour:
    """A colour of a drawing, `#rrggbb`, the name of its yarn, the CIEDE2000 of the two, and its knots.

    merged_with  the other colours of the yarn, those with most knots; at most MOST_MERGED
    """

    colour: str
    yarn: str
    delta_e: float
    knots: int
    merged_with: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class HardRow:
    """A row with many changes of yarn."""

    row: int
    changes: int


@dataclass(frozen=True, slots=True)
class SourcePicture:
    """The fitted picture, small: key, pixels across and down; sent: it is the second part of the answer, 3 bytes a
    pixel.
    """

    key: str
    width: int
    height: int
    sent: bool


@dataclass(frozen=True, slots=True)
class ChartAnswer:
    """A chart, before its knots: one byte a knot, the index of its yarn, row by row from the upper edge.

    width, length  of the carpet [m]      quality  as written      reading, reason, fit  how the picture was read
    listed  all yarns that may be chosen      hardest  rows with most changes      edited  knots that edits changed
    assignment  the yarn of each colour, most knots first; none of a photo, and of a drawing of too many colours
    mass, mass_per_area, price  of all yarns [kg], [kg/m²]
    checks, warnings, notes  as in the report      seconds  that it took
    draft  of a large photo: its own chart has other yarns in places
    """

    rows: int
    columns: int
    width: float
    length: float
    quality: str
    knot: str
    reading: str
    reason: str
    fit: str
    yarns: tuple[ChartYarn, ...]
    ground: tuple[YarnNeed, ...]
    listed: tuple[ListedYarn, ...]
    assignment: tuple[AssignedColour, ...]
    hardest: tuple[HardRow, ...]
    mean_changes: float
    edited: int
    small_patches: int
    mean_delta_e: float
    mass: float
    mass_per_area: float
    price: float | None
    currency: str
    checks: tuple[ShownCheck, ...]
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    half_knots: int
    jufti_knots: int
    draft: bool
    seconds: float
    source: SourcePicture | None = None


@dataclass(frozen=True, slots=True)
class Specks:
    """The specks of a chart before their knots: numbers of the patches of 1, 2 ... knots, and the names of the yarns.

    Then follow two parts: the knots, 4 bytes each, little-endian, row by row from the upper edge; and one byte each,
    the index of the yarn around its patch.
    """

    sizes: tuple[int, ...]
    knots: int
    yarns: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ShadeToDye:
    """A proposed shade: colour `#rrggbb`, share of the knots, the nearest yarn of the wool list and its CIEDE2000."""

    name: str
    srgb: str
    share: float
    nearest: str
    delta_e: float


@dataclass(frozen=True, slots=True)
class Proposal:
    """The proposed shades."""

    shades: tuple[ShadeToDye, ...]


@dataclass(frozen=True, slots=True)
class Corners:
    """The corners of a carpet in a photograph [pixels], clockwise from its upper left, and its clearness, 0 to 1."""

    corners: tuple[tuple[float, float], ...]
    clearness: float


@dataclass(frozen=True, slots=True)
class PictureAbout:
    """A picture before its pixels, 3 bytes each: its own sides, the sides as sent, and notes on its reading."""

    width: int
    height: int
    shown_width: int
    shown_height: int
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class RowRun:
    """A run of a row, from left to right: first knot from 1, cells, knots, yarn by its index.

    mark    0: whole knots, 1: two half knots in each cell, 2: jufti knots on two cells      second  yarn of half knots
    """

    first: int
    cells: int
    knots: int
    yarn: int
    mark: int = 0
    second: int = 0


@dataclass(frozen=True, slots=True)
class RowAnswer:
    """A row to weave by: its runs, and its lines from left to right and from right to left as rows.txt has them."""

    row: int
    rows: int
    columns: int
    runs: tuple[RowRun, ...]
    rightward: str
    leftward: str
    yarns: tuple[ChartYarn, ...] = field(default_factory=tuple)
