"""The order of a carpet, read from texts and checked before any work is done."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ilmek.carpet.design import knot_grid
from ilmek.carpet.pile import PileParams
from ilmek.carpet.quality import Quality, parse_quality
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError, YarnError
from ilmek.io.chart.sheets import cut
from ilmek.io.yarn_file import default_yarns, read_yarns
from ilmek.params import Setting

MOST_PRINTED = 2_000
"""Largest number of sheets of a chart.pdf: 50 s, 13 MB and 300 MB of memory."""


@dataclass(frozen=True, slots=True)
class CarpetOrder:
    """The order of a carpet.

    picture    file of the picture
    yarns      yarn list
    colours    number of yarns to use; default: as many as match the picture best
    keep_lone  keep knots that differ from all four neighbours
    pdf        print the chart; default: if it has few enough sheets (`jobs.chart.MOST_SHEETS`)
    """

    picture: Path
    size: CarpetSize
    quality: Quality
    knot: str
    yarns: tuple[Yarn, ...]
    colours: int | None
    keep_lone: bool
    pile: PileParams
    pdf: bool | None = None

    def as_dict(self) -> dict[str, Any]:
        """The order as plain data, SI."""
        return {
            "picture": str(self.picture),
            "size": {"width": self.size.width, "length": self.size.length, "name": self.size.name},
            "quality": {"across": self.quality.across, "along": self.quality.along},
            "knot": self.knot,
            "yarns": [yarn.name for yarn in self.yarns],
            "colours": self.colours,
            "keep_lone": self.keep_lone,
            "pile": self.pile.as_dict(),
            "pdf": self.pdf,
        }


def read_order(
    picture: Path,
    *,
    size: str = "seccade",
    quality: str = "25x25/dm",
    knot: str = "symmetric",
    yarn_file: Path | None = None,
    colours: int | None = None,
    keep_lone: bool = False,
    pile_height: Setting = "8mm",
    pdf: bool | None = None,
) -> CarpetOrder:
    """The order from texts; the picture is not opened. Raises CarpetError, YarnError or ParameterError."""
    kind, wide, fine = parse_knot(knot), parse_size(size), parse_quality(quality)
    pile = PileParams.read({"pile_height": pile_height})
    _check_sheets(wide, fine, pdf)
    yarns = default_yarns() if yarn_file is None else read_yarns(yarn_file)
    if colours is not None and not 2 <= colours <= len(yarns):
        raise YarnError(
            f"--colours {colours}", allowed=f"2 to {len(yarns)}, the yarns of the list", do="or leave it out"
        )
    return CarpetOrder(picture, wide, fine, kind, yarns, colours, keep_lone, pile, pdf)


def _check_sheets(size: CarpetSize, quality: Quality, pdf: bool | None) -> None:
    """Raise CarpetError for a carpet of too few or too many knots, and for a PDF of more than MOST_PRINTED sheets."""
    rows, columns = knot_grid(size, quality)
    sheets = cut(rows, columns, quality.across / quality.along).count
    if pdf and sheets > MOST_PRINTED:
        raise CarpetError(
            f"--pdf: the chart of {size} at {quality} has {sheets:,} sheets",
            allowed=f"at most {MOST_PRINTED:,}",
            do="leave --pdf out, or take a coarser quality",
        )
