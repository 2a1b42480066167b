"""Studies of machines and mechanisms: sweeps, sensitivities, tolerances, optima."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from ilmek.arguments import Arguments
from ilmek.io.mechanism_file import MechanismFile, with_values
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.study.order import StudyOrder
from ilmek.jobs.study.run import StudyResult
from ilmek.jobs.study.run import study as carried_out
from ilmek.jobs.study.targets import MechanismTarget, target_of_data
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress

Studied = str | Path | MechanismFile
"""A machine by its name, a file by its path, or a mechanism file that was read."""


def study(
    target: Studied,
    vary: Mapping[str, str] | str | Path,
    /,
    *,
    goals: Sequence[str] = (),
    hold: Sequence[str] = (),
    record: Sequence[str] = (),
    fixed: Mapping[str, Setting] = MappingProxyType({}),
    method: str = "sweep",
    sampling: str = "sobol",
    samples: int | None = None,
    seed: int = 0,
    correlate: Sequence[str] = (),
    yield_target: float = 0.0,
    costs: Mapping[str, float] = MappingProxyType({}),
    file: str | Path | None = None,
    workers: int = 1,
    cluster: str | None = None,
    progress: Progress = SILENT,
) -> StudyResult:
    """Study a machine of the catalogue, a machine file or a mechanism file over ranges of its parameters.

    target    name, path, or a file that was read: its `values` vary

    vary      name -> range "20deg..40deg", values "5, 6, 8", tolerance "80mm+-0.05mm" or class "20mm H7"; a
              distribution may follow: uniform, normal, triangular; or a table of designs (CSV), a column a parameter
    goals     results to make least, or "most NAME"          hold     limits, "transmission_angle_min >= 40deg"
    record    further results to keep                        fixed    settings that do not vary
    method    sweep, local, morris, sobol, tolerance, optimum
    sampling  sobol, latin, grid                             samples  number of designs; default: by the method
    correlate  correlations of tolerances, "a, b = 0.8"
    yield_target  find the tolerances of least cost for it [1]     costs  variable -> relative cost of its tolerance
    file      results file (SQLite); designs that it has are not computed again; default: none is kept
    workers   processes                                      cluster  address of a Dask scheduler
    The results are arrays: `values(name)`, `table()`, `frame()`, `rows.feasible`, `front`. Raises ParameterError for
    words that cannot be read, and for a file of another study; errors of the target; OutputError; Cancelled.

    >>> found = study("beat-up", {"swing": "25deg..35deg"}, goals=["drive_torque_max"], samples=4)
    >>> len(found.values("swing")), bool(found.rows.feasible.any())
    (4, True)
    """
    given = Arguments("a study")
    table = isinstance(vary, str | Path)
    settings = given.mapping("fixed", fixed, lambda _, value: value)
    read = _read_already(target, settings) if isinstance(target, MechanismFile) else None
    order = StudyOrder(
        target.source.name if isinstance(target, MechanismFile) else str(given.path("target", target)),
        settings,
        {} if table else given.mapping("vary", vary, given.text),
        given.sequence("goals", goals, str),
        given.sequence("hold", hold, str),
        given.sequence("record", record, str),
        method=given.text("method", method),
        sampling=given.text("sampling", sampling),
        samples=None if samples is None else given.whole("samples", samples, least=1),
        seed=given.whole("seed", seed, least=0),
        correlate=given.sequence("correlate", correlate, str),
        yield_target=given.number("yield_target", yield_target),
        costs=given.mapping("costs", costs, given.number),
        designs=str(given.path("vary", vary)) if table else "",
    )
    return carried_out(
        order,
        None if file is None else given.path("file", file),
        workers=given.whole("workers", workers, least=1),
        cluster=None if cluster is None else given.text("cluster", cluster),
        target=read,
        progress=given.record("progress", progress, Progress),
    )


def optimise(
    target: Studied,
    vary: Mapping[str, str],
    /,
    least: str | Sequence[str],
    *,
    subject_to: Sequence[str] = (),
    samples: int | None = None,
    seed: int = 0,
    workers: int = 1,
    progress: Progress = SILENT,
) -> StudyResult:
    """The best design over ranges: `study` by its method `optimum`; every check of a design is a constraint.

    target, vary, samples, seed, workers, progress  as of `study`
    least       result to be made least, or "most NAME"; of several `front` has those of which no other is better in all
    subject_to  limits, "transmission_angle_min >= 40deg"
    `front` has the number of the best design, `optimum` what the limits cost. Raises as `study`.

    >>> found = optimise("cam", {"lift": "20mm..30mm"}, "prime_radius", samples=16)
    >>> len(found.front)
    1
    """
    return study(
        target, vary, goals=(least,) if isinstance(least, str) else least, hold=subject_to, method="optimum",
        samples=samples, seed=seed, workers=workers, progress=progress,
    )  # fmt: skip


def _read_already(file: MechanismFile, settings: Mapping[str, Setting]) -> MechanismTarget:
    values = {name: str(value) for name, value in settings.items()}
    return target_of_data(with_values(file.data, values), MotionRequest({}))
