"""The ten notebooks of the course: they run as they stand, and their results are those of textbooks and closed forms.

Each closed form is written here with numpy alone. Sources: Norton, Design of Machinery (examples 4-1, 4-2, 6-7 and 7-1,
table 3-1, chapters 8 and 13); Hartenberg and Denavit, Kinematic Synthesis of Linkages (Freudenstein's equation); Berkof
and Lowen 1969 (complete force balance).
"""

import ast
import json
from functools import cache
from typing import Any

import numpy as np
import pytest
from course_code import COURSE, NOTEBOOKS, code_cells

IMPORTS = {"ilmek", "numpy", "ilmek.units"}
MOST_LINES = 40
deg = np.pi / 180


@cache
def results(number: int) -> dict[str, Any]:
    """What the last cell of a notebook shows; every result that a cell shows is drawn."""
    (path,) = COURSE.glob(f"{number:02d}-*.ipynb")
    names: dict[str, Any] = {}
    shown: Any = None
    for cell in code_cells(path):
        *statements, last = ast.parse(cell).body
        if not isinstance(last, ast.Expr):
            statements.append(last)
        exec(compile(ast.Module(statements, []), path.name, "exec"), names)
        shown = eval(compile(ast.Expression(last.value), path.name, "eval"), names) if isinstance(last, ast.Expr) else 0
        drawn = [getattr(shown, kind)() for kind in ("_repr_html_", "_repr_svg_") if hasattr(shown, kind)]
        assert any(drawn) or not drawn
    assert isinstance(shown, dict)
    return shown


def met(theta, a, b, c, d, *, branch=+1):
    """Pins A and B of a four-bar from A0 = 0 and B0 = d: B where the circles about A and B0 meet."""
    A = a * np.exp(1j * theta)
    gap = d - A
    along = (np.abs(gap) ** 2 + b**2 - c**2) / (2 * np.abs(gap))
    return A, A + gap / np.abs(gap) * (along + 1j * branch * np.sqrt(b**2 - along**2))


def by_turn(values):
    """Second derivative by the crank angle of values at even steps of a turn, by its Fourier series."""
    order = np.fft.fftfreq(len(values), 1 / len(values))
    return np.fft.ifft(-(order**2) * np.fft.fft(values))


def slider(theta, r, rod, e=0.0):
    """Position of a slider and its two derivatives by the crank angle."""
    q, dq = r * np.sin(theta) - e, r * np.cos(theta)
    root = np.sqrt(rod**2 - q**2)
    second = -r * np.cos(theta) - (dq**2 - q * r * np.sin(theta)) / root - (q * dq) ** 2 / root**3
    return r * np.cos(theta) + root, -r * np.sin(theta) - q * dq / root, second


def test_the_course_has_ten_notebooks_on_its_page():
    page = (COURSE / "index.md").read_text(encoding="utf-8")
    assert [path.name[:2] for path in NOTEBOOKS] == [f"{n:02d}" for n in range(1, 11)]
    assert all(f"({path.name})" in page for path in NOTEBOOKS)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_short_clean_and_public(path):
    book = json.loads(path.read_text(encoding="utf-8"))
    assert (book["nbformat"], book["nbformat_minor"]) == (4, 5)
    assert len({cell["id"] for cell in book["cells"]}) == len(book["cells"])
    assert all(not cell["outputs"] for cell in book["cells"] if cell["cell_type"] == "code")
    assert any("$$" in "".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "markdown")
    code = "\n".join(code_cells(path))
    assert sum(bool(line.strip()) for line in code.splitlines()) <= MOST_LINES
    nodes = list(ast.walk(ast.parse(code)))
    imported = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    assert imported | {node.module for node in nodes if isinstance(node, ast.ImportFrom)} <= IMPORTS
    private = {node.attr for node in nodes if isinstance(node, ast.Attribute) and node.attr.startswith("_")}
    assert not private
    assert not [node for node in nodes if isinstance(node, ast.Assert)]


def test_a_four_bar_from_position_to_acceleration():
    """Norton's examples 4-1, 6-7, 7-1; and the derivatives of the loop as two linear equations."""
    found, a, b, c, d, omega, alpha = results(1), 40.0, 120.0, 80.0, 100.0, 25.0, 15.0
    A, B = met(40 * deg, a, b, c, d)
    coupler, rocker = B - A, B - d
    sides = np.array([[1j * coupler, -1j * rocker]])
    matrix = np.vstack([sides.real, sides.imag])
    w3, w4 = rates = np.linalg.solve(matrix, [(-1j * omega * A).real, (-1j * omega * A).imag])
    rest = -(1j * alpha - omega**2) * A + w3**2 * coupler - w4**2 * rocker
    assert [found[f"omega {link} [rad/s]"] for link in ("coupler", "rocker")] == pytest.approx(rates, rel=1e-12)
    accelerations = [found[f"alpha {link} [rad/s2]"] for link in ("coupler", "rocker")]
    assert accelerations == pytest.approx(np.linalg.solve(matrix, [rest.real, rest.imag]), rel=1e-12)
    assert accelerations == pytest.approx([296.089, 470.134], abs=1e-3)
    assert rates == pytest.approx([-4.121, 6.998], abs=1e-3)
    assert found["rocker [deg]"] == pytest.approx(np.angle(rocker) / deg, abs=1e-10)
    assert (found["coupler [deg]"], found["rocker [deg]"]) == pytest.approx((20.298, 57.325), abs=1e-3)
    crossed = met(40 * deg, a, b, c, d, branch=-1)[1] - d
    assert found["rocker crossed [deg]"] == pytest.approx(np.angle(crossed) / deg, abs=1e-10)
    assert found["kind"] == "crank-rocker"


def test_a_slider_crank():
    """Norton's example 4-2 (a = 40, b = 120, offset -20 mm, 60 degrees): the rod at 152.91 degrees from the slider."""
    found, r, rod, e, omega = results(2), 0.040, 0.120, -0.020, 30.0
    x, dx, ddx = slider(60 * deg, r, rod, e)
    assert (found["x [mm]"], found["v [m/s]"], found["a [m/s2]"]) == pytest.approx(
        (1e3 * x, omega * dx, omega**2 * ddx), rel=1e-10
    )
    assert found["rod [deg]"] + 180 == pytest.approx(152.91, abs=5e-3)
    inner, outer = (np.sqrt((rod + sign * r) ** 2 - e**2) for sign in (-1, +1))
    assert found["stroke [mm]"] == pytest.approx(1e3 * (outer - inner), rel=1e-10)
    forward = np.pi + np.arcsin(e / (rod - r)) - np.arcsin(e / (rod + r))
    assert found["time ratio"] == pytest.approx((2 * np.pi - forward) / forward, rel=1e-8)
    turn = np.linspace(0, 2 * np.pi, 721)
    series = -r * (np.cos(turn) + r / rod * np.cos(2 * turn))
    assert found["left out [m/s2]"] == pytest.approx(
        omega**2 * np.abs(slider(turn, r, rod)[2] - series).max(), rel=1e-9
    )


def test_a_quick_return():
    """Crank 100, pivots 200, lever 400 mm: psi = 30 degrees, so 240 to 120 degrees; 60 rpm."""
    found, omega = results(3), 2 * np.pi
    assert found["degrees of freedom"] == 1
    assert found["time ratio"] == pytest.approx(2.0, rel=1e-9)
    assert found["stroke [mm]"] == pytest.approx(2 * 400 * np.sin(30 * deg), rel=1e-10)
    assert found["speed crank up [m/s]"] == pytest.approx(-0.4 * omega * 0.1 / 0.3, rel=1e-10)
    assert found["speed crank down [m/s]"] == pytest.approx(0.4 * omega * 0.1 / 0.1, rel=1e-10)


def test_coupler_curves():
    """Hoeken's linkage for half a turn, Norton's table 3-1: links 2.200 and 2.800, 4.181 crank lengths straight."""
    found = results(4)
    A, B = met(np.linspace(90, 270, 361) * deg, 1.0, 2.8, 2.8, 2.2)
    line = 2 * B - A
    assert found["straight [crank lengths]"] == pytest.approx(4.181, abs=1e-3)
    assert found["straight [crank lengths]"] == pytest.approx(np.ptp(line.real), rel=1e-12)
    assert found["error [% of the length]"] == pytest.approx(100 * np.ptp(line.imag) / np.ptp(line.real), rel=1e-9)
    A, B = met(np.linspace(0, 2 * np.pi, 200_001), 100.0, 280.0, 280.0, 220.0)
    assert found["closed curve [mm]"] == pytest.approx(np.abs(np.diff(2 * B - A)).sum(), rel=1e-8)
    assert found["crossings"] == 0
    assert found["between the cognates [mm]"] < 1e-9
    A, B = met(90 * deg, 100.0, 280.0, 250.0, 220.0)
    assert complex(*found["path at 90 deg [mm]"]) == pytest.approx(A + (0.4 + 0.5j) * (B - A), abs=1e-9)


def shown_error(ratios, x):
    """Error of the rocker [rad]: (R1 - cos phi) cos psi - sin phi sin psi = R2 cos phi - R3 (Freudenstein)."""
    phi, psi = 30 * deg + 90 * deg * (x - 1), 330 * deg - 90 * deg * (1 / x - 1) / (0.5 - 1)
    u, v, w = ratios[0] - np.cos(phi), -np.sin(phi), ratios[1] * np.cos(phi) - ratios[2]
    with np.errstate(invalid="ignore"):
        swing = np.arccos(w / np.hypot(u, v))
    both = np.arctan2(v, u) + np.array([1, -1])[:, None] * swing - psi
    return np.abs(np.angle(np.exp(1j * both))).min(axis=0)


def test_function_generation():
    """Freudenstein's three equations for y = 1/x; no small change of the minimax linkage is better."""
    found, x, dense = results(5), 1.5 - 0.5 * np.cos((2 * np.arange(3) + 1) * np.pi / 6), np.linspace(1, 2, 20_001)
    assert found["x"] == pytest.approx(x, abs=1e-8)
    phi, psi = 30 * deg + 90 * deg * (x - 1), 330 * deg - 90 * deg * (1 / x - 1) / (0.5 - 1)
    ratios = np.linalg.solve(np.stack([np.cos(psi), -np.cos(phi), np.ones(3)], axis=1), np.cos(phi - psi))
    a, c = 1 / ratios[:2]
    b = np.sqrt(1 + a**2 + c**2 - 2 * a * c * ratios[2])
    assert found["lengths"] == pytest.approx([1.0, abs(a), b, abs(c)], rel=1e-9)
    assert found["interpolation [deg]"] == pytest.approx(shown_error(ratios, dense).max() / deg, rel=1e-5)
    _, a, b, c = found["minimax lengths"] * np.array([1, np.sign(a), 1, np.sign(c)])
    best = np.array([1 / a, 1 / c, (1 + a**2 - b**2 + c**2) / (2 * a * c)])
    least = shown_error(best, dense).max()
    assert found["minimax [deg]"] == pytest.approx(least / deg, rel=1e-5)
    rng = np.random.default_rng(36)
    near = [np.nanmax(shown_error(best * (1 + 1e-3 * rng.normal(size=3)), dense)) for _ in range(200)]
    assert min(near) > least * (1 - 1e-6)
    assert found["alternations"] == 3
    assert found["minimax free [deg]"] < found["minimax [deg]"] < found["interpolation [deg]"]


def test_burmester():
    """The poses are those of a four-bar with pivots at 0 and 300 mm, which must be found again."""
    found = results(6)
    A, B = met(np.array([20, 50, 85, 120, 160]) * deg, 90.0, 240.0, 200.0, 300.0)
    turned = (B - A) / np.abs(B - A)
    pins = (A + (120 + 60j) * turned + 50 * turned / turned[0])[:3]
    edges = pins[1:] - pins[0]
    middle = np.stack([edges.real, edges.imag], axis=1)
    halves = (np.abs(pins[1:]) ** 2 - np.abs(pins[0]) ** 2) / 2
    pivot = np.linalg.solve(middle, halves)
    assert found["pivot of three [mm]"] == pytest.approx(pivot, abs=1e-8)
    assert found["radii of three [mm]"] == pytest.approx(np.abs(pins - complex(*pivot)), abs=1e-8)
    assert found["links of the curve"] > 30
    assert found["miss of the curve [mm]"] < 1e-9
    points = A + (120 + 60j) * turned
    for fixed, moving in found["some pivots and pins [mm]"]:
        circle = np.abs(points + (moving - points[0]) * turned / turned[0] - fixed)[:4]
        assert circle == pytest.approx([abs(moving - fixed)] * 4, rel=1e-9)
    for known in (0, 300):
        assert min(abs(complex(*other) - known) for other in found["pivots of five [mm]"]) < 1e-8
    assert found["four-bars"] >= 1
    assert found["error of the best [mm]"] < 1e-9


def test_forces_and_balancing():
    """Power of the engine; its shaking force by the masses at both pins; the four-bar's by a Fourier series."""
    found, r, rod, omega, turn = results(7), 0.05, 0.20, 100.0, np.arange(361) * deg
    _, dx, ddx = slider(turn, r, rod)
    torque = (0.8 * omega**2 * ddx + 500.0) * dx
    assert found["torque at 30 deg [N m]"] == pytest.approx(torque[30], rel=1e-9)
    assert found["greatest torque [N m]"] == pytest.approx(torque.max(), rel=1e-9)
    pin = r * np.exp(1j * turn)
    for name, turning in (("shaking [N]", 1.2), ("shaking, crank balanced [N]", -0.4)):
        assert found[name] == pytest.approx(omega**2 * np.abs(turning * pin - 0.8 * ddx).max(), rel=1e-9)
    a, b, c, d = 0.06, 0.20, 0.23, 0.30
    A, B = met(turn[:-1], a, b, c, d)
    centre = 2 * a * A / 2 + 2 * b * (A + B) / 2 + 2 * c * (B + d) / 2
    assert found["four-bar shaking [N]"] == pytest.approx(omega**2 * np.abs(by_turn(centre)).max(), rel=1e-8)
    assert found["four-bar in balance [N]"] < 1e-9


def lift(theta):
    """Cycloidal rise of 40 mm over 100 degrees, dwell of 80, 3-4-5 fall, dwell: s and two derivatives."""
    b, h = 100 * deg, 40.0
    u, w = np.clip(theta / b, 0, 1), np.clip((theta - 180 * deg) / b, 0, 1)
    s = h * (u - np.sin(2 * np.pi * u) / (2 * np.pi)) - h * (10 * w**3 - 15 * w**4 + 6 * w**5)
    ds = h / b * ((1 - np.cos(2 * np.pi * u)) - 30 * w**2 * (1 - w) ** 2)
    return s, ds, h / b**2 * (2 * np.pi * np.sin(2 * np.pi * u) - 60 * w * (1 - w) * (1 - 2 * w))


def test_cams():
    """Peak factors of Norton's chapter 8 in closed form; prime radius and curvature by dense samples."""
    found, pi = results(8), np.pi
    peaks = {
        "harmonic": (pi / 2, pi**2 / 2, np.inf),
        "cycloidal": (2, 2 * pi, 4 * pi**2),
        "3-4-5": (15 / 8, 10 / np.sqrt(3), 60),
        "4-5-6-7": (35 / 16, 84 * np.sqrt(5) / 25, 105 / 2),
        "modified-sine": (4 * pi / (4 + pi), 4 * pi**2 / (4 + pi), 16 * pi**3 / (4 + pi)),
        "modified-trapezoid": (2, 8 * pi / (2 + pi), 32 * pi**2 / (2 + pi)),
    }
    assert found["peaks"].keys() == peaks.keys()
    for name, factors in peaks.items():
        assert found["peaks"][name] == pytest.approx(factors, rel=1e-9), name
    s, ds, dds = lift(np.linspace(0, 2 * pi, 400_001))
    prime = (np.abs(ds) / np.tan(30 * deg) - s).max()
    assert found["prime radius [mm]"] == pytest.approx(prime, rel=1e-8)
    assert found["pressure angle [deg]"] == pytest.approx(30.0, abs=1e-9)
    assert found["v in the middle [mm]"] == pytest.approx(2 * 40 / (100 * deg), rel=1e-12)
    reach = prime + s
    turning = (reach**2 + 2 * ds**2 - reach * dds) / np.hypot(reach, ds) ** 3
    assert found["least radius [mm]"] == pytest.approx(1 / turning.max(), rel=1e-7)
    assert found["undercut"] is bool(1 / turning.max() <= 10.0)


def least_transmission(a, b, c, d):
    """Least angle between coupler and rocker, at the two positions of the crank on the line of centres [deg]."""
    angles = [np.arccos((b**2 + c**2 - (d + sign * a) ** 2) / (2 * b * c)) for sign in (-1, +1)]
    return min(min(angle, np.pi - angle) for angle in angles) / deg


def test_tolerances_and_a_sweep():
    """Derivatives by central differences of the closed form; transmission angles by the law of cosines."""
    found, sizes = results(9), np.array([60.0, 200.0, 230.0, 300.0])

    def rocker(lengths):
        return np.angle(met(60 * deg, *lengths)[1] - lengths[3]) / deg

    slopes = np.array([rocker(sizes + step) - rocker(sizes - step) for step in 1e-3 * np.eye(4)]) / 2e-3
    assert found["crank [deg]"] == pytest.approx(60.0, abs=1e-9)
    assert found["worst case [deg]"] == pytest.approx(0.1 * np.abs(slopes).sum(), rel=1e-7)
    assert found["root sum square [deg]"] == pytest.approx(0.1 * np.sqrt((slopes**2).sum()), rel=1e-7)
    swept = [[least_transmission(a, 200, c, 300) for c in (210, 230, 250)] for a in (40, 50, 60, 70)]
    assert np.array(found["transmission [deg]"]) == pytest.approx(np.array(swept), abs=1e-8)
    turn = np.linspace(0, 2 * np.pi, 73)
    angles = np.angle(met(turn, 40.0, 200.0, 210.0, 300.0)[1] - 300.0) / deg
    assert found["swing of the first [deg]"] == pytest.approx(np.ptp(angles), rel=1e-9)
    assert found["study swing [deg]"] == pytest.approx([25, 30, 35])
    half, beta = np.array([25, 30, 35]) / 2 * deg, 48 * deg
    central = [
        least_transmission(np.tan(one) * np.sin(beta), np.cos(beta), np.sin(beta) / np.cos(one), 1.0) for one in half
    ]
    assert found["study transmission [deg]"] == pytest.approx(central, abs=1e-6)


def test_a_carpet_from_an_array_to_a_loom(tmp_path, monkeypatch):
    """Knots counted one by one; yarn in proportion to knots; the proof counts every knot."""
    monkeypatch.chdir(tmp_path)
    found = results(10)
    counts = [0, 0, 0]
    for row in range(40):
        for column in range(30):
            ring = int(abs(column - 14.5) + abs(row - 19.5))
            counts[2 if ring < 8 else 0 if ring % 10 < 6 else 1] += 1
    assert found["rows, columns"] == (40, 30)
    assert list(found["counts"]) == counts
    assert sorted(knots for knots, _, _ in found["yarn"].values()) == sorted(counts)
    for part in (1, 2):
        each = [need[part] / need[0] for need in found["yarn"].values()]
        assert each == pytest.approx([each[0]] * 3, rel=1e-9)
    assert (found["weaves"], found["proved"], found["failed checks of the loom"]) == (True, True, ())
    assert found["knots of the programme"] == 40 * 30
