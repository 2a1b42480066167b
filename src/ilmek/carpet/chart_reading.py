"""How a picture became a chart: what its reading kept, changed and lost."""

from dataclasses import field

from ilmek.carpet.detail import KeptDetail
from ilmek.carpet.differences import YarnDifference
from ilmek.carpet.edges_kept import LostColour
from ilmek.carpet.fitting import Fit
from ilmek.carpet.matches import ColourMatch
from ilmek.carpet.palette_rules import Palette
from ilmek.carpet.paper.sheet import PaperReading
from ilmek.carpet.proposal import ProposedShade
from ilmek.carpet.recipe.outcome import EditOutcome
from ilmek.records import record


@record
class ChartReading:
    """How a picture became a chart.

    kind           exact, flat or photo          reason   of that decision, one sentence
    mean_delta_e   mean CIEDE2000 of the knots' yarns to the design, and to the picture where the reading is off
    least_delta_e  the same if each knot had its nearest yarn of the list: the optimum
    changed        number of knots that were changed because their patch was too small
    foreign        number of knots whose yarn is that of no true colour of their cell; None: no true colours
    fit            how the picture was fitted to the carpet
    differences    of each yarn of the chart to the colours that it is the nearest of; 0 of one that is of none
    edited         number of knots that the edits of a recipe changed
    edits          what became of those that were written on another grid, or have no place on this one
    matches        of each colour of an exact or flat design, most knots first, at most MOST_MATCHES
    palette        how its yarns were chosen from the list; default: they were not
    proposed       shades of the design itself: those that are dyed for it, or as many as were required
    dyed           names of the yarns that are dyed for it
    lost           colours of a drawing that vanish, because another has the same yarn
    paper          the sheet of squared paper that the design was read from
    edges_kept, detail_kept  what the chart keeps of the picture's edges [-] and detail; None: not measured
    """

    kind: str
    reason: str
    mean_delta_e: float
    least_delta_e: float
    changed: int = 0
    foreign: int | None = None
    fit: Fit = field(default_factory=Fit)
    differences: tuple[YarnDifference, ...] = ()
    edited: int = 0
    edits: tuple[EditOutcome, ...] = ()
    matches: tuple[ColourMatch, ...] = ()
    palette: Palette = Palette(())
    proposed: tuple[ProposedShade, ...] = ()
    dyed: tuple[str, ...] = ()
    lost: tuple[LostColour, ...] = ()
    edges_kept: float | None = None
    detail_kept: KeptDetail | None = None
    paper: PaperReading | None = None
