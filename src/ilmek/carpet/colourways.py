"""Colourways: one design in other yarns, knot for knot.

A yarn of the design is exchanged for another by its name, or by a colour, of which the nearest yarn on the shelf is
taken where it looks like it: CIEDE2000 of at most `LIKE`. All exchanges hold at once, so that two yarns can change
places.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import CODES, recoded
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.picture_points import read_colour
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.errors import CarpetError, did_you_mean
from ilmek.records import record
from ilmek.units import counted

LIKE = 5.0
"""Largest CIEDE2000 of a yarn that is taken for a colour: a difference that is seen side by side, not apart."""


@record
class Colourway:
    """A colourway of a name; exchange: yarn of the design -> yarn of the shelf, or a colour like #1f3f6f."""

    name: str
    exchange: Mapping[str, str]


def recoloured(chart: Chart, colourway: Colourway, shelf: Sequence[Yarn]) -> Chart:
    """The chart in the yarns of a colourway; yarns of the design that become the same one are one.

    shelf  yarns that are offered beside those of the chart
    Raises CarpetError for a yarn that the design does not have, and for a colour that the shelf lacks, with the
    nearest one.
    """
    design = {chart.yarns[index].name: index for index in chart.used}
    offered = with_counts({yarn.name: yarn for yarn in (*shelf, *chart.yarns)}.values(), chart.quality, chart.knot)
    yarns = list(chart.yarns)
    for old, new in colourway.exchange.items():
        if old not in design:
            raise CarpetError(
                f"colourway {colourway.name!r}: the design has no yarn {old!r}",
                allowed=", ".join(design),
                do=did_you_mean(old, design),
            )
        yarns[design[old]] = _offered(new, chart.yarns[design[old]], offered, colourway.name)
    kept = {yarns[index].name: yarns[index] for index in (*chart.used, *range(len(yarns)))}
    order = list(kept)
    codes = np.arange(CODES, dtype=np.uint8)  # cells without a knot have a code of no yarn
    codes[: len(yarns)] = [order.index(yarn.name) for yarn in yarns]
    reading = replace(chart.reading, differences=(), matches=(), lost=(), proposed=())
    return replace(
        chart,
        knots=recoded(chart.knots, codes),
        yarns=tuple(kept.values()),
        overlay=chart.overlay.with_yarns(codes),
        reading=reading,
        creel=None,
    )


def _offered(name: str, instead: Yarn, offered: Sequence[Yarn], colourway: str) -> Yarn:
    """The yarn of a name or a colour, in the place of a yarn of the design."""
    by_name = {yarn.name: yarn for yarn in offered}
    if name in by_name:
        return by_name[name]
    srgb = read_colour("colour", name) if name.startswith("#") else None
    lab = instead.lab if srgb is None else tuple(srgb_to_lab(np.array(srgb, dtype=np.uint8)).tolist())
    differences = delta_e_2000(yarn_labs(offered), np.array(lab))
    nearest = int(differences.argmin())
    if srgb is not None and differences[nearest] <= LIKE:
        return offered[nearest]
    if srgb is None:
        do = did_you_mean(name, by_name) or f"give one of them, or a colour like {instead.hex}"
        allowed = f"one of {counted(len(by_name), 'yarn')}: {', '.join(by_name)}"
    else:
        do = f"take {offered[nearest].name!r}, the nearest: a colour difference of {differences[nearest]:.1f}"
        allowed = f"a yarn within a colour difference of {LIKE:g} (CIEDE2000)"
    raise CarpetError(f"colourway {colourway!r} lacks the colour {name!r} for {instead.name!r}", allowed=allowed, do=do)
