"""Cams: what one costs, ten thousand at once, and two public packages' cams beside ours.

pylinkage 1.3 has a modified trapezoid; mechanism 1.1 exports the profile of a cam. Their errors are against what the
law and the follower demand: a displacement without jumps, and the envelope of the flat face, which for a harmonic rise
and fall over half a turn each is a circle.
"""

import io
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from benchmarks.cam_sweep import requirements, sweep
from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams import limits
from ilmek.cams.flat import FlatCam
from ilmek.cams.laws import LAWS
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.machines.cam import MACHINE, CamParams, design
from ilmek.num.piecewise import supremum
from ilmek.units import deg, mm

RUNS = 9
ANGLES = np.linspace(0.0, 2 * np.pi, 3600, endpoint=False)
COUNT = 10_000


def run() -> None:
    one_cam()
    many_cams()
    trapezoids()
    flat_faces()


def taken(work: Callable[[], object]) -> float:
    """Median time of a run [s], after one that does not count."""
    work()
    times = []
    for _ in range(RUNS):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return statistics.median(times)


def one_cam() -> None:
    """Profile, pressure angle and curvature at 3,600 places, and a whole design."""
    law = LAWS["modified-sine"]
    programme = CamProgramme((rise(1.5, 0.06, law), fall(1.5, 0.06, law), dwell(2 * np.pi - 3)))
    cam = PlateCam(programme, 0.09, 0.005, 0.011)

    def places() -> None:
        trace = cam.trace(ANGLES)
        _ = trace.surface, trace.pressure_angle, trace.curvature

    params = CamParams(law="modified-sine", lift=0.06, pressure_angle_limit=30 * deg)
    print(f"profile, pressure angle, curvature, 3600 places   {taken(places) * 1e3:8.2f} ms   (asked: 1 ms)")
    print(f"machine cam: design                               {taken(lambda: design(params)) * 1e3:8.2f} ms")
    both = taken(lambda: MACHINE.report(design(params)))
    print(f"machine cam: design and report                    {both * 1e3:8.2f} ms")


def many_cams() -> None:
    """Laws by sizes by limits at once, beside the same designs one by one."""
    rng = np.random.default_rng(1)
    laws = list(LAWS.values())
    lift, span, limit = rng.uniform(0.01, 0.08, COUNT), rng.uniform(0.9, 3.0, COUNT), rng.uniform(0.35, 0.8, COUNT)
    which = np.arange(COUNT) % len(laws)
    asked = requirements(
        COUNT, law=which, lift=lift, rise=span, limit=limit, roller_radius=1 * mm, mass=1.0, speed=10.0
    )

    def alone(i: int) -> None:
        law = laws[which[i]]
        turn = (rise(span[i], lift[i], law), fall(span[i], lift[i], law), dwell(2 * np.pi - 2 * span[i]))
        programme = CamProgramme(turn)
        prime = pressure_prime(programme, CamLimits(rise=limit[i])).value
        cam = PlateCam(programme, prime, 0.0, 1 * mm)
        _ = limits.pressure_angle_max(cam, "rise"), limits.undercut(cam), limits.area(cam)

        def torque(angle: FloatArray) -> FloatArray:
            at = programme.at(angle)
            return np.asarray(np.abs(100.0 * at.dds * at.ds))

        _ = supremum(torque, programme.knots)

    def some() -> None:
        for i in range(50):
            alone(i)

    together, single = taken(lambda: sweep(laws, asked)), taken(some) / 50 * COUNT
    print(f"{COUNT} cams (law x size x limits) swept at once  {together:8.2f} s    (asked: 2 s)")
    print(f"{COUNT} cams, each alone, by 50 of them         {single:8.2f} s    {single / together:.0f} times as long")


def trapezoids() -> None:
    """The modified trapezoid: its largest jump between neighbours of 100,000, and its peak acceleration."""
    from pylinkage.cam.motion_laws import ModifiedTrapezoidalMotionLaw  # noqa: PLC0415

    u = np.linspace(0.0, 1.0, 100_001)
    theirs = ModifiedTrapezoidalMotionLaw()
    law = LAWS["modified-trapezoid"]
    exact = 8 * np.pi / (np.pi + 2)
    rows = {
        "pylinkage": np.array([theirs.displacement(float(at)) for at in u]),
        "ilmek": np.asarray(law.s(u)),
    }
    print("\nmodified trapezoid                largest step of s    s(1/2) - 1/2    peak of s'' (exact 4.888124)")
    for name, s in rows.items():
        bend = np.max(np.abs(np.diff(s, 2))) / (u[1] - u[0]) ** 2
        print(f"  {name:30s}  {np.max(np.abs(np.diff(s))):12.6f}   {s[50_000] - 0.5:14.6f}      {bend:.6g}")
    print(f"  steps of a law with its peak velocity of 2 are at most {2 * (u[1] - u[0]):.6f}; exact peak {exact:.6f}")


def flat_faces() -> None:
    """The profile for a flat-faced follower, lift 20 mm, base radius 30 mm: a circle of 40 mm."""
    law = LAWS["harmonic"]
    ours = FlatCam(CamProgramme((rise(np.pi, 20 * mm, law), fall(np.pi, 20 * mm, law))), 30 * mm)
    rows = {"mechanism": exported_profile(), "ilmek": ours.trace(ANGLES).surface}
    print("\nflat-faced harmonic cam           radius of fit    off its fit by    off the circle of 40 mm by")
    for name, points in rows.items():
        centre, radius = circle_through(points)
        fit = float(np.max(np.abs(np.abs(points - centre) - radius)))
        off = float(np.max(np.abs(np.abs(points - exact_centre(points)) - 40 * mm)))
        print(f"  {name:30s}  {radius / mm:10.4f} mm    {fit / mm:.2e} mm    {off / mm:.2e} mm")


def exported_profile() -> ComplexArray:
    """What the package `mechanism` writes to a file for this cam."""
    import matplotlib as mpl  # noqa: PLC0415

    mpl.use("Agg")
    from mechanism.cams import Cam  # noqa: PLC0415

    cam = Cam(motion=[("Rise", 20 * mm, 180), ("Fall", 20 * mm, 180)], degrees=True, omega=1.0)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "cam.csv"
        cam.save_coordinates(str(file), kind="harmonic", base=30 * mm)
        table = np.loadtxt(io.StringIO(file.read_text()), delimiter=",", skiprows=1)
    return np.asarray(table[:, 0] + 1j * table[:, 1])


def circle_through(points: ComplexArray) -> tuple[complex, float]:
    """Centre and radius of the circle nearest to points, least squares."""
    matrix = np.stack([2 * points.real, 2 * points.imag, np.ones(points.size)], axis=1)
    x, y, rest = np.linalg.lstsq(matrix, np.abs(points) ** 2, rcond=None)[0]
    return complex(x, y), float(np.sqrt(rest + x**2 + y**2))


def exact_centre(points: ComplexArray) -> complex:
    """10 mm from the axis towards the highest place."""
    far = points[np.argmax(np.abs(points))]
    return complex(10 * mm * far / abs(far))
