"""Which knot the motion of a yarn's end ties, said and drawn."""

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
"""Corners of a round warp of radius 1."""

BESIDE = 2
"""Warps drawn on each side of those that the path comes to."""


@dataclass(frozen=True, slots=True)
class KnotRequest:
    """A row of warps [m], and how the path is to be taken.

    count, pitch, first  of the warps; the first stands at `first`, the others to its right
    keep_out  radius about a warp that the path may not enter [m]
    smooth    the places are samples of a smooth motion; else corners of a path of straight lines
    closed    the motion ends where it began
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
        if self.keep_out >= self.pitch / 2:
            raise CarpetError(
                f"{format_quantity(self.keep_out, 'mm')} kept about warps {format_quantity(self.pitch, 'mm')} apart "
                "leaves no way between them",
                allowed=f"less than {format_quantity(self.pitch / 2, 'mm')}",
                do="--keep-out is the warp's radius and half of what moves",
            )

    @property
    def warps(self) -> ComplexArray:
        """Places of the warps [m]."""
        return self.first + self.pitch * np.arange(self.count)


def knot_of(
    files: Sequence[Path], asked: KnotRequest, columns: tuple[str, str] | None = None, progress: Progress = SILENT
) -> Report:
    """The knot that yarn ties whose end is led along the path of a file, or whose two ends along two.

    columns  headings of the columns of x and y; default: the only two
    Raises CarpetError for more than two files, a path that cannot be read, or one that comes too close to a warp.
    """
    if len(files) > 2:
        raise CarpetError(f"{len(files)} paths", allowed="one, or two for both ends of the yarn")
    progress.part(0.0, 1.0, "knot")
    return report(*judged([read_path(file, columns) for file in files], asked), asked)


def judged(paths: Sequence[ComplexArray], asked: KnotRequest) -> tuple[ComplexArray, TiedKnot]:
    """The yarn's whole path [m] of one end, or of two led from one place, and the knot that it ties."""
    path = paths[0] if len(paths) == 1 else joined_ends(paths[0], paths[1])
    lengths = arc_lengths(np.append(path, path[0]) if asked.closed else path) if asked.smooth else None
    return path, tied_knot(path, asked.warps, keep_out=asked.keep_out, lengths=lengths, closed=asked.closed)


def report(path: Complex[np.ndarray, " places"], tied: TiedKnot, asked: KnotRequest) -> Report:
    """What is tied, in words, as a word, and drawn."""
    known = tied.knot
    results = (
        Result("verdict", tied.words, "", "the knot that is tied, or why there is none"),
        Result("knot", known.kind if known else None, "", "its kind: symmetric, asymmetric or single-warp; none"),
        Result("opens", known.opens or None if known else None, "", "side on which an asymmetric knot is open"),
        Result("warps", list(known.warps) if known else [], "", "it is tied on, numbered from 1 at the left"),
        Result("word", list(tied.word), "", "warps passed behind: + from left to right, - from right to left"),
        Result("way", word_text(tied.word) if tied.word else "behind no warp", "", "the word as a weaver says it"),
        Result("backward", tied.backward, "", "the yarn runs through the knot from its other end"),
        Result("length", float(np.abs(np.diff(path)).sum()), "mm", "of the path, from place to place"),
    )
    first = [asked.first.real, asked.first.imag]
    parameters: dict[str, Json] = dict(pitch=asked.pitch, warps=asked.count, first=first, keep_out=asked.keep_out)
    parameters |= dict(smooth=asked.smooth, closed=asked.closed)
    return Report("knot", "Knot of a motion", parameters, results, (), figures=(_drawing(path, tied, asked),))


def _drawing(path: ComplexArray, tied: TiedKnot, asked: KnotRequest) -> Drawing:
    """The path among the warps that it comes to."""
    along = (path.real - asked.first.real) / asked.pitch
    low, high = int(np.floor(along.min())) - BESIDE, int(np.ceil(along.max())) + BESIDE
    numbers = [number for number in range(asked.count) if low <= number <= high]
    radius = asked.keep_out or asked.pitch / 20
    rings = [Stroke(asked.warps[number] + radius * RING, "outline", closed=True) for number in numbers]
    names = [Dot(complex(asked.warps[number]), str(number + 1), "point") for number in numbers]
    ends = [Dot(complex(path[0]), "begins", "point"), Dot(complex(path[-1]), "ends", "point")]
    strokes = (*rings, Stroke(path, "yarn", closed=asked.closed))
    return Drawing("knot", "The path among the warps", strokes, (*names, *ends), "mm", f"{tied.words}; pile upwards.")
