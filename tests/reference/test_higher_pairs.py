"""Cams, Geneva wheels and pins in slots of files against closed forms and Newton-Euler by hand.

The normal of a cam is judged by its pitch curve: the path of the roller's centre in the cam's frame, its tangent by
finite differences. A Geneva wheel is judged by where its pin is.
"""

from collections.abc import Callable

import numpy as np
import pytest

from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.inverse_run import all_loads
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile, mechanism_json, mechanism_toml, parse_mechanism
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.plane.vectors import cross

TURN = 2 * np.pi
SMALL = 1e-4


def slope(curve: Callable[[np.ndarray], np.ndarray], at: np.ndarray) -> np.ndarray:
    """Derivative by central differences of sixth order."""
    weights = ((1, 45), (2, -9), (3, 1))
    return sum(w * (curve(at + k * SMALL) - curve(at - k * SMALL)) for k, w in weights) / (60 * SMALL)


def cam_file(rng: np.random.Generator, *, rocker: bool, flat: bool = False) -> tuple[str, dict[str, float]]:
    """A cam with harmonic lifts, its follower loaded by a force or torque; and its dimensions."""
    size = {"e": rng.uniform(-0.02, 0.02), "s": rng.uniform(0.08, 0.12), "h": rng.uniform(0.005, 0.02)}
    size |= {"up": rng.uniform(100, 160), "top": rng.uniform(0, 60), "down": rng.uniform(90, 120)}
    size |= {"at": rng.uniform(-180, 180), "mass": rng.uniform(0.5, 2), "x": rng.uniform(-0.01, 0.01)}
    size |= {"load": rng.uniform(-300, -100), "arm": 0.15, "d": 0.17}
    rest = 360 - size["up"] - size["top"] - size["down"]
    high = f"{size['h'] / (size['arm'] if rocker else 1):.17g}{'rad' if rocker else 'm'}"
    up, top, down, at = (f"{size[key]:.17g}deg" for key in ("up", "top", "down", "at"))
    lift = f"""[{{ to = "{high}", over = "{up}", law = "harmonic" }}, {{ dwell = "{top}" }},
  {{ to = 0, over = "{down}", law = "harmonic" }}, {{ dwell = "{rest:.17g}deg" }}]"""
    second = "1.9rad" if rocker else f"{size['s']:.17g}m"
    end = "Q" if rocker else "G"
    follower = (
        f"""points = {{ {end} = [0, 0], R = ["{size["arm"]:.17g}m", 0] }}""" if rocker else "points = { G = [0, 0] }"
    )
    joint = 'Q.pin = ["ground", "follower"]' if rocker else 'G = { slide = ["follower", "ground"], along = "90deg" }'
    ground = f"""Q = ["{size["d"]:.17g}m", "-0.03m"]""" if rocker else f"""G = ["{size["e"]:.17g}m", 0]"""
    load = f'torque = "{-size["load"] * 0.1:.17g}N*m", on = "follower"'
    if not rocker:
        load = f'force = [0, "{size["load"]:.17g}N"], on = ["follower", "G"]'
    roller = "" if flat else f'roller = "{"R" if rocker else "G"}"'
    text = f"""
inputs = {{ O = "cam" }}
motions = {{ O = "20rad/s" }}
[bodies]
ground.points = {{ O = [0, 0], {ground} }}
cam.points = {{ O = [0, 0] }}
[bodies.follower]
{follower}
mass = "{size["mass"]:.17g}kg"
centre = ["{size["x"]:.17g}m", "0.01m"]
moment = "0.003kg*m^2"
[joints]
O.pin = ["ground", "cam"]
{joint}
[couplings.lift]
cam = [["cam", "O"], ["follower", "{end}"]]
{roller}
first_at = "{at}"
second_at = "{second}"
lift = {lift}
[loads]
push = {{ {load} }}
"""
    return text, size


def lift_of(size: dict[str, float], angle: np.ndarray, high: float) -> np.ndarray:
    """The lift [m; rad] by the closed form of simple harmonic motion."""
    up, top, down = (np.radians(size[key]) for key in ("up", "top", "down"))
    theta = (angle - np.radians(size["at"])) % TURN
    rise = high / 2 * (1 - np.cos(np.pi * np.clip(theta / up, 0, 1)))
    fall = high / 2 * (1 - np.cos(np.pi * np.clip((theta - up - top) / down, 0, 1)))
    return rise - fall


def angles_of(rng: np.random.Generator, size: dict[str, float]) -> np.ndarray:
    """Cam angles of two turns away from the ends of the parts, where the acceleration jumps."""
    ends = np.radians(
        size["at"] + np.array([0, size["up"], size["up"] + size["top"], size["up"] + size["top"] + size["down"]])
    )
    angles = rng.uniform(0, 2 * TURN, 40)
    apart = np.abs(np.exp(1j * angles)[:, None] - np.exp(1j * ends)).min(axis=1)
    return np.sort(angles[apart > 0.01])


def forces_of(file: MechanismFile, angles: np.ndarray, speed: float) -> tuple[Motion, Forces]:
    motion = solve(file.plan(), angles, speed).require()
    return motion, inverse(motion, file.inertias, all_loads(file.machine))


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("flat", [False, True])
def test_cam_with_sliding_follower(seed: int, flat: bool) -> None:
    rng = np.random.default_rng(seed)
    text, size = cam_file(rng, rocker=False, flat=flat)
    angles = angles_of(rng, size)
    motion, forces = forces_of(parse_mechanism(text), angles, 20.0)
    lift = lambda at: lift_of(size, at, size["h"])  # noqa: E731
    height, gain = size["s"] + lift(angles), slope(lift, angles)
    speedup = slope(lambda at: slope(lift, at), angles)
    np.testing.assert_allclose(motion.point("follower", "G").position, size["e"] + 1j * height, atol=1e-12)
    axial = size["mass"] * 400 * speedup - size["load"]  # on the follower along its slide
    contact = size["e"] + 1j * height
    if flat:
        normal = np.full(len(angles), 1j)
        contact = gain + 0j  # the face touches where the pole is, above the cam's middle by any height
    else:
        pitch = lambda at: (size["e"] + 1j * (size["s"] + lift(at))) * np.exp(-1j * at)  # noqa: E731
        normal = 1j * slope(pitch, angles) * np.exp(1j * angles)
        normal *= np.sign(normal.imag) / np.abs(normal)
    force = axial / normal.imag * normal
    scale = np.abs(force).max()
    np.testing.assert_allclose(forces.reactions["lift"], force, atol=3e-6 * scale)
    np.testing.assert_allclose(forces.effort("cam"), cross(contact, force), atol=3e-6 * scale * size["s"])
    np.testing.assert_allclose(forces.effort("cam"), gain * axial, atol=3e-6 * scale * size["s"])
    np.testing.assert_allclose(forces.reactions["G"], -force.real, atol=3e-6 * scale)
    assert forces.power_error < 1e-12


@pytest.mark.parametrize("seed", range(20))
def test_cam_with_rocker(seed: int) -> None:
    rng = np.random.default_rng(seed)
    text, size = cam_file(rng, rocker=True)
    angles = angles_of(rng, size)
    motion, forces = forces_of(parse_mechanism(text), angles, 20.0)
    lift = lambda at: 1.9 + lift_of(size, at, size["h"] / size["arm"])  # noqa: E731
    pivot = size["d"] - 0.03j
    centre = lambda at: pivot + size["arm"] * np.exp(1j * lift(at))  # noqa: E731
    np.testing.assert_allclose(motion.point("follower", "R").position, centre(angles), atol=1e-12)
    normal = 1j * slope(lambda at: centre(at) * np.exp(-1j * at), angles) * np.exp(1j * angles)
    normal *= np.sign((normal * np.conj(centre(angles))).real) / np.abs(normal)
    alpha = 400 * slope(lambda at: slope(lift, at), angles)
    own = complex(size["x"], 0.01)
    moment = (0.003 + size["mass"] * abs(own) ** 2) * alpha + size["load"] * 0.1
    force = moment / cross(centre(angles) - pivot, normal) * normal
    scale = np.abs(force).max()
    np.testing.assert_allclose(forces.reactions["lift"], force, atol=3e-6 * scale)
    np.testing.assert_allclose(forces.effort("cam"), cross(centre(angles), force), atol=1e-6 * scale)
    assert forces.power_error < 1e-12


def geneva_file(slots: int, centre: complex, at: float, load: float) -> str:
    wheels = 'geneva = [["crank", "O"], ["wheel", "Q"]]'
    return f"""
inputs = {{ O = "crank" }}
motions = {{ O = "3rad/s" }}
[bodies]
ground.points = {{ O = [0, 0], Q = ["{centre.real:.17g}m", "{centre.imag:.17g}m"] }}
crank.points = {{ O = [0, 0] }}
wheel = {{ points = {{ Q = [0, 0] }}, mass = "2kg", moment = "0.02kg*m^2" }}
[joints]
O.pin = ["ground", "crank"]
Q.pin = ["ground", "wheel"]
[couplings]
index = {{ {wheels}, slots = {slots}, second_at = "0.3rad", first_at = "{at:.17g}rad" }}
[loads]
drag = {{ torque = "{load:.17g}N*m", on = "wheel" }}
"""


@pytest.mark.parametrize("seed", range(20))
def test_geneva_wheel(seed: int) -> None:
    """The slot in mesh points at the pin; the moment about the wheel's middle is that of the pin's force across it."""
    rng = np.random.default_rng(seed)
    slots, at, load = int(rng.integers(3, 12)), rng.uniform(-3, 3), rng.uniform(-5, 5)
    centre = 0.1 * np.exp(1j * rng.uniform(0, TURN))
    file = parse_mechanism(geneva_file(slots, centre, at, load))
    angles = np.sort(rng.uniform(-TURN, 3 * TURN, 60))
    turned = angles - at
    count = np.round(turned / TURN)
    inside = np.abs(turned - count * TURN) < np.pi / 2 - np.pi / slots
    motion, forces = forces_of(file, angles, 3.0)
    pin = lambda at_: centre * np.sin(np.pi / slots) * np.exp(1j * at_)  # noqa: E731
    slot = lambda at_: np.angle((pin(at_) - centre) / -centre)  # noqa: E731
    rest = -np.sign(turned - count * TURN) * np.pi / slots
    expected = 0.3 + np.where(inside, slot(turned), rest) - count * TURN / slots
    np.testing.assert_allclose(motion.direction("wheel"), np.exp(1j * expected), atol=1e-12)
    np.testing.assert_allclose(motion.omega("wheel"), 3 * np.where(inside, slope(slot, turned), 0.0), atol=1e-8)
    alpha = 9 * np.where(inside, slope(lambda at_: slope(slot, at_), turned), 0.0)
    np.testing.assert_allclose(motion.alpha("wheel"), alpha, atol=1e-5 * max(1.0, np.abs(alpha).max()))
    moment = 0.02 * motion.alpha("wheel") - load
    arm = np.where(inside, pin(turned), 0) - centre
    across = 1j * arm / np.abs(arm)
    np.testing.assert_allclose(forces.reactions["index"], moment / np.abs(arm) * across, rtol=1e-9, atol=1e-9)
    drive = cross(np.where(inside, pin(turned), 0), forces.reactions["index"])
    np.testing.assert_allclose(forces.effort("crank"), drive, atol=1e-9 * np.abs(drive).max())
    assert forces.power_error < 1e-12


@pytest.mark.parametrize("kind", ["slide", "rocker", "geneva"])
def test_closed_form_newton_and_jerk_agree(kind: str) -> None:
    rng = np.random.default_rng(3)
    text = geneva_file(5, 0.1 + 0.02j, 0.2, 1.0) if kind == "geneva" else cam_file(rng, rocker=kind == "rocker")[0]
    text = text.replace("harmonic", "4-5-6-7")
    mechanism = parse_mechanism(text).mechanism
    body = mechanism.couplings[0].second[0]
    values = 0.2 + np.linspace(-0.7, 0.7, 9)
    closed = solve(plan(mechanism), values, 3.0, 2.0, 1.0).require()
    newton = solve(plan(mechanism, closed_forms=False), values, 3.0, 2.0, 1.0).require()
    point = mechanism.couplings[0].second[1]
    np.testing.assert_allclose(newton.origin(body), closed.origin(body), atol=1e-10)
    np.testing.assert_allclose(newton.alpha(body), closed.alpha(body), atol=1e-7)
    np.testing.assert_allclose(newton[body].acceleration, closed[body].acceleration, atol=1e-8)
    np.testing.assert_allclose(newton[body].beta, closed[body].beta, atol=1e-5)
    np.testing.assert_allclose(newton[body, point].jerk, closed[body, point].jerk, atol=1e-5)
    h = 1e-5
    later, sooner = (
        solve(plan(mechanism), values + 3 * t + t**2 + t**3 / 6, 3 + 2 * t + t**2 / 2, 2 + t) for t in (h, -h)
    )
    for jerk, after, before in (
        (closed[body].beta, later.alpha(body), sooner.alpha(body)),
        (
            closed[body, point].jerk,
            later.point(body, point).acceleration,
            sooner.point(body, point).acceleration,
        ),
    ):
        change = (after - before) / (2 * h)
        np.testing.assert_allclose(jerk, change, atol=1e-4 * max(1.0, np.abs(change).max()))


SLOT = """
inputs = { O = "crank" }
motions = { O = "6rad/s" }
[bodies]
ground.points = { O = [0, 0], Q = [0, "-200mm"] }
crank.points = { O = [0, 0], P = ["80mm", 0] }
lever = { points = { Q = [0, 0], P = [0, "15mm"] }, mass = "2kg", moment = "0.02kg*m^2", centre = ["100mm", 0] }
[joints]
O.pin = ["ground", "crank"]
Q.pin = ["ground", "lever"]
P.slot = ["crank", "lever"]
[branches]
"P.slot" = 1
[loads]
drag = { torque = "-3N*m", on = "lever" }
"""


def test_pin_in_a_slot() -> None:
    """The lever's line, 15 mm beside its pivot, goes through the pin; the pin presses across it."""
    file = parse_mechanism(SLOT)
    angles = np.linspace(0, TURN, 25)
    motion, forces = forces_of(file, angles, 6.0)
    pin = 0.08 * np.exp(1j * angles) + 0.2j  # from the pivot

    def lever(at: np.ndarray) -> np.ndarray:
        arm = 0.08 * np.exp(1j * at) + 0.2j
        return np.angle(arm) - np.arcsin(0.015 / np.abs(arm))

    np.testing.assert_allclose(motion.direction("lever"), np.exp(1j * lever(angles)), atol=1e-12)
    alpha = 36 * slope(lambda at: slope(lever, at), angles)
    along = np.sqrt(np.abs(pin) ** 2 - 0.015**2)
    press = ((0.02 + 2 * 0.01) * alpha + 3) / along
    expected = press * 1j * np.exp(1j * lever(angles))
    np.testing.assert_allclose(forces.pin("P", "crank"), -expected, atol=1e-5 * np.abs(press).max())
    np.testing.assert_allclose(forces.couples["P.slot"], 0, atol=1e-12)


@pytest.mark.parametrize("kind", ["slide", "rocker", "geneva", "slot", "table"])
def test_written_files_are_read_without_loss(kind: str) -> None:
    rng = np.random.default_rng(5)
    texts = {"geneva": geneva_file(5, 0.1 + 0.02j, 0.2, 1.0), "slot": SLOT}
    text = texts[kind] if kind in texts else cam_file(rng, rocker=kind == "rocker")[0]
    if kind == "table":
        start = text.index("lift = [")
        text = (
            text[:start]
            + 'table = [["0deg", 0], ["90deg", "7.1mm"], ["200deg", "3mm"], ["360deg", 0]]\n'
            + text[text.index("[loads]") :]
        )
    machine = parse_mechanism(text).machine
    for written, toml in ((mechanism_toml(machine), True), (mechanism_json(machine), False)):
        assert parse_mechanism(written, toml=toml).machine.mechanism == machine.mechanism


def test_a_cam_that_would_have_to_pull_fails_a_check() -> None:
    text, _ = cam_file(np.random.default_rng(1), rocker=False)
    slow, fast = (
        {check.name: check.ok for check in analysis(run(parse_mechanism(one), MotionRequest({}))).checks}
        for one in (text, text.replace("20rad/s", "200rad/s"))
    )
    assert slow["lift: force on the follower"]
    assert not fast["lift: force on the follower"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "lift = [",
            'table = [[0, 0], ["90deg", "1mm"], ["180deg", 0], ["360deg", 0]]\nlift = [',
            "one of lift and table",
        ),
        ('law = "harmonic" }, { dwell', 'law = "uniform" }, { dwell', "finite acceleration"),
        ("{ to = 0,", '{ to = "1mm",', "must return"),
        ('roller = "G"', 'roller = "R"', "no point 'R'"),
        ("cam = [", "geneva = [", "slots"),
    ],
)
def test_cams_that_contradict_are_one_error(old: str, new: str, message: str) -> None:
    text, _ = cam_file(np.random.default_rng(1), rocker=False)
    assert old in text
    with pytest.raises(MechanismError, match=message) as error:
        parse_mechanism(text.replace(old, new)).plan()
    assert "\n" not in str(error.value)
    assert "couplings.lift" in str(error.value)


def test_a_geneva_wheel_of_two_slots_is_refused() -> None:
    with pytest.raises(MechanismError, match="3"):
        parse_mechanism(geneva_file(2, 0.1, 0.0, 1.0))
