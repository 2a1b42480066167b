"""The knot that the motion of a yarn's end ties, reported and drawn."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ilmek.arrays import Complex, ComplexArray
from ilmek.errors import CarpetError
from ilmek.io.path_file import read_path
from ilmek.progress import SILENT, Progress
from ilmek.report import Dot, Drawing, Json, Report, Result, Stroke
from ilmek.units import format_quantity
from ilmek.weaving.knots.crossings import arc_lengths
from ilmek.weaving.knots.proof import TiedKnot, joined_ends, tied_knot
from ilmek.weaving.knots.word import word_text

RING = np.exp(2j * np.pi * np.arange(72) / 72)
"""Polygon of a round warp of radius 1."""

MOST_PASSES = 1_000_000
"""Largest number of warps that a path passes; the crossings take about 2 s."""

MOST_DRAWN = 200
"""Largest number of warps that are drawn, from the left of those that the path reaches."""

SMALLEST_PITCH, FARTHEST = 1e-6, 1e4
"""Smallest pitch, and largest distance of a path from warp 1 and of that from the origin [m]."""

BESIDE = 2
"""Number of warps drawn on each side of those that the path reaches."""


@dataclass(frozen=True, slots=True)
class KnotRequest:
    """A row of warps, and how the path is interpreted.

    count     number of warps
    pitch     distance between neighbouring warps [m]
    first     position of the leftmost warp [m]
    keep_out  radius around each warp that the path must not enter [m]
    smooth    the points are samples of a smooth motion; default: corners of a polyline
    closed    the path returns to its first point
    """

    count: int
    pitch: float
    first: complex
    keep_out: float
    smooth: bool = False
    closed: bool = False

    def __post_init__(self) -> None:
        if not self.pitch > 0:
            raise CarpetError(
                f"a pitch of {format_quantity(self.pitch, 'mm')}", allowed="more than 0", do="see --pitch"
            )
        if not SMALLEST_PITCH <= self.pitch <= FARTHEST or abs(self.first) > FARTHEST:
            given = f"warps of a pitch of {self.pitch:g} m, the first {abs(self.first):g} m from the origin"
            allowed = f"a pitch of {SMALLEST_PITCH:g} m to {FARTHEST:g} m, at most {FARTHEST:g} m from the origin"
            raise CarpetError(given, allowed=allowed)
        if self.keep_out < 0:
            raise CarpetError(f"keep-out {format_quantity(self.keep_out, 'mm')}", allowed="0 mm or more")
        if self.keep_out >= self.pitch / 2:
            raise CarpetError(
                f"keep-out {format_quantity(self.keep_out, 'mm')} at warps {format_quantity(self.pitch, 'mm')} apart "
                "leaves no passage between them",
                allowed=f"less than {format_quantity(self.pitch / 2, 'mm')}",
                do="--keep-out is the warp's radius plus half the width of the moving part",
            )

    @property
    def warps(self) -> ComplexArray:
        """Positions of the warps [m]."""
        return self.first + self.pitch * np.arange(self.count)


def knot_of(
    files: Sequence[Path], request: KnotRequest, columns: tuple[str, str] | None = None, progress: Progress = SILENT
) -> Report:
    """The knot that a yarn ties when its end is led along the path of a file, or its two ends along two.

    columns  headings of the columns of x and y; default: the only two columns of the file
    Raises CarpetError for more than two files, a path that cannot be read, or one that comes too close to a warp.
    """
    if len(files) > 2:
        raise CarpetError(f"{len(files)} paths", allowed="one, or two for both ends of the yarn")
    progress.part(0.0, 1.0, "knot")
    return report(*judged([read_path(file, columns) for file in files], request), request)


def judged(paths: Sequence[ComplexArray], request: KnotRequest) -> tuple[ComplexArray, TiedKnot]:
    """The yarn's whole path [m], of one end or of two that start at one point, and the knot that it ties."""
    path = paths[0] if len(paths) == 1 else joined_ends(paths[0], paths[1])
    _check_passes(path, request)
    lengths = arc_lengths(np.append(path, path[0]) if request.closed else path) if request.smooth else None
    return path, tied_knot(path, request.warps, keep_out=request.keep_out, lengths=lengths, closed=request.closed)


def _check_passes(path: ComplexArray, request: KnotRequest) -> None:
    """Raise CarpetError for a path that passes too many warps, or is too far from them."""
    if float(np.abs(path - request.first).max()) > FARTHEST:
        raise CarpetError(f"a path farther than {FARTHEST:g} m from warp 1", do="check the unit of its columns")
    along = np.clip((path.real - request.first.real) / request.pitch, -1.0, request.count)
    passes = float(np.abs(np.diff(along)).sum())
    if passes > MOST_PASSES:
        raise CarpetError(f"a path that passes {passes:.3g} warps", allowed=f"at most {MOST_PASSES}")


def report(path: Complex[np.ndarray, " points"], tied: TiedKnot, request: KnotRequest) -> Report:
    """The report of a knot: its name, its crossing word, a drawing."""
    known = tied.knot
    results = (
        Result("verdict", tied.words, "", "the knot that is tied, or why there is none"),
        Result("knot", known.kind if known else None, "", "kind: symmetric, asymmetric or single-warp; null: no knot"),
        Result("opens", known.opens or None if known else None, "", "side on which an asymmetric knot is open"),
        Result(
            "warps",
            list(known.warps) if known else [],
            "",
            "warps that the knot is tied on, numbered from 1 at the left",
        ),
        Result("word", list(tied.word), "", "warps passed behind: + from left to right, - from right to left"),
        Result("way", word_text(tied.word) if tied.word else "behind no warp", "", "the crossing word in words"),
        Result("backward", tied.backward, "", "the yarn runs through the knot from its other end"),
        Result("length", float(np.abs(np.diff(path)).sum()), "mm", "length of the path, from point to point"),
    )
    first = [request.first.real, request.first.imag]
    parameters: dict[str, Json] = dict(pitch=request.pitch, warps=request.count, first=first, keep_out=request.keep_out)
    parameters |= dict(smooth=request.smooth, closed=request.closed)
    return Report("knot", "Knot of a motion", parameters, results, (), figures=(_drawing(path, tied, request),))


def _drawing(path: ComplexArray, tied: TiedKnot, request: KnotRequest) -> Drawing:
    """The path among the warps that it reaches."""
    along = (path.real - request.first.real) / request.pitch
    low, high = int(np.floor(along.min())) - BESIDE, int(np.ceil(along.max())) + BESIDE
    numbers = [number for number in range(request.count) if low <= number <= high][:MOST_DRAWN]
    radius = request.keep_out or request.pitch / 20
    rings = [Stroke(request.warps[number] + radius * RING, "outline", closed=True) for number in numbers]
    names = [Dot(complex(request.warps[number]), str(number + 1), "point") for number in numbers]
    ends = [Dot(complex(path[0]), "begins", "point"), Dot(complex(path[-1]), "ends", "point")]
    strokes = (*rings, Stroke(path, "yarn", closed=request.closed))
    return Drawing("knot", "The path among the warps", strokes, (*names, *ends), "mm", f"{tied.words}; pile upwards.")
