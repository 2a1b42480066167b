"""Tasks of textbooks by the public face alone: results against closed forms, in fewer lines.

Sources: Norton, Design of Machinery (examples 4-1, 6-7, 7-1; chapters 3, 8, 11); Berkof and Lowen 1969. Norton's
numbers are as the first readers of the face found them.
"""

import inspect
import pickle
from pathlib import Path

import numpy as np
import pytest
import textbook_tasks as tasks
from default_machines import SETTLED

import ilmek
from ilmek.units import deg, mm, rpm

EXAMPLES = Path(__file__).parents[2] / "examples"


def lines(name: str) -> int:
    """Lines of code of a task."""
    return sum(bool(line.strip()) for line in inspect.getsource(getattr(tasks, name)).splitlines()) - 1


def test_half_of_the_lines_without_a_private_import() -> None:
    source = inspect.getsource(tasks)
    imports = [line for line in source.splitlines() if line.startswith(("import", "from"))]
    assert imports == ["import numpy as np", "import ilmek as il", "from ilmek.units import deg, mm, rpm"]
    assert "._" not in source
    assert sum(map(lines, tasks.BEFORE)) <= 0.5 * sum(tasks.BEFORE.values())


def test_position_to_acceleration() -> None:
    coupler, rocker = tasks.position_to_acceleration()
    found = [coupler[0][0] / deg, rocker[0][0] / deg, coupler[1][0], rocker[1][0], coupler[2][0], rocker[2][0]]
    assert found == pytest.approx([20.298, 57.325, -4.121, 6.998, 296.089, 470.134], abs=5e-4)


def test_slider_crank_torque() -> None:
    engine = tasks.slider_crank_torque()
    angles, torque = engine.values, engine.forces.effort("crank")
    r, rod, speed, mass = 0.05, 0.2, 100.0, 0.6

    def velocity(angle):
        return -r * np.sin(angle) - r**2 * np.sin(angle) * np.cos(angle) / np.sqrt(rod**2 - (r * np.sin(angle)) ** 2)

    slope = (velocity(angles + 1e-5) - velocity(angles - 1e-5)) / 2e-5
    work = mass * speed**2 * velocity(angles) * slope + 500 * velocity(angles)
    np.testing.assert_allclose(torque, work, atol=1e-6 * np.abs(work).max())


def test_quick_return_and_cusp_and_straight_line() -> None:
    assert tasks.quick_return() == pytest.approx(2.0, abs=1e-12)
    assert [cusp.input / deg for cusp in tasks.cusp()] == pytest.approx([60.0], abs=1e-6)
    (straight, *_) = tasks.straight_line()
    assert straight.length > 0.05


def test_synthesis() -> None:
    none = tasks.function_generator()
    assert not none
    assert none.reasons
    source = ilmek.solve(ilmek.four_bar(0.3, 0.09, 0.24, 0.2, points={"coupler.P": 0.12 + 0.06j}), [0.4, 0.9, 1.5, 2.1])
    poses = tasks.burmester(source["coupler.P"].position, source["coupler"].angle)
    assert poses.best.error < 1e-9
    turn = np.linspace(0, 2 * np.pi, 16, endpoint=False)
    curve = ilmek.solve(ilmek.four_bar(0.3, 0.06, 0.2, 0.23, points={"coupler.P": 0.1 + 0.05j}), turn)
    assert tasks.path(curve["coupler.P"].position).best.error < 1e-9
    assert pickle.loads(pickle.dumps(tasks.records(poses)))[0].error == poses.best.error


def test_many_designs_and_monte_carlo() -> None:
    crank, rocker = (np.random.default_rng(3).uniform(*ends, 1000) for ends in ((0.04, 0.06), (0.2, 0.26)))
    least = tasks.many_designs(crank, rocker)["transmission_angle_min"]
    gaps = 0.3 + np.outer([-1, 1], crank)
    cosine = np.abs((0.2**2 + rocker**2 - gaps**2) / (2 * 0.2 * rocker)).max(axis=0)
    np.testing.assert_allclose(least, np.arccos(cosine), atol=1e-12)
    found = tasks.monte_carlo(np.full(3, 0.2), np.array([0.22, 0.23, 0.24]))
    A = 0.06 * np.exp(1j)
    gap, c = 0.3 - A, np.array([0.22, 0.23, 0.24])
    along = (0.2**2 - c**2 + abs(gap) ** 2) / (2 * abs(gap))
    direction = gap / abs(gap) * (along + 1j * np.sqrt(0.2**2 - along**2)) / 0.2
    expected = A + direction * (0.1 + 0.05j)
    np.testing.assert_allclose(found["coupler.P x"].ravel() + 1j * found["coupler.P y"].ravel(), expected, atol=1e-14)


def test_dwell_of_a_six_bar() -> None:
    limits, (longest, *_) = tasks.dwell(EXAMPLES / "stephenson_dwell.toml")
    assert np.ptp([limit.value for limit in limits]) == pytest.approx(43 * deg, abs=1 * deg)
    assert (longest.stop - longest.start) / deg > 112


def test_cams() -> None:
    programme, plate = tasks.cam()
    middle, law = programme.at(0.75), ilmek.motion_law("3-4-5")
    assert middle.ds == pytest.approx(1.875 * 0.04 / 1.5, rel=1e-12)
    assert law.acceleration_peak == pytest.approx(10 / np.sqrt(3), rel=1e-9)
    step, at = 1e-4, np.array([0.3, 0.7, 2.1])
    x = [plate.pitch(at + shift) for shift in (-step, 0, step)]
    first, second = (x[2] - x[0]) / (2 * step), (x[2] - 2 * x[1] + x[0]) / step**2
    curved = np.abs((first.conj() * second).imag / np.abs(first) ** 3)
    np.testing.assert_allclose(np.abs(tasks.curvature(plate, at)), curved, rtol=1e-5)


def test_residual_vibration_is_duhamels_integral() -> None:
    ratios, u = np.array([1.3, 2.5, 3.7]), np.linspace(0, 1, 200_001)
    acceleration = 2 * np.pi * np.sin(2 * np.pi * u)
    phases = [np.trapezoid(acceleration * np.exp(-2j * np.pi * ratio * u), u) for ratio in ratios]
    np.testing.assert_allclose(tasks.residual_vibration(ratios), np.abs(phases) / (2 * np.pi * ratios), atol=1e-8)


def test_force_balance() -> None:
    crank, rocker = 0.06 * (0.2 / 2 + 0.5 / 2), 0.23 * (0.6 / 2 + 0.5 / 2)
    added = {"crank": ilmek.point_mass(crank / 0.05, -0.05), "rocker": ilmek.point_mass(rocker / 0.05, -0.05)}
    whole = {name: ilmek.combined(tasks.MASSES[name], weight) for name, weight in added.items()}
    before, after = tasks.force_balance(tasks.MASSES), tasks.force_balance(tasks.MASSES | whole)
    assert np.abs(after).max() < 1e-9 * np.abs(before).max()


def test_forces_with_friction_runs_and_several_inputs() -> None:
    judged = tasks.friction()
    rate = np.abs(judged.forces.motion["rocker"].omega)
    lost = 0.1 * 0.01 * np.abs(judged.forces.pin("B0")) * rate
    np.testing.assert_allclose(judged.friction_power, lost, rtol=1e-9, atol=1e-12)
    assert judged.speed == 150 * rpm
    run = tasks.pendulum()
    assert 0.5 * run.speed[-1] ** 2 * 0.25 == pytest.approx(9.81 * 0.5 * (np.sin(-run.position[-1]) - 0.5), abs=1e-6)
    assert tasks.five_bar().power_error < 1e-12


@pytest.mark.parametrize(
    ("name", "varied", "values", "result", "settings"),
    [
        ("beat-up", "swing", (20 * deg, 25 * deg, 30 * deg), "transmission_angle_min", {}),
        ("automated-loom", "width", (0.8, 1.0), "price", SETTLED | {"beat": "comb"}),
    ],
)
def test_machines_of_listed_values(
    name: str, varied: str, values: tuple[float, ...], result: str, settings: dict[str, str]
) -> None:
    unit = "deg" if varied == "swing" else "m"
    texts = ", ".join(f"{value / (deg if unit == 'deg' else 1)}{unit}" for value in values)
    found = tasks.machines(name, {varied: texts}, [result], settings)
    assert found.values(varied) == pytest.approx(values)
    alone = [ilmek.design(name, settings | {varied: value}).number(result) for value in values]
    assert found.values(result) == pytest.approx(alone)


def test_knot_chart_and_tables() -> None:
    turkish = [0.001 * point for point in (1 + 3j, 1 - 2j, -1 - 2j, -1 + 2j, 3 + 2j, 3 - 2j, 1 - 2j, 1 + 3j)]
    assert tasks.knot(turkish)["knot"] == "symmetric"
    knots = np.random.default_rng(1).integers(0, 2, (40, 30))
    chart, statistics, bill = tasks.chart_of_an_array(knots)
    assert chart.counts == tuple(np.bincount(knots.ravel()))
    assert statistics.changes.tolist() == np.count_nonzero(np.diff(knots, axis=1), axis=1)[::-1].tolist()
    assert bill.knots == 1200
    motion, forces, parameters = tasks.frames()
    assert len(motion["crank [rad]"]) == len(forces["crank drive torque [N*m]"]) == 361
    assert len(set(parameters["name"])) == len(parameters["doc"])
    assert tasks.a_million_poses().ok
    assert 40 * mm == pytest.approx(0.04)
