"""The cost of a study beside that of its designs: our layer, those of OpenMDAO and Optuna where they are installed, and
processes, of this machine and of a cluster.

The function costs nothing: what is left is drawing, judging, and writing a row. The peers keep the same designs of the
same two variables in their SQLite files, and find the least welded beam [Ragsdell and Phillips 1976], 1.724852.
"""

import tempfile
import time
from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from study_targets import beam_of  # type: ignore[import-not-found]

from ilmek import four_bar, solve
from ilmek.dynamics.inverse_run import inverse_run
from ilmek.io.mechanism_file import mechanism_of_data, mechanism_of_values
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.study.order import StudyOrder
from ilmek.jobs.study.run import study
from ilmek.jobs.study.targets import TOGETHER, MechanismTarget
from ilmek.params import Value
from ilmek.records import record
from ilmek.report import at_most
from ilmek.studies.optimum import optimum
from ilmek.studies.outcome import Numbers, Question, evaluated, margin
from ilmek.studies.recorder import DesignRecorder
from ilmek.studies.samples import sampled
from ilmek.studies.store import StudyFile
from ilmek.studies.variable import Variable
from ilmek.studies.workers import Workers

DESIGNS, PEER, BEAT_UPS = 100_000, 1_000, 400
VARIABLES = (Variable("x", "", 0.0, 1.0, 0.5), Variable("y", "", 0.0, 1.0, 0.5))


@record
class Product:
    """A design that costs nothing."""

    @property
    def identity(self) -> Mapping[str, object]:
        """Its name."""
        return {}

    together = 1

    def numbers_together(self, _designs: object, _results: object) -> dict[int, Numbers]:
        """None: each design is evaluated alone."""
        return {}

    def numbers(self, values: Mapping[str, Value], _only: object = None) -> Numbers:
        """x y, at most 0.5."""
        product = float(values["x"] or 0) * float(values["y"] or 0)
        return Numbers({"f": product}, {"f": ""}, (at_most("limit", product, 0.5, "1", "benchmark"),))


def layer(folder: Path) -> None:
    """Processor time and bytes of a design, of ours and of the peer."""
    start = time.process_time()
    with (
        StudyFile(folder / "ours.sqlite", {}, ["x", "y"], ["f"]) as file,
        Workers(Question(Product(), ("f",))) as workers,
    ):
        DesignRecorder(file, VARIABLES, workers, DESIGNS)(sampled(VARIABLES, "sobol", DESIGNS, 0))
    taken = (time.process_time() - start) / DESIGNS
    print(f"ours: {taken * 1e6:.0f} us a design, {(folder / 'ours.sqlite').stat().st_size / DESIGNS:.0f} bytes")
    points = sampled(VARIABLES, "sobol", PEER, 0)
    for name, peer in (("optuna", _optuna_sweep), ("openmdao", _openmdao_sweep)):
        if find_spec(name) is None:
            print(f"{name} is not installed")
            continue
        start = time.process_time()
        size = peer(import_module(name), points, folder)
        print(f"{name}: {(time.process_time() - start) / PEER * 1e6:.0f} us a design, {size / PEER:.0f} bytes")


def _optuna_sweep(optuna: Any, points: np.ndarray, folder: Path) -> int:
    """Bytes of Optuna's file of these designs."""
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    peer = optuna.create_study(storage=f"sqlite:///{folder}/optuna.sqlite")
    for x, y in points.tolist():
        peer.enqueue_trial({"x": x, "y": y})
    peer.optimize(lambda trial: trial.suggest_float("x", 0, 1) * trial.suggest_float("y", 0, 1), n_trials=len(points))
    return (folder / "optuna.sqlite").stat().st_size


def _openmdao_problem(api: Any, expression: str, **bounds: tuple[float, float]) -> Any:
    problem = api.Problem(reports=False)
    problem.model.add_subsystem("f", api.ExecComp(expression), promotes=["*"])
    for name, (low, high) in bounds.items():
        problem.model.add_design_var(name, lower=low, upper=high)
    problem.model.add_objective("f")
    return problem


def _openmdao_sweep(_: Any, points: np.ndarray, folder: Path) -> int:
    """Bytes of OpenMDAO's file of these designs."""
    api = import_module("openmdao.api")
    problem = _openmdao_problem(api, "f = x * y", x=(0.0, 1.0), y=(0.0, 1.0))
    problem.driver = api.DOEDriver(api.ListGenerator([[("x", x), ("y", y)] for x, y in points.tolist()]))
    problem.driver.add_recorder(api.SqliteRecorder(folder / "openmdao.sqlite"))
    problem.setup()
    problem.run_driver()
    problem.cleanup()
    return max(path.stat().st_size for path in folder.rglob("openmdao.sqlite"))


BEAM = {"a": (0.1, 2.0), "b": (0.1, 10.0), "c": (0.1, 10.0), "d": (0.1, 2.0)}
"""Bounds of the welded beam: weld, length, height, thickness [in]."""


def beam() -> None:
    """The least welded beam by our optimum, and by the drivers of the peers on the same function."""
    variables = tuple(Variable(name, "", low, high, (low + high) / 2) for name, (low, high) in BEAM.items())
    start, asked = time.process_time(), [0]

    def judge(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        asked[0] += len(points)
        found = [beam_of(point) for point in points.tolist()]
        margins = [[margin(check) for check in one.checks] for one in found]
        return np.array([one.results["f"] for one in found]), np.array(margins)

    ours = optimum(variables, judge, 3000, 0)
    print(f"beam, ours: {ours.goal:.6f}, {asked[0]} evaluations, {time.process_time() - start:.2f} s")
    for name, peer in (("openmdao", _openmdao_beam), ("optuna", _optuna_beam)):
        if find_spec(name) is not None:
            start = time.process_time()
            value, evaluations = peer()
            print(f"beam, {name}: {value:.6f}, {evaluations} evaluations, {time.process_time() - start:.2f} s")


def _openmdao_beam() -> tuple[float, int]:
    """SLSQP of OpenMDAO from the middle of the bounds, its derivatives by differences."""
    api = import_module("openmdao.api")
    asked = [0]

    class Beam(api.ExplicitComponent):  # type: ignore[misc, name-defined]
        def setup(self) -> None:
            for name, (low, high) in BEAM.items():
                self.add_input(name, (low + high) / 2)
            self.add_output("f")
            self.add_output("missed", np.zeros(5))
            self.declare_partials("*", "*", method="fd")

        def compute(self, inputs: Any, outputs: Any) -> None:
            asked[0] += 1
            found = beam_of([float(inputs[name][0]) for name in BEAM])
            outputs["f"] = found.results["f"]
            outputs["missed"] = [-margin(check) for check in found.checks]

    problem = api.Problem(reports=False)
    problem.model.add_subsystem("beam", Beam(), promotes=["*"])
    for name, (low, high) in BEAM.items():
        problem.model.add_design_var(name, lower=low, upper=high)
    problem.model.add_objective("f")
    problem.model.add_constraint("missed", upper=0.0)
    problem.driver = api.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-9, maxiter=200, disp=False)
    problem.setup()
    problem.run_driver()
    return float(problem.get_val("f")[0]), asked[0]


def _optuna_beam() -> tuple[float, int]:
    """Optuna's sampler for constraints (TPE) with a thousand trials."""
    optuna = import_module("optuna")
    optuna.logging.set_verbosity(optuna.logging.ERROR)

    def goal(trial: Any) -> float:
        found = beam_of([trial.suggest_float(name, *ends) for name, ends in BEAM.items()])
        trial.set_user_attr("missed", [-margin(check) for check in found.checks])
        return float(found.results["f"])

    sampler = optuna.samplers.TPESampler(seed=0, constraints_func=lambda trial: trial.user_attrs["missed"])
    peer = optuna.create_study(sampler=sampler)
    peer.optimize(goal, n_trials=PEER)
    held = [one.value for one in peer.trials if max(one.user_attrs["missed"]) <= 0]
    return min(held, default=np.inf), PEER


def processes() -> None:
    """Beat-ups a second in one process, in two, and on two workers of a cluster, which are there already."""
    order = StudyOrder("beat-up", {}, {"swing": "25deg..35deg"}, ("drive_torque_max",), samples=BEAT_UPS)
    alone = _seconds("one process", lambda: study(order))
    print(f"speed-up {alone / _seconds('two processes', lambda: study(order, workers=2)):.2f}")
    if find_spec("distributed") is None:
        return
    with import_module("distributed").LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
        there = _seconds("two workers of Dask", lambda: study(order, cluster=cluster.scheduler_address))
    print(f"speed-up {alone / there:.2f}")


def _seconds(title: str, work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    seconds = time.perf_counter() - start
    print(f"beat-up, {title}: {BEAT_UPS / seconds:.1f} designs/s")
    return seconds


def arrays() -> None:
    """Four-bars a second of processor time over a turn of 361 positions, as arrays: motion; all forces; one by one."""
    given = four_bar(0.3, 0.06, 0.2, 0.23)
    file = mechanism_of_data(FOUR_BAR)
    moved = given.vary(crank=np.linspace(0.04, 0.06, 5000))
    loaded = file.vary(a=np.linspace(0.04, 0.06, 500))
    forces = ["drive_torque_max", "pin_forces_max"]
    for title, variants, want in (
        ("motion", moved, ["coupler.B x"]),
        ("transmission angle", moved, ["transmission_angle_min"]),
        ("all forces", loaded, forces),
    ):
        variants.evaluate(361, want=want, speed=15.0)
        start = time.process_time()
        found = variants.evaluate(361, want=want, speed=15.0)
        print(f"four-bar, {title}: {found.closes.size / (time.process_time() - start):,.0f} designs/s")
    start = time.process_time()
    file.vary(a=np.linspace(0.04, 0.06, 200))
    print(f"four-bar, read from its file: {200 / (time.process_time() - start):,.0f} designs/s")
    question = Question(MechanismTarget(FOUR_BAR, "", MotionRequest({})), ("drive_torque_max",))
    designs = [{"a": float(crank)} for crank in np.linspace(0.04, 0.06, 256)]
    start = time.process_time()
    for first in range(0, len(designs), TOGETHER):
        evaluated(question, designs[first : first + TOGETHER])
    print(f"four-bar, forces and checks of a study: {len(designs) / (time.process_time() - start):,.0f} designs/s")
    start = time.process_time()
    for crank in np.linspace(0.04, 0.06, 20):
        machine = mechanism_of_values(FOUR_BAR, {"a": float(crank)}).machine
        motion = solve(machine.mechanism, np.linspace(0, 2 * np.pi, 361), speed=15.0)
        inverse_run(machine, motion, "crank", np.linspace(0, 2 * np.pi, 361) / 15.0)
    print(f"four-bar, all forces one by one: {20 / (time.process_time() - start):,.0f} designs/s")


FOUR_BAR = {
    "name": "four-bar",
    "gravity": "9.81m/s^2",
    "values": {"a": "60mm"},
    "bodies": {
        "ground": {"points": {"A0": [0, 0], "B0": ["300mm", 0]}},
        "crank": {"length": "a", "mass": "0.1kg"},
        "coupler": {"length": "200mm", "mass": "0.3kg"},
        "rocker": {"length": "230mm", "mass": "0.4kg"},
    },
    "joints": {
        "A0": {"pin": ["ground", "crank"]},
        "A": {"pin": ["crank", "coupler"]},
        "B": {"pin": ["coupler", "rocker"]},
        "B0": {"pin": ["ground", "rocker"]},
    },
    "inputs": {"A0": "crank"},
    "branches": {"B": 1},
}


def run() -> None:
    arrays()
    with tempfile.TemporaryDirectory() as folder:
        layer(Path(folder))
    beam()
    processes()
