"""What a four-bar for a motion says: results, checks, tables and figures."""

import math
from collections.abc import Sequence

from ilmek.machines.four_bars import report as told
from ilmek.machines.motion_four_bar.design import MotionFourBar, spread
from ilmek.machines.motion_four_bar.figures import figures
from ilmek.report import Check, Column, Json, Report, Result, Table, at_most
from ilmek.synthesis.burmester.curve import CurveBranch
from ilmek.synthesis.burmester.links import Guide, GuideKind

MET = 1e-6
"""Error of a pose that counts as none, in extents of the poses, and of an angle [rad]."""


def report(design: MotionFourBar) -> Report:
    """Everything that the design says."""
    return Report(
        machine="motion-four-bar",
        title="Four-bar for a motion",
        parameters=design.params.as_dict(),
        results=(
            *_exactness(design),
            _judged(design),
            *told.results(design.choice),
            *_guides(design),
            *_curves(design),
        ),
        checks=(*told.checks(design.choice), *_checks(design)),
        tables=(*told.tables(design.choice, "motion-four-bar"), *_guide_table(design)),
        figures=figures(design),
        warnings=(*told.warnings(design.choice), *_odd(design)),
    )


def _exactness(design: MotionFourBar) -> tuple[Result, ...]:
    best = design.choice.best
    if best is None:
        return ()
    one = best.candidate
    return (
        Result("point_error", one.point_error, "mm", "greatest distance from a pose's point, by moving the solution"),
        Result("angle_error", one.angle_error, "deg", "greatest difference from a pose's angle"),
    )


def _judged(design: MotionFourBar) -> Result:
    pairs, found = design.judged
    said = "pairs of links that were judged" + ("" if design.guides else f": the most promising of {found} links")
    return Result("judged", pairs, "", said)


def _checks(design: MotionFourBar) -> tuple[Check, ...]:
    best = design.choice.best
    if best is None:
        return ()
    most = MET * design.extent
    return (at_most("distance from the poses", best.candidate.point_error, most, "mm", "by moving it"),)


def _guides(design: MotionFourBar) -> tuple[Result, ...]:
    if not design.guides:
        return ()
    found: list[Json] = [_guide(one) for one in design.guides]
    said = "every link that guides the body: kind; pivot and pin at the first pose (of sliders and blocks a direction)"
    return (Result("links", found, "", said, False),)


def _guide(one: Guide) -> dict[str, Json]:
    length = one.length if math.isfinite(one.length) else None
    return {"kind": str(one.kind), "pivot": told.place(one.pivot), "pin": told.place(one.pin), "length": length}


def _curves(design: MotionFourBar) -> tuple[Result, ...]:
    if design.curve is None:
        return ()
    found: dict[str, Json] = {
        "pivots": _branches(design.curve.centre_branches),
        "pins": _branches(design.curve.circle_branches),
    }
    said = "centre-point and circle-point curve, in stretches of places in order; closed: the last joins the first"
    return (Result("curves", found, "", said, False),)


def _branches(branches: Sequence[CurveBranch]) -> list[Json]:
    return [
        {"closed": branch.closed, "places": [[float(one.real), float(one.imag)] for one in branch.places]}
        for branch in branches
    ]


def _guide_table(design: MotionFourBar) -> tuple[Table, ...]:
    if not design.guides:
        return ()
    columns = (
        Column("link"),
        Column("kind"),
        Column("pivot x", "mm"),
        Column("pivot y", "mm"),
        Column("pin x", "mm"),
        Column("pin y", "mm"),
        Column("length", "mm"),
        Column("changes by", "mm"),
    )
    rows = tuple(
        (at, str(one.kind), *_places(one), one.length, spread(one, design.poses))
        for at, one in enumerate(design.guides, 1)
    )
    title = "Links that guide the body, pins at the first pose"
    return (Table("motion-four-bar-links", title, columns, rows, brief=True),)


def _places(one: Guide) -> tuple[float, float, float, float]:
    """Pivot and pin [m]; NaN where they are infinitely far."""
    pivot = one.pivot if one.kind in (GuideKind.CRANK, GuideKind.BLOCK) else complex(math.nan, math.nan)
    pin = one.pin if one.kind in (GuideKind.CRANK, GuideKind.SLIDER) else complex(math.nan, math.nan)
    return pivot.real, pivot.imag, pin.real, pin.imag


def _odd(design: MotionFourBar) -> tuple[str, ...]:
    """Links that are no cranks: worth knowing, as they may be built otherwise."""
    odd = [(at, one) for at, one in enumerate(design.guides, 1) if one.kind is not GuideKind.CRANK]
    return tuple(f"link {at} is a {one.kind}: {one.kind.words}" for at, one in odd)
