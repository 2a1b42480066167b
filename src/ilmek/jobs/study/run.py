"""A study: from its order to the results file and what follows from it."""

import math
import tempfile
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import IlmekError, ParameterError
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.study.given_designs import read_designs
from ilmek.jobs.study.order import (
    SAMPLES,
    Goal,
    StudyOrder,
    check_words,
    names_of,
    read_correlations,
    read_goal,
    read_hold,
    read_variable,
)
from ilmek.jobs.study.targets import PLAYS, MachineTarget, StudyTarget, read_target
from ilmek.num.pareto import front
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.report.framed import Framed
from ilmek.studies.allocation import Allocation, allocated, scaled
from ilmek.studies.fronts import evolve
from ilmek.studies.optimum import Optimum, optimum
from ilmek.studies.outcome import Hold, Numbers, Question
from ilmek.studies.recorder import DesignRecorder
from ilmek.studies.samples import correlation_of, sampled
from ilmek.studies.sensitivity import SensitivityIndex, local, morris, sobol
from ilmek.studies.store import StudyFile, StudyRows
from ilmek.studies.tolerance import ResultSpread, Yield, corners, spread_of, yield_of
from ilmek.studies.variable import Variable, settings_of
from ilmek.studies.workers import MOST_WORKERS, Workers

BLOCK = 65_536
"""Designs of a sweep that are in memory at once."""


@record
class StudyResult(Framed):
    """What a study found.

    rows        all designs               margins   of them, (designs, checks)
    front       numbers of the designs on the front of several goals; of one goal the best alone
    """

    order: StudyOrder
    target: StudyTarget
    variables: tuple[Variable, ...]
    results: tuple[str, ...]
    units: Mapping[str, str]
    goals: tuple[Goal, ...]
    holds: tuple[Hold, ...]
    rows: StudyRows
    margins: FloatArray
    checks: tuple[str, ...]
    reasons: tuple[tuple[str, str, int], ...]
    digest: str
    front: tuple[int, ...] = ()
    sensitivities: tuple[SensitivityIndex, ...] = ()
    yielded: Yield | None = None
    spreads: tuple[ResultSpread, ...] = ()
    allocation: Allocation | None = None
    optimum: Optimum | None = None
    file: Path | None = None

    def values(self, name: str) -> np.ndarray:
        """The values of a variable or a result over the designs [SI]; of choices that are texts, the texts."""
        table = self.table()
        return table[f"{name} (result)" if name in self.results and f"{name} (result)" in table else name]

    def table(self) -> dict[str, np.ndarray]:
        """All designs as columns [SI]: variables, results, failed checks, least margin."""
        varied = {v.name: v.column(points) for v, points in zip(self.variables, self.rows.points.T, strict=True)}
        heads = (f"{name} (result)" if name in varied else name for name in self.results)
        found = dict(zip(heads, self.rows.results.T, strict=True))
        return {**varied, **found, "failed": self.rows.failed, "worst": self.rows.worst}

    def varied(self, number: int) -> dict[str, str]:
        """What varies of a design, as texts with units, its pins without play."""
        pairs = zip(self.variables, self.rows.points[number], strict=True)
        return {v.name: v.shown(x).replace(" ", "") for v, x in pairs if v.name.partition(".")[0] not in PLAYS}

    def command(self, number: int) -> str:
        """The command line that makes a design."""
        command = "design" if isinstance(self.target, MachineTarget) else "mechanism"
        sets = (f"--set {name}={value}" for name, value in {**self.order.fixed, **self.varied(number)}.items())
        return " ".join(("ilmek", command, self.order.target, *sets))


def study(
    order: StudyOrder,
    file: Path | None = None,
    *,
    replace: bool = False,
    workers: int = 1,
    cluster: str | None = None,
    target: StudyTarget | None = None,
    progress: Progress = SILENT,
) -> StudyResult:
    """Carry out a study; designs that its results file has already are not computed again.

    file     where the designs are kept; None: nowhere
    replace  a file that exists is removed first, once the order is read
    target   what is studied; default: read by its name in the order
    Raises ParameterError for an order that cannot be read, or a file of another study; errors of the target;
    OutputError; Cancelled, after which the file has all designs until then.
    """
    check_words(order)
    if not 1 <= workers <= MOST_WORKERS:
        raise ParameterError(f"--workers {workers}", allowed=f"1 to {MOST_WORKERS}")
    target = target or read_target(order.target, order.fixed, MotionRequest({}, order.over, order.speed))
    given = read_designs(target, Path(order.designs)) if order.designs else None
    variables = given[0] if given else tuple(read_variable(target, name, text) for name, text in order.vary.items())
    for name in {variable.name for variable in variables} & order.fixed.keys():
        raise ParameterError(f"{name} varies and is set", do="leave out one of --vary and --set")
    units = _first(target, variables).units
    goals = tuple(read_goal(text, units) for text in order.goals)
    holds = tuple(read_hold(text, units) for text in order.holds)
    named = (*(goal.result for goal in goals), *(hold.result for hold in holds), *names_of(order.record, units))
    results = tuple(dict.fromkeys(named))
    order, samples = _counted(order, variables)
    plan = _plan(order, target, variables, results, goals, holds)
    with ExitStack() as stack:
        if file is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory())
        path = file or Path(folder) / "study.sqlite"
        if replace:
            path.unlink(missing_ok=True)
        kept = stack.enter_context(StudyFile(path, plan, [v.name for v in variables], results))
        running = stack.enter_context(Workers(Question(target, results, holds, order.time_limit), workers, cluster))
        recorder = DesignRecorder(kept, variables, running, len(given[1]) if given else samples, progress)
        found = (
            _swept(recorder, given[1]) if given else _METHODS[order.method](recorder, order, samples, goals, results)
        )
        rows, margins = kept.designs(), kept.margins()
        best = _front(rows, goals, results)
        return StudyResult(
            order, target, variables, results, units, goals, holds, rows, margins, kept.checks,
            tuple(kept.reasons()), kept.digest(), best, file=file, **found,
        )  # fmt: skip


def _counted(order: StudyOrder, variables: tuple[Variable, ...]) -> tuple[StudyOrder, int]:
    """The order with its number of designs; a sweep of listed values alone has each of their combinations once."""
    if order.samples is None and order.method == "sweep" and all(variable.choices for variable in variables):
        every = math.prod(len(variable.choices) for variable in variables)
        return replace(order, sampling="grid", samples=every), every
    samples = order.samples or SAMPLES[order.method]
    return replace(order, samples=samples), samples


def _plan(  # noqa: PLR0917 - all that distinguishes a study
    order: StudyOrder,
    target: StudyTarget,
    variables: tuple[Variable, ...],
    results: tuple[str, ...],
    goals: tuple[Goal, ...],
    holds: tuple[Hold, ...],
) -> JsonObject:
    """What is studied, as plain data: the header of the results file."""
    plan: JsonObject = {
        "target": dict(target.identity),
        "variables": [[v.name, v.low, v.high, v.nominal, v.spread, list(v.choices)] for v in variables],
        "results": list(results),
        "goals": [goal.text for goal in goals],
        "holds": [[hold.result, hold.relation, hold.limit] for hold in holds],
        "method": [order.method, order.sampling, order.samples, order.seed],
    }
    if order.correlate or order.yield_target:
        plan["tolerances"] = [list(order.correlate), order.yield_target, dict(order.costs)]
    return plan


def _first(target: StudyTarget, variables: tuple[Variable, ...]) -> Numbers:
    """The nominal design, or that in the middle of the ranges: it has the names of the results.

    Raises the error of the nominal one where neither can be made.
    """
    middle = np.array([(v.low + v.high) / 2 if v.continuous else v.nominal for v in variables])
    try:
        return target.numbers(settings_of(variables, np.array([v.nominal for v in variables])))
    except IlmekError as error:
        try:
            return target.numbers(settings_of(variables, middle))
        except IlmekError:
            raise error from None


def _front(rows: StudyRows, goals: tuple[Goal, ...], results: tuple[str, ...]) -> tuple[int, ...]:
    """Designs that hold of which none is better in every goal, the first goal ascending."""
    usable = np.flatnonzero(rows.feasible)
    if not goals or not len(usable):
        return ()
    costs = np.column_stack([goal.sign * rows.results[usable, results.index(goal.result)] for goal in goals])
    best = front(costs)
    _, first = np.unique(costs[best], axis=0, return_index=True)
    return tuple(int(number) for number in usable[best][first])


def _sweep(recorder: DesignRecorder, order: StudyOrder, samples: int, _goals: object, _results: object) -> JsonObject:
    return _swept(recorder, sampled(recorder.variables, order.sampling, samples, order.seed))


def _swept(recorder: DesignRecorder, points: FloatArray) -> JsonObject:
    for start in range(0, len(points), BLOCK):
        recorder(points[start : start + BLOCK])
    return {}


def _sensitivity(
    recorder: DesignRecorder, order: StudyOrder, samples: int, _goals: object, results: tuple[str, ...]
) -> JsonObject:
    def evaluate(points: FloatArray) -> FloatArray:
        return np.asarray(recorder(points).results)

    if order.method == "local":
        return {"sensitivities": local(recorder.variables, results, evaluate)}
    measure = morris if order.method == "morris" else sobol
    return {"sensitivities": measure(recorder.variables, results, evaluate, samples, order.seed)}


def _tolerance(
    recorder: DesignRecorder, order: StudyOrder, samples: int, _goals: object, results: tuple[str, ...]
) -> JsonObject:
    variables, sampling = recorder.variables, "latin" if order.sampling == "grid" else order.sampling
    correlation = correlation_of(variables, read_correlations(order.correlate))
    drawn = recorder(sampled(variables, sampling, samples, order.seed, correlation))
    margins = recorder.file.margins(0, samples)
    ends = recorder(corners(variables))
    allocation = None
    if order.yield_target:
        made = drawn.made
        allocation = allocated(
            variables, drawn.points[made], margins[made], order.yield_target, order.costs, correlation
        )
        new = recorder(sampled(scaled(variables, allocation.factors), sampling, samples, order.seed, correlation))
        allocation = replace(allocation, found=yield_of(new.feasible))
    return {
        "yielded": yield_of(drawn.feasible),
        "allocation": allocation,
        "spreads": tuple(
            spread_of(name, variables, drawn.points, drawn.results[:, number], ends.results[:, number])
            for number, name in enumerate(results)
            if np.isfinite(drawn.results[:, number]).sum() > 1
        ),
    }


def _optimum(
    recorder: DesignRecorder, order: StudyOrder, samples: int, goals: tuple[Goal, ...], results: tuple[str, ...]
) -> JsonObject:
    columns = [results.index(goal.result) for goal in goals]
    signs = np.array([goal.sign for goal in goals])

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        first = recorder.evaluations
        rows = recorder(points)
        return rows.results[:, columns] * signs, recorder.file.margins(first, first + len(points))

    if len(goals) > 1:
        evolve(recorder.variables, len(goals), judge, samples, order.seed)
        return {}

    def single(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        values, margins = judge(points)
        return values[:, 0], margins

    return {"optimum": optimum(recorder.variables, single, samples, order.seed)}


_METHODS = {
    "sweep": _sweep,
    "local": _sensitivity,
    "morris": _sensitivity,
    "sobol": _sensitivity,
    "tolerance": _tolerance,
    "optimum": _optimum,
}
