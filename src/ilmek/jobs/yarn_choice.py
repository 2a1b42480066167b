"""How the yarns of a chart were chosen, in words and by JSON names: the yarn of each colour, merged yarns, twins, and
shades of the picture; and what the chart keeps of the picture, as checks.
"""

import math
from collections.abc import Iterator
from functools import reduce

import numpy as np

from ilmek.carpet.assignment import NEUTRAL, NEUTRAL_CHROMA
from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.colour_names import colour_name
from ilmek.carpet.edges_kept import LostColour
from ilmek.carpet.matches import ColourMatch
from ilmek.carpet.palette_rules import (
    LEAST_DETAILS,
    LEAST_DIFFERENCE,
    LEAST_GAIN,
    MOST_FINE_LOST,
    NEUTRAL_NO,
    TwinYarns,
    twin_yarns,
)
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.proposal import MatchedShade, match_shades
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.order import CarpetOrder
from ilmek.records import JsonObject
from ilmek.report import Check, Json
from ilmek.report.check import at_least, at_most
from ilmek.sentences import Sentence, joined
from ilmek.units import counted, format_quantity

PROPOSED = "proposed.toml"
"""File of the proposed shades."""

MOST_TWINS = 5
"""Largest number of pairs of near twins that are named in warnings."""


MOST_HIDDEN = 0.25
"""Largest share of a picture's outline that its ground hides, where none is given."""

LEAST_GROUND = 0.5
"""Share of the knots in one yarn from which a photo is print or objects on a ground, whose fine detail is all meant."""

MOST_CURES = 2
"""Largest number of lost colours that the line of a check names; the JSON has all."""


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
        f"the yarns {twin.names[0]!r} and {twin.names[1]!r} are near twins, CIEDE2000 {twin.difference:.2f}: below "
        f"{LEAST_DIFFERENCE:g} they are easily confused"
        for twin in twins[:MOST_TWINS]
    ]
    more = len(twins) - MOST_TWINS
    return (*warnings, *((f"near twins too: {counted(more, 'more pair')} of yarns",) if more > 0 else ()))


def yarn_notes(chart: Chart) -> tuple[str, ...]:
    """The yarns that are dyed, the number of yarns that was found, and the yarns that were merged."""
    palette, notes = chart.reading.palette, []
    if dyed := chart.dyed:
        notes.append(
            f"{dyed} of {counted(chart.colours, 'yarn')} dyed to order, for lack of a near wool; the yarns 'wool' "
            "keep to those in stock"
        )
    if (knee := palette.knee) is not None:
        further = "there are no more" if knee.next_mean is None else f"with one more it is {knee.next_mean:.2f}"
        notes.append(
            f"{knee.colours} yarns: the mean CIEDE2000 is {knee.mean:.2f}, {further} (--colours auto adds a yarn that "
            f"lowers it by {LEAST_GAIN:g})"
        )
    notes += [
        f"{yarn.name!r}, {format_quantity(yarn.share, '%', 2)} of the knots, is merged, most of it into {yarn.into!r}"
        for yarn in palette.merged
    ]
    return tuple(notes)


def kept_checks(chart: Chart, order: CarpetOrder) -> tuple[Check, ...]:
    """The edges of the picture that the chart keeps, and the colours of a drawing that it loses, with their cure; and
    what a round picture lacks for a rectangular carpet.

    None for a chart that is taken as it is.
    """
    made, rules = chart.reading, order.palette
    checks = []
    if made.edges_kept is not None:
        cure = _edges_cure(chart, order)
        checks.append(
            at_least(Sentence("check.edges-kept"), made.edges_kept, rules.least_edges, "%", _KEPT).with_cure(cure)
        )
    checks += _detail_checks(chart, order)
    if made.matches:
        share, cure = sum(lost.share for lost in made.lost), reduce(joined, _lost_cures(chart, order), "")
        checks.append(at_most(Sentence("check.colours-lost"), share, rules.most_lost, "%", _KEPT).with_cure(cure))
    if made.fit.hidden:
        cure = Sentence("check.outline-cure")
        checks.append(at_most(Sentence("check.outline"), made.fit.hidden, MOST_HIDDEN, "%", _KEPT).with_cure(cure))
    if made.fit.outside:
        cure, source = Sentence("check.round-cure"), Sentence("check.round-source")
        checks.append(at_most(Sentence("check.round"), made.fit.outside, 0.0, "%", source).with_cure(cure))
    return tuple(checks)


_KEPT = Sentence("check.chosen")


def _detail_checks(chart: Chart, order: CarpetOrder) -> Iterator[Check]:
    """The detail that the chart keeps, and of a drawing or print what is finer than the knots and lost."""
    detail, kind, rules = chart.reading.detail_kept, chart.reading.kind, order.palette
    if detail is None:
        return
    finer, least = Sentence("cure.finer"), rules.least_detail
    cure = finer if order.dyed else joined(finer, Sentence("cure.lack"))
    limit = LEAST_DETAILS[kind] if least is None else least
    yield at_least(Sentence("check.detail-kept"), detail.share, limit, "%", _KEPT).with_cure(cure)
    most = MOST_FINE_LOST if rules.most_fine_lost is None and least is None else rules.most_fine_lost
    if most is not None and (kind == "flat" or max(chart.counts) >= LEAST_GROUND * chart.knots.size):
        cure = Sentence("cure.print")
        yield at_most(Sentence("check.fine-lost"), detail.fine_lost, most, "%", _KEPT).with_cure(cure)


def _lost_cures(chart: Chart, order: CarpetOrder) -> Iterator[Sentence]:
    """The largest colours that are lost, at most MOST_CURES, what they became, and what brings them back."""
    lost, cured = chart.reading.lost[:MOST_CURES], dict[str, str]()
    for one in lost:
        share, yarn = format_quantity(one.share, "%", 2), chart.yarns[one.yarn].name
        words = Sentence("cure.lost", colour=one.hex, share=share, yarn=yarn, other=hex_colour(one.other))
        cure = _lost_cure(one, chart, order)
        cured[cure] = Sentence("cure.both", first=cured[cure], second=words) if cure in cured else words
    for cure, named in cured.items():
        yield Sentence("cure.by", what=named, cure=cure)
    more = len(chart.reading.lost) - len(lost)
    if more > 0:
        yield Sentence("cure.one-more") if more == 1 else Sentence("cure.many-more", count=f"{more:,}")


def _lost_cure(lost: LostColour, chart: Chart, order: CarpetOrder) -> str:
    if order.dyed:
        return Sentence("cure.more-colours", count=chart.colours + len(chart.reading.lost))
    code, beside = (srgb_to_lab(np.array(srgb, dtype=np.uint8)) for srgb in (lost.srgb, lost.other))
    left = [yarn for yarn in order.yarns or () if yarn.name not in {one.name for one in chart.yarns}]
    if order.palette.neutral != NEUTRAL_NO and np.hypot(*code[1:]) < NEUTRAL:
        left = [yarn for yarn in left if math.hypot(*yarn.lab[1:]) <= NEUTRAL_CHROMA]
    contrast = float(delta_e_2000(code, beside))
    apart = [yarn for yarn in left if float(delta_e_2000(np.array(yarn.lab), beside)) > contrast]
    if apart:
        near = min(apart, key=lambda yarn: float(delta_e_2000(np.array(yarn.lab), code)))
        return Sentence("cure.take-yarn", yarn=near.name)
    return Sentence("cure.add-yarn", colour=lost.hex, name=colour_name(code))


def _edges_cure(chart: Chart, order: CarpetOrder) -> str:
    """What brings edges back."""
    more = Sentence("cure.more-than", count=chart.colours)
    shades = more if order.dyed else Sentence("cure.own-shades")
    halftone = chart.reading.kind == "photo" and order.reading.halftone not in (None, 1.0)
    return Sentence("cure.halftone", shades=shades) if halftone else shades


def assignment_results(chart: Chart) -> list[JsonObject]:
    """The yarn of each colour of a drawing by JSON names; merged_with: the other colours of its yarn, but for twins."""
    of_yarn: dict[int, list[ColourMatch]] = {}
    for match in chart.reading.matches:
        of_yarn.setdefault(match.yarn, []).append(match)
    return [
        {
            "colour": match.hex,
            "yarn": chart.yarns[match.yarn].name,
            "delta_e": match.delta_e,
            "knots": match.knots,
            "merged_with": [other.hex for other in of_yarn[match.yarn] if other.group != match.group],
        }
        for match in chart.reading.matches
    ]


def yarn_choice_results(chart: Chart, order: CarpetOrder) -> dict[str, Json]:
    """Results by their JSON names."""
    palette, detail = chart.reading.palette, chart.reading.detail_kept
    knee = palette.knee
    return {
        "assignment": assignment_results(chart),
        "edges_kept": chart.reading.edges_kept,
        "detail_kept": detail and detail.share,
        "fine_detail_lost": detail and detail.fine_lost,
        "lost": [
            {"colour": lost.hex, "share": lost.share, "cure": _lost_cure(lost, chart, order)}
            for lost in chart.reading.lost
        ],
        "knee": None
        if knee is None
        else {"colours": knee.colours, "mean_delta_e": knee.mean, "next_mean_delta_e": knee.next_mean},
        "merged_yarns": [{"name": yarn.name, "into": yarn.into, "share": yarn.share} for yarn in palette.merged],
        "twins": [{"yarns": list(twin.names), "delta_e": twin.difference} for twin in twins_of(chart)],
        "proposed": [
            {
                "name": shade.shade.name,
                "srgb": shade.shade.hex,
                "share": shade.shade.share,
                "nearest": shade.nearest,
                "delta_e": shade.difference,
                "dyed": shade.shade.name in chart.reading.dyed,
            }
            for shade in proposed_shades(chart)
        ],
    }
