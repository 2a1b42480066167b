"""Palette rules: which yarns of the list a carpet takes."""

from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.carpet.palette import Colours, best_yarns
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.params import Params, kind
from ilmek.progress import SILENT, Progress


@dataclass(frozen=True, slots=True)
class PaletteParams(Params):
    """Which yarns of the list a carpet takes."""

    colours: int | None = kind.count(
        None,
        at_least=2,
        at_most=255,
        doc="number of yarns, those of the list that match the picture best; default: all",
    )


def choose_yarns(
    distinct: Colours, yarns: Sequence[Yarn], params: PaletteParams, progress: Progress = SILENT
) -> tuple[Yarn, ...]:
    """The yarns of the list that a design takes, in the order of the list. Raises YarnError."""
    if params.colours is None:
        return tuple(yarns)
    return tuple(yarns[number] for number in best_yarns(distinct, yarn_labs(yarns), params.colours, progress))
