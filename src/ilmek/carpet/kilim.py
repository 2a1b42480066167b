"""Kilim: a cloth of wefts alone, each of which turns back where its colour ends.

A cell of the chart is two warps wide and a number of picks high. A run of a row has a weft of its own, on a bobbin of
its own, and is woven with that number of picks. Where two colours meet along the warps nothing crosses from one to the
other: there is a slit, which may be a few rows long. A longer one is joined:

    dovetail   both wefts turn round one warp between them, in turn
    interlock  each weft turns round the other between two warps

The warps are straight, and the wefts are beaten down until they hide them. A weft of the diameter d passes the warps,
of the diameter D and the pitch p, with the amplitude A = (D + d)/2; a pick over the width w of a run is, with the
length s of a sinuous weft [ilmek.carpet.ground],

    l = s(w, p, A) + pi (D + d)/2 + j         j = 0 at a slit, p for each dovetail, d for each interlock at its two ends

half a turn round the last warp for each pick [derived]. Cells outside of the shape have no weft: at the outline a weft
turns back beside nothing, so that there is no slit. The time is that of every pick of every run, its length at the
speed of the hand, and of every join. Times and allowances are assumed by this project.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, Indices
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.ground import GroundParams, sinuous_length
from ilmek.carpet.quality import Quality
from ilmek.elements.carpet_yarns import carpet_yarns
from ilmek.elements.yarns import MATERIALS
from ilmek.errors import ParameterError
from ilmek.params import Params, kind, param
from ilmek.units import g, m, mm

SLIT, DOVETAIL, INTERLOCK = JOINS = ("slit", "dovetail", "interlock")
"""How two colours meet along the warps where a slit would be too long."""


@dataclass(frozen=True, slots=True)
class KilimParams(Params):
    """Warps, picks, joins and times of a kilim."""

    warps: float = param(500.0, unit="1/dm", at_least=20.0, at_most=5000.0, doc="warps; usual: 30 to 80 per dm")
    picks: float = param(2000.0, unit="1/dm", at_least=20.0, at_most=20000.0, doc="picks; usual: 100 to 300 per dm")
    step: int = param(4, at_least=2, at_most=40, doc="picks of a row of the chart, out and back: an even number")
    join: str = kind.choice(SLIT, JOINS, doc="how colours meet where a slit would be longer than longest_slit")
    longest_slit: float = kind.length(
        15 * mm, above=0.0, at_most=1.0, doc="longest slit that is left open; usual: 5 to 30 mm"
    )
    yarn_density: float = kind.line_density(
        0.4 * g / m, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of the weft"
    )
    pick_time: float = kind.time(4.0, at_least=0.0, at_most=600.0, doc="shed, turn and beat of a pick of a run")
    hand_speed: float = kind.speed(
        0.3, above=0.0, at_most=10.0, doc="speed at which a bobbin is passed through the shed"
    )
    join_time: float = kind.time(2.0, at_least=0.0, at_most=600.0, doc="joining of a pick to its neighbour")

    def check_together(self) -> None:
        """Raise ParameterError for a row of an odd number of picks: its wefts would end at the other side."""
        if self.step % 2:
            given = f"step {self.step}: a row of an odd number of picks"
            raise ParameterError(given, allowed="an even number, out and back", do=f"set step={self.step + 1}")

    @property
    def quality(self) -> Quality:
        """Cells of the chart across and along."""
        return Quality(self.warps / 2, self.picks / self.step)


class Slit(NamedTuple):
    """Where two colours meet along the warps: after a number of cells from the left, rows from 1 at the lower edge."""

    column: int
    first: int
    last: int

    @property
    def rows(self) -> int:
        """Rows that it is long."""
        return self.last - self.first + 1

    def __str__(self) -> str:
        return f"between columns {self.column} and {self.column + 1}, rows {self.first}..{self.last}"


def borders(knots: Indices) -> BoolArray:
    """Where the colour changes between a cell and that on its right, both woven, (rows, columns - 1)."""
    left, right = knots[:, :-1], knots[:, 1:]
    changed: BoolArray = (left != right) & (left != NO_KNOT) & (right != NO_KNOT)
    return changed


def slits(knots: Indices) -> tuple[Slit, ...]:
    """The slits of a chart, the longest first: borders of colours along the warps that no weft crosses.

    >>> [str(slit) for slit in slits(np.array([[0, 1, 1], [0, 0, 1], [0, 0, 2]]))]
    ['between columns 2 and 3, rows 1..2', 'between columns 1 and 2, rows 3..3']
    """
    rows = len(knots)
    turned = np.zeros((knots.shape[1] - 1, rows + 2), dtype=np.int8)
    turned[:, 1:-1] = borders(knots)[::-1].T
    change = np.diff(turned, axis=1)
    column, first = np.nonzero(change > 0)
    last = np.nonzero(change < 0)[1]
    found = (Slit(c + 1, f + 1, end) for c, f, end in zip(column.tolist(), first.tolist(), last.tolist(), strict=True))
    return tuple(sorted(found, key=lambda slit: (-slit.rows, slit.column, slit.first)))


def joined(knots: Indices, params: KilimParams) -> BoolArray:
    """Which of the borders are joined: those of slits that are too long, unless they are left open; as `borders`."""
    where = np.zeros((len(knots), knots.shape[1] - 1), dtype=bool)
    for slit in slits(knots) if params.join != SLIT else ():
        if not is_too_long(slit, params):
            break
        where[len(knots) - slit.last : len(knots) - slit.first + 1, slit.column - 1] = True
    return where


def is_too_long(slit: Slit, params: KilimParams) -> bool:
    """Whether a slit may not be open."""
    return slit_length(slit, params) > params.longest_slit * (1 + 1e-9)


def slit_length(slit: Slit, params: KilimParams) -> float:
    """Length of a slit [m]."""
    return slit.rows / params.quality.along


class KilimRun(NamedTuple):
    """A run of a row with a weft of its own: first cell from 0 at the left, cells, yarn, joins at its two ends; or
    cells outside of the shape, of the yarn NO_KNOT.
    """

    first: int
    cells: int
    yarn: int
    joins: int


def row_runs(knots: Indices, joints: BoolArray) -> Iterator[KilimRun]:
    """The runs of one row from the left; joints: of its borders."""
    ends = [*(np.flatnonzero(knots[1:] != knots[:-1]) + 1).tolist(), len(knots)]
    first = 0
    for end in ends:
        joins = int(first > 0 and joints[first - 1]) + int(end < len(knots) and joints[end - 1])
        yield KilimRun(first, end - first, int(knots[first]), joins)
        first = end


def pick_length(cells: int, joins: int, params: KilimParams, ground: GroundParams | None = None) -> float:
    """Length of weft for a pick of a run [m].

    >>> round(pick_length(25, 0, KilimParams()) * 1e3, 1)
    144.7
    """
    ground = ground or GroundParams()
    pitch = 1 / params.warps
    warp = carpet_yarns(ground.yarns, pitch).warp.diameter
    weft = MATERIALS[ground.yarns.pile].diameter(params.yarn_density)
    allowance = {SLIT: 0.0, DOVETAIL: pitch, INTERLOCK: weft}[params.join]
    across = sinuous_length(2 * cells * pitch, pitch, (warp + weft) / 2)
    return across + math.pi * (warp + weft) / 2 + allowance * joins


@dataclass(frozen=True, eq=False, slots=True)
class KilimWork:
    """What is woven: wefts of a chart, and the time for them.

    weft     of each code of a yarn [m]           bobbins  of each row, from the upper edge
    picks    of all runs                          joins    of all picks           time  of one weaver [s]
    """

    weft: FloatArray
    bobbins: Indices
    picks: int
    joins: int
    time: float


def kilim_work(knots: Indices, yarns: int, params: KilimParams, ground: GroundParams | None = None) -> KilimWork:
    """The work of weaving a chart; yarns: their number."""
    joints, weft, lengths = joined(knots, params), np.zeros(yarns), dict[tuple[int, int], float]()
    bobbins = np.zeros(len(knots), dtype=np.uint16)
    joins = 0
    for row, line in enumerate(knots):
        for run in row_runs(line, joints[row]):
            if run.yarn == NO_KNOT:
                continue
            bobbins[row] += 1
            key = run.cells, run.joins
            if key not in lengths:
                lengths[key] = pick_length(*key, params, ground)
            weft[run.yarn] += lengths[key]
            joins += run.joins
    picks, weft = params.step * int(bobbins.sum()), params.step * weft
    time = picks * params.pick_time + float(weft.sum()) / params.hand_speed + params.step * joins * params.join_time
    return KilimWork(weft, bobbins, picks, params.step * joins, time)
