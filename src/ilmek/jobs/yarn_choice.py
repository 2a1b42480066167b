"""How the yarns of a chart were chosen, in words and by JSON names: merged yarns, twins, proposed shades."""

from typing import Any

from ilmek.carpet.chart import Chart
from ilmek.carpet.palette_rules import LEAST_DIFFERENCE, LEAST_GAIN, TwinYarns, twin_yarns
from ilmek.carpet.proposal import MatchedShade, match_shades
from ilmek.io.yarn_file import default_yarns
from ilmek.units import format_quantity

PROPOSED = "proposed.toml"
"""File of the proposed shades."""

MOST_TWINS = 5
"""Largest number of pairs of near twins that are named in warnings."""


def twins_of(chart: Chart) -> tuple[TwinYarns, ...]:
    """Near twins among the yarns that are used."""
    return twin_yarns([chart.yarns[number] for number in chart.used])


def proposed_shades(chart: Chart) -> tuple[MatchedShade, ...]:
    """The proposed shades, each with the nearest of the wools that come with ilmek."""
    return match_shades(chart.reading.proposed, default_yarns()) if chart.reading.proposed else ()


def twin_warnings(chart: Chart) -> tuple[str, ...]:
    """A warning for each pair of near twins, at most MOST_TWINS."""
    twins = twins_of(chart)
    warnings = [
        f"the yarns {one.names[0]!r} and {one.names[1]!r} are near twins, CIEDE2000 {one.difference:.2f}: below "
        f"{LEAST_DIFFERENCE:g} they are easily confused"
        for one in twins[:MOST_TWINS]
    ]
    more = len(twins) - MOST_TWINS
    return (*warnings, *((f"{more} more pairs of yarns are near twins",) if more > 0 else ()))


def yarn_notes(chart: Chart) -> tuple[str, ...]:
    """The number of yarns that was found, and the yarns that were merged."""
    palette, notes = chart.reading.palette, []
    if (knee := palette.knee) is not None:
        further = "there are no more" if knee.next_mean is None else f"with one more it is {knee.next_mean:.2f}"
        notes.append(
            f"{knee.colours} yarns: the mean CIEDE2000 is {knee.mean:.2f}, {further} (--colours auto adds a yarn that "
            f"lowers it by {LEAST_GAIN:g})"
        )
    notes += [
        f"{one.name!r}, {format_quantity(one.share, '%', 2)} of the knots, is merged, most of it into {one.into!r}"
        for one in palette.merged
    ]
    return tuple(notes)


def yarn_choice_results(chart: Chart) -> dict[str, Any]:
    """Results by their JSON names."""
    palette = chart.reading.palette
    knee = palette.knee
    return {
        "knee": None
        if knee is None
        else {"colours": knee.colours, "mean_delta_e": knee.mean, "next_mean_delta_e": knee.next_mean},
        "merged_yarns": [{"name": one.name, "into": one.into, "share": one.share} for one in palette.merged],
        "twins": [{"yarns": list(one.names), "delta_e": one.difference} for one in twins_of(chart)],
        "proposed": [
            {
                "name": one.name,
                "srgb": one.shade.hex,
                "share": one.shade.share,
                "nearest": one.nearest,
                "delta_e": one.difference,
            }
            for one in proposed_shades(chart)
        ],
    }
