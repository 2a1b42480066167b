"""A loom that exists, and another carpet on it: nothing is redesigned, what the carpet needs is checked.

The loom is the design for the parameters in its file, with what was chosen; the parameters of its machines and the
results in the file prove that it is the same loom.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from ilmek.carpet.chart import Chart
from ilmek.elements.carpet_yarns import CarpetYarnParams, CarpetYarns, carpet_yarns
from ilmek.errors import LoomError, ParameterError, restated
from ilmek.io.loom_file import LoomFile, read_loom_file
from ilmek.jobs.loom_setup import WISHES
from ilmek.loom.sharing import heads_that_fit
from ilmek.loom.tube_plan import most_colours
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.cyclogram import cyclogram
from ilmek.params import Setting
from ilmek.report import Check, Report, at_least, at_most, must, plain
from ilmek.units import dm, format_quantity

SAME = 1e-9
"""Relative difference of numbers that are the same, written and read."""

SAME_PITCH = 5e-3
"""Share by which the quality may differ from that of the loom's warp pitch: dealers allow ten."""

OF_THE_YARNS = "yarns."
"""Parameters of the loom that belong to the carpet, and can be set beside a loom's file."""


@dataclass(frozen=True, slots=True)
class ExistingLoom:
    """A loom from a file: its design and report, and the names of what differs from its file."""

    path: Path
    design: LoomDesign
    report: Report
    differs: tuple[str, ...] = ()


def read_existing_loom(path: Path, *, illustrated: bool = False) -> ExistingLoom:
    """The loom of a file; `illustrated`: with tables and figures in its report, which take as long as all the rest.

    Raises LoomError for a file that is none, or whose loom cannot be designed.
    """
    file = read_loom_file(path, MACHINE.name)
    settings = {name: value for name, value in file.parameters.items() if name not in WISHES}
    with restated(LoomError, f"{path}, parameters: "):
        made = design(AutomatedLoomParams.read(settings))
    report = _reported(made, illustrated)
    return ExistingLoom(path, made, report, tuple(_differences(file, report)))


@lru_cache(maxsize=2)
def _reported(made: LoomDesign, illustrated: bool) -> Report:
    """The report of a loom: equal parameters give the same design, and a loom weaves many carpets."""
    return MACHINE.report(made, illustrated=illustrated)


def _differences(file: LoomFile, report: Report) -> Iterator[str]:
    """Names of parameters and results of the file that the loom has otherwise; those that either lacks are left out."""
    for child in report.children:
        inner = file.machines.get(child.machine, {})
        yield from (f"{child.machine}.{name}" for name in _differing(inner, plain(child.parameters), ""))
    judged = ("weaves", "reasons")
    yield from (name for name in _differing(file.results, report.results_as_json(), "") if name not in judged)


def _differing(given: object, found: object, path: str) -> Iterator[str]:
    if isinstance(given, Mapping) and isinstance(found, Mapping):
        for name in given.keys() & found.keys():
            yield from _differing(given[name], found[name], f"{path}.{name}" if path else name)
    elif isinstance(given, list) and isinstance(found, list) and len(given) == len(found):
        if any(True for one, other in zip(given, found, strict=True) for _ in _differing(one, other, path)):
            yield path
    elif not _same(given, found):
        yield path


def _same(given: Any, found: Any) -> bool:
    numbers = not isinstance(given, bool) and isinstance(given, int | float) and isinstance(found, int | float)
    if numbers and math.isfinite(found):
        return math.isclose(given, found, rel_tol=SAME, abs_tol=1e-15)
    return bool(given == found) or (given is None and isinstance(found, float))


def yarns_on(existing: ExistingLoom, settings: Mapping[str, Setting]) -> CarpetYarnParams:
    """The yarns of a carpet on the loom: as of its first carpet, with settings `yarns.*` in their place.

    Raises ParameterError for a setting that is none of a yarn, and one that is out of bounds.
    """
    for name in settings:
        if not name.startswith(OF_THE_YARNS):
            given = f"{name} is set beside {existing.path}"
            raise ParameterError(given, allowed="the loom exists: only yarns.* can be set", do=f"leave {name} out")
    own = {name.removeprefix(OF_THE_YARNS): setting for name, setting in settings.items()}
    read: Any = CarpetYarnParams.read(own, prefix=OF_THE_YARNS)
    return replace(existing.design.params.yarns, **{name: getattr(read, name) for name in own})


def heads_used(existing: ExistingLoom, chart: Chart) -> int:
    """Heads that share a row of the chart: those of the loom, or fewer, if only so many fit; the others are parked. 0
    where weavers tie.
    """
    made = existing.design
    return min(made.heads, heads_that_fit(chart.columns, made.knot_pitch, made.head_width))


def lengthening(existing: ExistingLoom, yarns: CarpetYarnParams) -> float:
    """Length of a carpet of these yarns on the loom, over that of the finished one [1]: at the loom's own tension."""
    cloth = existing.design.task.cloth
    return existing.design.params.finish.lengthening(
        replace(cloth, tension=cloth.warp_tension, yarns=yarns).warp_strain
    )


def for_rows(existing: ExistingLoom, row_pitch: float) -> LoomDesign:
    """The same loom with the take-up set to another distance of rows [m]."""
    made = existing.design
    timing = replace(made.row_timing, row_pitch=row_pitch)
    moved = {track.name: track for track in cyclogram(timing, made.row_cyclogram.period).tracks}
    tracks = tuple(moved.get(track.name, track) for track in made.row_cyclogram.tracks)
    return replace(made, row_timing=timing, row_cyclogram=replace(made.row_cyclogram, tracks=tracks))


def row_pitch_left(existing: ExistingLoom, row_pitch: float) -> float:
    """Distance of the rows [m] that the loom's beat leaves of rows required at a distance [m]."""
    beat = existing.design.beat
    finer = row_pitch / existing.design.task.cloth.row_distance
    fabric = beat.fabric
    scaled = replace(fabric, laid=fabric.laid * finer, jammed=fabric.jammed * finer, packing=fabric.packing * finer)
    return float(scaled.spacing(beat.beat_force_warp))


def carpet_checks(
    existing: ExistingLoom, chart: Chart, heads: int, yarns: CarpetYarnParams, knot_yarn: float
) -> tuple[Check, ...]:
    """What a carpet needs, against what the loom has.

    heads  that are used; 0: weavers tie, whatever the knot, its yarns and colours
    yarns  of the carpet, the pile as of the chart       knot_yarn  the longest pile yarn of a knot [m]
    """
    made, params = existing.design, existing.design.params
    same = "; ".join(existing.differs[:5])
    return (
        must(
            "loom: as in its file", not existing.differs, f"{existing.path.name}{f' differs in {same}' if same else ''}"
        ).with_cure("design the loom again with this version of ilmek, or leave its file as it was written"),
        *_fit_checks(made, chart, lengthening(existing, yarns)),
        *_row_checks(existing, lengthening(existing, yarns) / chart.quality.along),
        *((colours_check(chart, heads, params),) if heads else ()),
        *_yarn_checks(made, carpet_yarns(yarns, made.task.cloth.warp_pitch), knot_yarn),
    )


def colours_check(chart: Chart, heads: int, params: AutomatedLoomParams) -> Check:
    """The most colours of a part of a row, against the tubes of a head."""
    needed = most_colours(chart.knots, len(chart.yarns), heads)
    return at_most(
        "carpet: colours",
        needed,
        params.head_tubes,
        "1",
        "tubes of a head, against the colours of a part of a row; packages are changed between the parts",
    ).with_cure(f"set --colours {params.head_tubes}, or more heads, or take a loom with {needed} tubes a head")


def _fit_checks(made: LoomDesign, chart: Chart, longer: float) -> tuple[Check, ...]:
    """Warps, their pitch, the knot and the length, on the loom so much longer than the finished one's."""
    params, quality, warp_pitch = made.params, chart.quality, made.task.cloth.warp_pitch
    own, woven = 0.5 / warp_pitch * params.finish.widening, params.woven_size[1]
    pitch, dense = format_quantity(warp_pitch, "mm"), f"{own * dm:.4g}"
    widest = format_quantity((made.warps - params.selvedge_warps) / (2 * own), "cm")
    source = f"cams, slots and heads of the loom stand at warps {pitch} apart: {dense} knots/dm"
    return (
        at_most(
            "carpet: knots across beside those of the loom", abs(quality.across / own - 1), SAME_PITCH, "%", source
        ).with_cure(f"set --quality {dense}x{quality.along * dm:.4g}/dm"),
        at_most(
            "carpet: warps",
            2 * chart.columns + params.selvedge_warps,
            made.warps,
            "1",
            "cams, slots and healds of the loom",
        ).with_cure(f"set a size of at most {widest} width"),
        must(
            "carpet: knot", not made.heads or chart.knot == params.knot, f"the heads tie the {params.knot} knot"
        ).with_cure(f"set --knot {params.knot}"),
        at_most(
            "carpet: length on the loom",
            chart.size.length * longer,
            woven,
            "m",
            "warp and roll of the loom's cylinders",
        ).with_cure(f"set a size of at most {format_quantity(woven / longer, 'm')} length"),
    )


def _row_checks(existing: ExistingLoom, row_pitch: float) -> tuple[Check, ...]:
    """The distance of rows on the loom [m]: what the beat leaves, and what the take-up moves."""
    own = existing.design.task.cloth.row_distance
    most = row_pitch * (1 + existing.design.params.row_tolerance)
    source = "row pitch of the quality, and row_tolerance; fabric as assumed by this project"
    dense = f"{existing.design.params.quality.along * dm:.4g}"
    return (
        at_most(
            "carpet: distance of the rows that the beat leaves", row_pitch_left(existing, row_pitch), most, "mm", source
        ).with_cure("set a coarser quality along, or take a loom with a stronger beat"),
        at_most(
            "carpet: take-up of a row", row_pitch, own, "mm", "the take-up is timed for the loom's own rows"
        ).with_cure(f"set {dense} rows/dm or more"),
    )


def _yarn_checks(made: LoomDesign, yarns: CarpetYarns, knot_yarn: float) -> tuple[Check, ...]:
    """The yarns, against those that slots, opener, grippers and handler were made for."""
    own = made.task.yarns
    finer = "take a finer yarn"
    of_head = (
        (
            at_most(
                "carpet: thickness of the pile in a gripper", yarns.pressed, own.pressed, "mm", "grippers and gaps"
            ).with_cure(f"{finer}: --yarn-count"),
            at_most(
                "carpet: pile yarn of a knot", knot_yarn, made.weaver.drawn, "mm", "motion of the pile handler"
            ).with_cure("set a lower --pile-height"),
        )
        if made.heads
        else ()
    )
    return (
        at_most(
            "carpet: diameter of a warp", yarns.warp.diameter, own.warp.diameter, "mm", "slots of the spacer"
        ).with_cure(finer),
        at_most(
            "carpet: stiffness of a warp", yarns.warp.stiffness, own.warp.stiffness, "N", "tension of the open shed"
        ).with_cure(finer),
        at_least(
            "carpet: strength of a warp",
            yarns.warp.breaking_force,
            own.warp.breaking_force,
            "N",
            "tension of the open shed and of the beat",
        ).with_cure("take a stronger warp"),
        *of_head,
    )
