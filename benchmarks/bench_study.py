"""The cost of a study beside that of its designs: our layer, Optuna's beside it if it is installed, and processes.

The function costs nothing: what is left is drawing, judging, and writing a row. The peer is a study of Optuna with its
SQLite file and the same two variables; it keeps as much of a design as we do, without checks.
"""

import os
import tempfile
import time
from collections.abc import Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import numpy as np

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
from ilmek.studies.outcome import Numbers, Question, evaluated
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
    if find_spec("optuna") is None:
        print("optuna is not installed")
        return
    optuna = import_module("optuna")
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    start = time.process_time()
    peer = optuna.create_study(storage=f"sqlite:///{folder}/peer.sqlite", sampler=optuna.samplers.QMCSampler(seed=0))
    peer.optimize(lambda trial: trial.suggest_float("x", 0, 1) * trial.suggest_float("y", 0, 1), n_trials=PEER)
    taken = (time.process_time() - start) / PEER
    print(f"optuna: {taken * 1e6:.0f} us a design, {(folder / 'peer.sqlite').stat().st_size / PEER:.0f} bytes")


def processes() -> None:
    """Beat-ups a second, by number of processes; start of the processes included."""
    order = StudyOrder("beat-up", {}, {"swing": "25deg..35deg"}, ("drive_torque_max",), samples=BEAT_UPS)
    seconds = []
    for count in (1, min(os.cpu_count() or 1, 2)):
        start = time.perf_counter()
        study(order, workers=count)
        seconds.append(time.perf_counter() - start)
        print(f"beat-up, {count} processes: {BEAT_UPS / seconds[-1]:.0f} designs/s")
    print(f"speed-up {seconds[0] / seconds[-1]:.2f}")


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
    processes()
