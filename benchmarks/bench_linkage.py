"""A four-bar's position, velocity and acceleration at a million crank angles: the general engine beside its peers.

Every line runs in a process of its own, one after the other, on one core, and its processor time is printed: the same
linkage (the beat-up's: 300, 59.7, 200.7, 230.8 mm) at constant crank speed. C and NumPy by hand are this one linkage's
formulas written out in real arithmetic, without arc functions: nothing general, the least work a person would leave in
them. pylinkage is run by its compiled path, to which it hands no batch of angles: it steps; `mechanism` by its
`iterate`, at fewer angles.
"""

import ctypes
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import mechanism
import numpy as np
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import RRRDyad
from pylinkage.simulation import Linkage

from ilmek.arrays import FloatArray
from ilmek.linkage.batch import batch_arrays, solve_batch, sweep
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import BLOCK, solve
from ilmek.linkage.structure import plan

SAMPLES = 1_000_000
SPEED = 15.5
GROUND, CRANK, COUPLER, ROCKER = 0.3, 0.0597, 0.2007, 0.2308
FEW = 1_000
"""Angles for the peer that takes milliseconds for each."""

VARIANTS, POSITIONS = 10_000, 360
COLUMNS = ("coupler x", "coupler y", "rocker x", "rocker y", "coupler w", "rocker w", "coupler a", "rocker a")


def by_hand(angle: FloatArray) -> tuple[FloatArray, ...]:
    """The columns above: directions of coupler and rocker, their angular velocities and accelerations."""
    g, a, b, c = GROUND, CRANK, COUPLER, ROCKER
    ax, ay = a * np.cos(angle), a * np.sin(angle)
    dx, dy = g - ax, -ay
    dd = dx * dx + dy * dy
    along = 0.5 + 0.5 * (b * b - c * c) / dd
    across = np.sqrt(b * b / dd - along * along)
    ux, uy = along * dx - across * dy, along * dy + across * dx
    vx, vy = ux - dx, uy - dy
    sine = ux * vy - uy * vx
    rx, ry = SPEED * ay, -SPEED * ax
    wb, wc = (vx * rx + vy * ry) / sine, (ux * rx + uy * ry) / sine
    rx = SPEED * SPEED * ax + wb * wb * ux - wc * wc * vx
    ry = SPEED * SPEED * ay + wb * wb * uy - wc * wc * vy
    return ux / b, uy / b, vx / c, vy / c, wb, wc, (vx * rx + vy * ry) / sine, (ux * rx + uy * ry) / sine


def by_hand_in_blocks(angle: FloatArray) -> tuple[FloatArray, ...]:
    columns = tuple(np.empty_like(angle) for _ in COLUMNS)
    for start in range(0, len(angle), BLOCK):
        part = slice(start, start + BLOCK)
        for column, block in zip(columns, by_hand(angle[part]), strict=True):
            column[part] = block
    return columns


def as_columns(motion: Motion) -> tuple[FloatArray, ...]:
    coupler, rocker = motion.direction("coupler"), motion.direction("rocker")
    rates = (motion.omega("coupler"), motion.omega("rocker"), motion.alpha("coupler"), motion.alpha("rocker"))
    return coupler.real, coupler.imag, rocker.real, rocker.imag, *rates


ANGLE = np.arange(SAMPLES) * (2 * np.pi / SAMPLES)
BEAT_UP = plan(four_bar(GROUND, CRANK, COUPLER, ROCKER, branch=+1, points={"coupler": {"P": 0.1 + 0.05j}}))


def by_c() -> Callable[[tuple[FloatArray, ...]], tuple[FloatArray, ...]]:
    """The C reference, built by this machine's compiler; it writes into the columns it is given."""
    compiler, source = shutil.which("cc"), Path(__file__).with_name("four_bar.c")
    if compiler is None:
        sys.exit("no C compiler here: left out")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "four_bar.so"
        options = ["-O3", "-march=native", "-ffast-math", "-shared", "-fPIC"]
        subprocess.run([compiler, *options, str(source), "-o", str(library), "-lm"], check=True)
        four_bar_c = ctypes.CDLL(str(library)).four_bar
    numbers = [ctypes.c_double(one) for one in (GROUND, CRANK, COUPLER, ROCKER, SPEED)]

    def work(columns: tuple[FloatArray, ...]) -> tuple[FloatArray, ...]:
        places = [ctypes.c_void_p(array.ctypes.data) for array in (ANGLE, *columns)]
        four_bar_c(ctypes.c_long(SAMPLES), places[0], *numbers, *places[1:])
        return columns

    return work


def fresh() -> tuple[FloatArray, ...]:
    return tuple(np.empty(SAMPLES) for _ in COLUMNS)


def c_fresh() -> Callable[[], Any]:
    work = by_c()
    return lambda: work(fresh())


def c_kept() -> Callable[[], Any]:
    work, kept = by_c(), fresh()
    return lambda: work(kept)


def batch_kept() -> Callable[[], Any]:
    kept = batch_arrays(BEAT_UP, SAMPLES)
    return lambda: solve_batch(BEAT_UP, ANGLE, SPEED, into=kept)


def pylinkage() -> Callable[[], Any]:
    """The peer's run over all samples: positions, velocities and accelerations of every pin."""
    first, second = Ground(0.0, 0.0, name="A0"), Ground(GROUND, 0.0, name="B0")
    crank = Crank(anchor=first, radius=CRANK, angular_velocity=2 * np.pi / SAMPLES, name="A")
    dyad = RRRDyad(anchor1=crank.output, anchor2=second, distance1=COUPLER, distance2=ROCKER, name="B")
    linkage = Linkage([first, second, crank, dyad], name="four-bar")
    linkage.set_input_velocity(crank, SPEED)
    linkage.compile()
    return lambda: linkage.step_fast_with_kinematics(SAMPLES)


def by_mechanism() -> Callable[[], Any]:
    """The peer's own vector loop, solved by its `iterate` at a few angles."""
    joints = mechanism.get_joints("A0 A B B0")
    crank = mechanism.Vector((joints[0], joints[1]), r=CRANK)
    coupler, rocker = (
        mechanism.Vector((joints[1], joints[2]), r=COUPLER),
        mechanism.Vector((joints[3], joints[2]), r=ROCKER),
    )
    ground = mechanism.Vector((joints[0], joints[3]), r=GROUND, theta=0)

    def loops(x: Any, i: Any) -> Any:
        return np.ravel(crank(i) + coupler(x[0]) - rocker(x[1]) - ground())

    start = by_hand(np.zeros(1))
    guess = [np.arctan2(start[1], start[0])[0], np.arctan2(start[3], start[2])[0]]
    moved = mechanism.Mechanism(
        vectors=(crank, coupler, rocker, ground),
        origin=joints[0],
        loops=loops,
        pos=np.linspace(0, 2 * np.pi, FEW),
        vel=np.full(FEW, SPEED),
        acc=np.zeros(FEW),
        guess=(np.array(guess), np.zeros(2), np.zeros(2)),
    )
    work: Callable[[], Any] = moved.iterate
    return work


def variants(*, margins: bool) -> Callable[[], Any]:
    """Many different four-bars: the motion of coupler and rocker, or whether they turn and how well."""
    rng = np.random.default_rng(1)
    lengths = {("crank", "A"): rng.uniform(0.02, 0.06, VARIANTS), ("rocker", "B"): rng.uniform(0.2, 0.25, VARIANTS)}
    angle = np.arange(POSITIONS) * (2 * np.pi / POSITIONS)
    bodies = () if margins else ("coupler", "rocker")
    return lambda: sweep(BEAT_UP, lengths, angle, SPEED, bodies=bodies)


JOBS: dict[str, tuple[int, Callable[[], Callable[[], Any]]]] = {
    "ilmek solve_batch": (SAMPLES, lambda: lambda: solve_batch(BEAT_UP, ANGLE, SPEED)),
    "ilmek solve_batch, into arrays made once": (SAMPLES, batch_kept),
    "ilmek solve": (SAMPLES, lambda: lambda: solve(BEAT_UP, ANGLE, SPEED)),
    "ilmek solve, then a coupler point's motion": (
        SAMPLES,
        lambda: lambda: solve(BEAT_UP, ANGLE, SPEED).point("coupler", "P"),
    ),
    "C by hand, into new arrays, as all others": (SAMPLES, c_fresh),
    "C by hand, into arrays made once": (SAMPLES, c_kept),
    "NumPy by hand, in blocks": (SAMPLES, lambda: lambda: by_hand_in_blocks(ANGLE)),
    "NumPy by hand, whole arrays": (SAMPLES, lambda: lambda: by_hand(ANGLE)),
    f"pylinkage {version('pylinkage')}, compiled": (SAMPLES, pylinkage),
    f"mechanism {version('mechanism')}, {FEW} states": (FEW, by_mechanism),
    f"sweep, {VARIANTS} four-bars x {POSITIONS}": (VARIANTS * POSITIONS, lambda: variants(margins=False)),
    "the same, statuses and margins alone": (VARIANTS * POSITIONS, lambda: variants(margins=True)),
}
"""What is run: states in all, and the making of it."""

NEW = "ilmek solve_batch", "C by hand, into new arrays, as all others"
KEPT = "ilmek solve_batch, into arrays made once", "C by hand, into arrays made once"
"""Pairs on the same terms."""


def best(work: Callable[[], Any], times: int = 7) -> float:
    """The least processor time of several runs [s], all on one core; the machine may be busy with other things."""
    work()
    taken = []
    for _ in range(times):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return min(taken)


def measured(name: str) -> str:
    """A job's best time [s], or why there is none, from a process of its own."""
    command = [sys.executable, "-m", "benchmarks.bench_linkage", name]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    return ended.stdout.split()[-1] if ended.returncode == 0 else ended.stderr.strip().splitlines()[-1]


def start_up(statement: str) -> float:
    """Processor time to start Python and run a statement [s], the best of several."""
    script = f"import time\n{statement}\nprint(time.process_time())"
    ends = [
        subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True) for _ in range(5)
    ]
    return min(float(end.stdout) for end in ends)


def run() -> None:
    theirs = by_hand(ANGLE)
    for name, motion in (("solve", solve(BEAT_UP, ANGLE, SPEED)), ("solve_batch", solve_batch(BEAT_UP, ANGLE, SPEED))):
        apart = max(float(np.abs(x - y).max()) for x, y in zip(as_columns(motion), theirs, strict=True))
        print(f"{name} and NumPy by hand differ by at most {apart:.1e} (directions, rad/s, rad/s^2)")
    ours = 0.0
    found: dict[str, float] = {}
    print(f"{'':46s}{'s CPU':>9s}{'ns a state':>12s}{'against ours':>14s}")
    for name, (states, _) in JOBS.items():
        taken = measured(name)
        try:
            each = float(taken) / states * 1e9
        except ValueError:
            print(f"{name:46s}{taken}")
            continue
        ours, found[name] = ours or each, each
        print(f"{name:46s}{float(taken):9.4f}{each:12.1f}{each / ours:13.2f}x", flush=True)
    for terms, of, c in (("new arrays", *NEW), ("arrays made once", *KEPT)):
        if of in found and c in found:
            print(f"ilmek against C, {terms}: {found[of] / found[c]:.2f}")
    bare = start_up("pass")
    for statement in ("import ilmek", "import ilmek.linkage.solve", "import ilmek.linkage.batch"):
        print(f"{statement:46s}{start_up(statement) - bare:9.3f} s beyond Python's own start of {bare:.3f} s")


if __name__ == "__main__":
    print(best(JOBS[sys.argv[1]][1]()))
