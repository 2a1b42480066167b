"""The report of a study: verdict, best designs, sensitivities, yield, curves of the results over the variables."""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.jobs.study.run import StudyResult
from ilmek.plane.level_sets import level_polygons
from ilmek.records import JsonObject
from ilmek.report import Axis, Check, Column, DesignCloud, Figure, Mark, Plot, Report, Result, Series, Table, at_least
from ilmek.studies.allocation import Allocation, scaled
from ilmek.studies.fronts import knee
from ilmek.studies.optimum import Optimum
from ilmek.studies.surface import surface_of
from ilmek.studies.tolerance import Yield
from ilmek.studies.variable import settings_of
from ilmek.units import format_quantity, parse_unit, printed_unit
from ilmek.viz.scale import tick_labels, ticks

CLASSES = 12
"""Classes of a variable in a curve of means."""

LEAST_IN_CLASS = 3
"""Designs of a class from which its mean is drawn."""

MOST_POINTS = 1000
"""Designs of the picture of all designs; those of the front are added."""

TRUSTED, NODES, LEVELS = 0.8, 61, 6
"""Least share of the variance that a surface explains to be drawn; its nodes across, and about how many lines."""

SHOWN = 10
"""Designs, checks and reasons in a table."""


def study_report(found: StudyResult) -> Report:
    """The report of a study, as of a machine: its page and its lines on the terminal are the same."""
    rows = found.rows
    results = (
        Result("samples", len(rows.points), "", "designs"),
        Result("done", int(rows.made.sum()), "", "designs that were made"),
        Result("failed", int((~rows.made).sum()), "", "designs that could not be made"),
        Result("feasible", int(rows.feasible.sum()), "", "designs of which every check holds"),
        Result("digest", found.digest, "", "SHA-256 of all designs", shown=False),
        Result(
            "best", best_json(found), "", "the best design, that of the knee where there are several goals", shown=False
        ),
        Result("front", [_design(found, n) for n in found.front], "", "designs that are best in some way", shown=False),
        Result("indices", [one.as_json() for one in found.sensitivities], "", "sensitivities", shown=False),
        Result("yield", found.yielded.as_json() if found.yielded else None, "", "share that holds", shown=False),
        Result(
            "allocation",
            found.allocation.as_json() if found.allocation else None,
            "",
            "factors of the tolerances of least cost for a wanted yield",
            shown=False,
        ),
        Result("spreads", [one.as_json() for one in found.spreads], "", "spread of each result", shown=False),
        Result("reasons", [list(one) for one in found.reasons], "", "why designs were not made", shown=False),
    )
    return Report(
        machine="study",
        title=f"Study of {found.order.target}: {found.order.method}, {', '.join(v.name for v in found.variables)}",
        parameters={variable.name: [variable.low, variable.high] for variable in found.variables},
        results=results,
        checks=_checks(found),
        tables=tuple(_tables(found)),
        figures=tuple(_figures(found)),
        warnings=tuple(f"{number} designs {status}: {reason}" for status, reason, number in found.reasons),
        headline=("samples", "done", "failed", "digest", "best", "front", "indices"),
    )


def best_json(found: StudyResult) -> JsonObject | None:
    """The best design as plain data; None where none holds or there is no goal."""
    number = best(found)
    return None if number is None else _design(found, number)


def best(found: StudyResult) -> int | None:
    """The number of the best design: of several goals the knee of the front."""
    if not found.front:
        return None
    costs = np.column_stack([goal.sign * found.values(goal.result)[list(found.front)] for goal in found.goals])
    return found.front[knee(costs)]


def _design(found: StudyResult, number: int) -> JsonObject:
    results = {name: float(value) for name, value in zip(found.results, found.rows.results[number], strict=True)}
    return {
        "design": number,
        "parameters": settings_of(found.variables, found.rows.points[number]),
        "results": results,
        "margin": float(found.rows.worst[number]),
        "command": found.command(number),
    }


def _checks(found: StudyResult) -> tuple[Check, ...]:
    """Whether a design holds, and whether tolerances of least cost give the wanted yield.

    The cure names the check that fails most often. A yield is judged by the upper end of its interval: a smaller one
    than wanted is not for lack of designs.
    """
    feasible = int(found.rows.feasible.sum())
    frequent = _failures(found)
    cure = "widen the ranges of --vary"
    if frequent:
        name, share = frequent[0]
        cure = f"{name} fails in {share:.0%} of the designs: widen the ranges, or give the study a lower limit"
    checks = [at_least("designs that hold", feasible, 1, "1", "checks of each design").with_cure(cure)]
    if found.allocation is not None and found.allocation.found is not None:
        reached, target = found.allocation.found.high, found.allocation.target
        wanted = at_least("yield of the tolerances of least cost", reached, target, "%", "upper end of its interval")
        checks.append(wanted.with_cure("ask for a higher --yield: the margins are not normal, or the fit is poor"))
    return tuple(checks)


def _failures(found: StudyResult) -> list[tuple[str, float]]:
    """Checks that fail, each with the share of the made designs in which it does; the most frequent first."""
    made = max(int(found.rows.made.sum()), 1)
    shares = (found.margins < 0).sum(axis=0) / made
    named = [(name, float(share)) for name, share in zip(found.checks, shares, strict=True) if share > 0]
    return sorted(named, key=lambda one: -one[1])


def _tables(found: StudyResult) -> Iterator[Table]:
    yield from _best_tables(found)
    yield from _sensitivity_tables(found)
    yield from _yield_tables(found)
    failures = _failures(found)
    if failures:
        heads = (Column("check"), Column("fails in", "%"))
        yield Table("study-failures", "Checks that fail", heads, tuple(failures[:SHOWN]), brief=True)


def _best_tables(found: StudyResult) -> Iterator[Table]:
    """The best design or the front, the command of the best, and what its binding limits cost."""
    number = best(found)
    if number is None:
        return
    varied = (Column(v.name, v.unit if v.continuous else "") for v in found.variables)
    heads = (Column("design"), *varied, *(Column(n, found.units[n]) for n in found.results), Column("least margin"))
    title = "Best design" if len(found.goals) == 1 else "Front: no other design is better in every goal"
    rows = tuple(_design_row(found, one) for one in _thinned(found.front))
    yield Table("study-best", title, heads, rows, brief=True)
    yield Table("study-command", "As a command", (Column("command"),), ((found.command(number),),), brief=True)
    if found.optimum is not None and (found.optimum.multipliers or found.optimum.ends):
        yield _multiplier_table(found, found.optimum)


def _multiplier_table(found: StudyResult, optimum: Optimum) -> Table:
    """What each binding limit costs: that of a check relaxed by 1 %, a range widened by a unit in which it is shown."""
    goal = found.goals[0]
    rows = [(found.checks[n], "1 %", -0.01 * m * goal.sign) for n, m in optimum.multipliers.items()]
    for number, slope in optimum.ends.items():
        one = found.variables[number]
        relation, limit = ("<=", one.high) if slope < 0 else (">=", one.low)
        name = f"{one.name} {relation} {format_quantity(limit, one.unit)}"
        change = -abs(slope) * parse_unit(one.unit).factor * goal.sign
        rows.append((name, format_quantity(parse_unit(one.unit).factor, one.unit), change))
    heads = (Column("limit"), Column("relaxed by"), Column(f"change of {goal.result}", found.units[goal.result]))
    return Table("study-multipliers", "What binding limits cost", heads, tuple(rows), brief=True)


def _design_row(found: StudyResult, number: int) -> tuple[float | int | str, ...]:
    values = settings_of(found.variables, found.rows.points[number]).values()
    shown = (one if isinstance(one, int | float) and not isinstance(one, bool) else str(one) for one in values)
    return (number, *shown, *found.rows.results[number].tolist(), float(found.rows.worst[number]))


def _sensitivity_tables(found: StudyResult) -> Iterator[Table]:
    for result in found.results:
        those = [one for one in found.sensitivities if one.result == result]
        if those:
            heads = (Column("variable"), Column("measure"), Column("value [SI]"), Column("± (95 %)"))
            rows = tuple((one.variable, one.measure, one.value, one.interval) for one in those)
            yield Table(f"study-sensitivity-{result}", f"Sensitivity of {result}", heads, rows, brief=True)


def _yield_tables(found: StudyResult) -> Iterator[Table]:
    """The yield; the spread of each result, and what makes it spread."""
    if found.yielded is not None:
        heads = (Column("yield", "%"), Column("from", "%"), Column("to", "%"))
        rows = ((found.yielded.value, found.yielded.low, found.yielded.high),)
        yield Table("study-yield", "Share of the designs that hold, with its 95 % interval", heads, rows, brief=True)
    if found.allocation is not None:
        yield _allocation_table(found, found.allocation)
    for spread in found.spreads:
        name, unit = spread.result, found.units[spread.result]
        names = ("mean", "deviation", "0.135 %", "99.865 %", "worst case from", "to")
        numbers = (spread.mean, spread.deviation, spread.low, spread.high, spread.worst_low, spread.worst_high)
        limits = tuple(Column(one, unit) for one in names)
        yield Table(f"study-spread-{name}", f"Spread of {name}", limits, (numbers,), brief=True)
        shares = tuple(sorted(spread.contributions.items(), key=lambda one: -one[1]))
        parts = (Column("variable"), Column("share of the variance", "%"))
        yield Table(f"study-contributions-{name}", f"What makes {name} spread", parts, shares, brief=True)


def _allocation_table(found: StudyResult, allocation: Allocation) -> Table:
    """Tolerances of least cost for the wanted yield, the tightest first."""
    heads = (Column("variable"), Column("tolerance now"), Column("at least cost"), Column("factor"), Column(""))
    rows = []
    for variable, new in zip(found.variables, scaled(found.variables, allocation.factors), strict=True):
        factor = allocation.factors[variable.name]
        now, then = (f"± {format_quantity((one.high - one.low) / 2, one.unit)}" for one in (variable, new))
        rows.append((variable.name, now, then, factor, "tighten" if factor < 1 else "widen"))
    yielded = allocation.found or Yield(np.nan, np.nan, np.nan)
    title = (
        f"Tolerances of least cost for a yield of {allocation.target:.4g}: found {yielded.value:.4g} "
        f"({yielded.low:.4g} to {yielded.high:.4g}), cost {allocation.cost:.3g} of now"
    )
    return Table("study-allocation", title, heads, tuple(sorted(rows, key=lambda row: row[3])), brief=True)


def _thinned(numbers: tuple[int, ...]) -> tuple[int, ...]:
    """At most `SHOWN` of a front, its ends among them."""
    picked = np.unique(np.linspace(0, len(numbers) - 1, min(SHOWN, len(numbers))).round().astype(int))
    return tuple(numbers[n] for n in picked)


def _figures(found: StudyResult) -> Iterator[Figure]:
    if found.rows.made.sum() > 1 and len(found.variables) + len(found.results) > 1:
        yield _cloud(found)
    if len(found.goals) == 2 and found.front:
        yield _front_plot(found)
    for result in found.results:
        for number, variable in enumerate(found.variables):
            plot = _response(found, result, number)
            if plot is not None and variable.continuous:
                yield plot
        yield from _surface_plot(found, result)
    for number, variable in enumerate(found.variables):
        if variable.continuous:
            yield from _failure_plot(found, number)


def shown_designs(found: StudyResult) -> np.ndarray:
    """Numbers of the designs that the picture of all designs shows: those made, or some of very many, and the front."""
    made = np.flatnonzero(found.rows.made)
    return np.union1d(made[:: max(1, -(-len(made) // MOST_POINTS))], np.array(found.front, dtype=int)).astype(int)


def _cloud(found: StudyResult) -> DesignCloud:
    """All designs that were made, each by what it is: on the front, held, or the check that it fails by most."""
    rows, failures = found.rows, [name for name, _ in _failures(found)]
    shown = shown_designs(found)
    words = [f"fails {name}" for name in failures]
    named = ("best" if len(found.goals) == 1 else "front", *words[:1], "holds", *words[1:])
    kind = np.full(len(shown), named.index("holds"))
    failing = ~rows.feasible[shown]
    if failures and failing.any():
        margins = found.margins[shown[failing]][:, [found.checks.index(name) for name in failures]]
        numbers = np.array([named.index(word) for word in words])
        kind[failing] = numbers[np.argmin(np.nan_to_num(margins, nan=np.inf), axis=1)]
    kind[np.isin(shown, found.front)] = 0
    variables = [Axis(v.name, v.unit if v.continuous else "") for v in found.variables]
    columns = (*variables, *(Axis(name, found.units[name]) for name in found.results))
    values = tuple(np.column_stack([rows.points[shown], rows.results[shown]]).T)
    commands = tuple(found.command(number) for number in shown.tolist())
    return DesignCloud("study-designs", "Designs", columns, values, named, kind, commands)


def _front_plot(found: StudyResult) -> Plot:
    first, second = found.goals
    chosen = list(found.front)
    x, y = found.values(first.result)[chosen], found.values(second.result)[chosen]
    number = best(found)
    at = float(found.values(first.result)[number]) if number is not None else float(x[0])
    axes = (Axis(first.result, found.units[first.result]), Axis(second.result, found.units[second.result]))
    return Plot("study-front", "Front of the two goals", *axes, (Series("front", x, y),), (Mark(at, "knee"),))


def _classes(found: StudyResult, number: int) -> tuple[FloatArray, np.ndarray]:
    """Middles of the classes of a variable, and the class of each design."""
    values = found.rows.points[:, number]
    edges = np.linspace(values.min(), values.max(), CLASSES + 1)
    return (edges[:-1] + edges[1:]) / 2, np.clip(np.searchsorted(edges, values, side="right") - 1, 0, CLASSES - 1)


def _response(found: StudyResult, result: str, number: int) -> Plot | None:
    """The result over a variable: mean and the 10 % and 90 % quantiles of the designs of each class, or all designs."""
    variable, values = found.variables[number], found.values(result)
    usable = np.isfinite(values)
    if usable.sum() < 2 or not np.ptp(found.rows.points[:, number]):
        return None
    axes = (Axis(variable.name, variable.unit), Axis(result, found.units[result]))
    name, title = f"study-{result}-{variable.name}", f"{result} over {variable.name}"
    if len(found.variables) == 1:
        order = np.argsort(found.rows.points[usable, 0])
        x, y = found.rows.points[usable, 0][order], values[usable][order]
        return Plot(name, title, *axes, (Series(result, x, y),))
    middles, classes = _classes(found, number)
    groups = [values[usable & (classes == n)] for n in range(CLASSES)]
    kept = [n for n, group in enumerate(groups) if len(group) >= LEAST_IN_CLASS]
    if len(kept) < 2:
        return None
    x = middles[kept]
    curves = {"mean": [groups[n].mean() for n in kept]}
    curves |= {f"{share:.0%} quantile": [np.quantile(groups[n], share) for n in kept] for share in (0.1, 0.9)}
    series = tuple(Series(label, x, np.array(y), dashed=label != "mean") for label, y in curves.items())
    return Plot(name, title, *axes, series, note="all other variables over their ranges")


def _surface_plot(found: StudyResult, result: str) -> Iterator[Plot]:
    """Lines of equal result over the two variables that do most to it, the others in the middle of their ranges."""
    own = [number for number, variable in enumerate(found.variables) if variable.continuous]
    values = found.values(result)
    points = found.rows.points[np.isfinite(values)][:, own]
    surface = surface_of(points, values[np.isfinite(values)]) if len(own) > 1 else None
    if surface is None or surface.explained < TRUSTED:
        return
    pair = sorted(np.argsort(surface.influence(points))[-2:].tolist())
    grid = np.tile((surface.low + surface.high) / 2, (NODES, NODES, 1))
    ends = [np.linspace(surface.low[n], surface.high[n], NODES) for n in pair]
    grid[:, :, pair[0]], grid[:, :, pair[1]] = np.meshgrid(*ends)
    field = surface.at(grid.reshape(-1, len(own))).reshape(NODES, NODES)
    factor, unit = parse_unit(found.units[result]).factor, found.units[result]
    levels = ticks(field.min() / factor, field.max() / factor, unit, LEVELS)
    series = []
    for level, words in zip(levels, tick_labels(levels), strict=True):
        line = _level_line(field, level * factor)
        x, y = (np.interp(at, np.arange(NODES), end, np.nan, np.nan) for at, end in zip(line, ends, strict=True))
        series.append(Series(f"{words} {printed_unit(unit)}".strip(), x, y))
    first, second = (found.variables[own[n]] for n in pair)
    title = f"{result} over {first.name} and {second.name}"
    note = f"quadratic fit: it explains {surface.explained:.1%} of the variance"
    axes = (Axis(first.name, first.unit), Axis(second.name, second.unit))
    yield Plot(f"study-surface-{result}", title, *axes, tuple(series), note=note)


def _level_line(field: FloatArray, level: float) -> tuple[FloatArray, FloatArray]:
    """Columns and rows of the points at a level, lines one after another; outside the field, and between lines, NaN."""
    padded = np.pad(field, 1, constant_values=min(field.min(), level) - 1.0)
    lines = [np.append(line, (line[0], np.nan)) - (1 + 1j) for line in level_polygons(padded, level)]
    points = np.concatenate([*lines, [np.nan * 1j]])
    points[(np.minimum(points.real, points.imag) < 0) | (np.maximum(points.real, points.imag) > NODES - 1)] = np.nan
    return points.real, points.imag


def _failure_plot(found: StudyResult, number: int) -> Iterator[Plot]:
    """The share of the designs that fail each of the most frequent checks, over a variable."""
    failures = _failures(found)[:4]
    if not failures or len(found.rows.points) < CLASSES * LEAST_IN_CLASS:
        return
    middles, classes = _classes(found, number)
    made = np.array([(found.rows.made & (classes == n)).sum() for n in range(CLASSES)])
    kept = np.flatnonzero(made >= LEAST_IN_CLASS)
    if len(kept) < 2:
        return
    series = []
    for name, _ in failures:
        failing = found.margins[:, found.checks.index(name)] < 0
        shares = np.array([(failing & (classes == n)).sum() for n in kept]) / made[kept]
        series.append(Series(name, middles[kept], shares))
    variable = found.variables[number]
    axes = (Axis(variable.name, variable.unit), Axis("designs that fail", "%"))
    yield Plot(f"study-failures-{variable.name}", f"Failed checks over {variable.name}", *axes, tuple(series))
