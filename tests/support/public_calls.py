"""One valid call of every public name, argument by argument: what the property test of the public face varies.

Each argument has a kind, which says what a caller may give instead. A name without an entry here fails the test.
"""

import dataclasses
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from small_programme import small_programme

import ilmek
from ilmek.cams import one_mass
from ilmek.carpet.quality import parse_quality
from ilmek.carpet.sizes import parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.dynamics.own_machine import NamedLoad
from ilmek.io.programme_file import write_programme

ROOT = Path(__file__).parents[2]
ORDERS, LOOMS = ROOT / "examples" / "orders.toml", ROOT / "examples" / "looms.toml"
MEDALLION, JANSEN = ROOT / "examples" / "medallion.png", ROOT / "examples" / "jansen_leg.toml"


@dataclasses.dataclass(frozen=True)
class Quantity:
    """A number: in SI, or as a text with its unit."""

    value: float
    unit: str
    whole: float = 1.0
    """A value that every type of number has."""


@dataclasses.dataclass(frozen=True)
class Samples(Quantity):
    """A quantity, or an array of them."""

    gaps: bool = False
    """Whether an array may have NaN."""


@dataclasses.dataclass(frozen=True)
class PointOf:
    """A planar vector: complex, or its two coordinates."""

    value: complex
    unit: str = "m"


@dataclasses.dataclass(frozen=True)
class PointsOf:
    """Several planar points."""

    value: tuple[complex, ...]


@dataclasses.dataclass(frozen=True)
class Named:
    """A text out of a known few."""

    value: str


@dataclasses.dataclass(frozen=True)
class FreeText:
    """Any text."""

    value: str


@dataclasses.dataclass(frozen=True)
class Count:
    """A whole number."""

    value: int


@dataclasses.dataclass(frozen=True)
class Other:
    """A record, mapping, sequence, function or path: only another kind of object is tried."""

    value: Any
    none: bool = False
    """Whether None is the default."""
    wrong: tuple[Any, ...] = ()
    """Further values that must be refused."""
    equal: tuple[Any, ...] = ()
    """Other forms of the value."""


Kind = Quantity | PointOf | PointsOf | Named | FreeText | Count | Other


@dataclasses.dataclass(frozen=True)
class Call:
    """A call: the function, its arguments by position and by name, and whether it is too long to repeat."""

    function: Callable[..., Any]
    positional: tuple[Kind, ...] = ()
    named: Mapping[str, Kind] = dataclasses.field(default_factory=dict)
    long: bool = False


NAMESPACES = ("cams", "carpet", "dynamics", "linkage", "loom", "results", "synthesis", "timing", "weaving")

BUILT = {
    "Motion": "built by solve; its methods are called below",
    "Forces": "built by inverse_dynamics; its methods are called below",
    "ForwardRun": "built by forward_dynamics; its methods are called below",
    "Report": "built by design; its lookup is called below",
    "Progress": "two callables and shares; calling what is no function is Python's own TypeError",
    "Cancelled": "an exception without arguments of its own",
    "IlmekError": "an exception of texts",
    "Load": "a protocol",
    **dict.fromkeys(NAMESPACES, "a package of public names"),
}
"""Public names that nobody calls with values of his own, and why."""


def length(value: float = 0.2, whole: float = 1.0) -> Quantity:
    return Quantity(value, "m", whole)


def angle(value: float = 0.5, whole: float = 1.0) -> Quantity:
    return Quantity(value, "rad", whole)


@cache
def four_bar() -> ilmek.Mechanism:
    return ilmek.four_bar(0.3, 0.06, 0.2, 0.23, points={"rocker": {"E": 0.3}})


@cache
def motion() -> ilmek.Motion:
    return ilmek.solve(four_bar(), np.linspace(0, 6, 7), speed=10.0)


INERTIAS = {"rocker": ilmek.Inertia(0.4, 0.115, 0.002)}
GRAVITY = ilmek.Gravity(-9.81j)
WRONG_INERTIAS = ({"rockr": ilmek.Inertia(1, 0, 1)}, {"rocker": 3.0}, {1: ilmek.Inertia(1, 0, 1)}, [1, 2])


@cache
def programme() -> ilmek.CamProgramme:
    return ilmek.cam_programme(ilmek.rise(1.5, 0.04), ilmek.fall(1.5, 0.04), ilmek.dwell(2 * np.pi - 3.0))


@cache
def cam() -> ilmek.PlateCam:
    return ilmek.plate_cam(programme(), 0.1, roller_radius=0.01)


@cache
def chart() -> ilmek.Chart:
    pixels = np.repeat(np.repeat(np.array([[[200, 10, 10], [10, 10, 200]]], np.uint8), 8, 0), 4, 1)
    return ilmek.make_chart(pixels, "30x40cm", "10x10/dm", colours=2)


@cache
def forces() -> ilmek.Forces:
    return ilmek.inverse_dynamics(motion(), INERTIAS)


@cache
def run() -> ilmek.ForwardRun:
    return ilmek.forward_dynamics(four_bar(), INERTIAS, 0.5, speed=30.0, flywheel=0.1)


@cache
def report() -> ilmek.Report:
    return ilmek.design("cam")


def new_path(name: object) -> object:
    """A path in a new folder for a name; anything else as it is."""
    return Path(tempfile.mkdtemp()) / name if isinstance(name, str) else name


BODIES = (ilmek.Body("ground", {"line": 0}), ilmek.Body("ram", {"line": 0}))
SLIDE, INPUT = ilmek.Slide("line", "ram", "ground"), ilmek.Displacement("line")
POSES = PointsOf((0j, 0.025 + 0.015j, 0.030 + 0.001j))
PATH = tuple(complex(0.1 + 0.04 * np.cos(u), 0.02 * np.sin(u)) for u in range(4))
PARTS = tuple(programme().segments)
NOT_A_BODY = ({"rockr": {"E": 0.1}}, {"rocker": {"E": 300}}, {"rocker": 0.3}, {"rocker": {1: 0.1}})
SPRING = dict(stiffness=Quantity(200.0, "N/m"), length=length(), damping=Quantity(2.0, "N*s/m"))
KNOTS = (np.arange(1200) % 2).reshape(40, 30).astype(np.uint8)
KINDS = (np.int8, np.int16, np.int32, np.int64, np.uint16, np.uint64)
WRONG_KNOTS = (
    *(np.full((40, 30), index) for index in (2, 300, -1, 10**8, 0.5, np.nan)),
    *(np.zeros(shape, np.uint8) for shape in ((10, 10), (30, 40), (0, 0), (1200,), (40, 30, 1))),
    *(np.zeros((40, 30), kind) for kind in (complex, object, "U1")),
    "x",
)
PAIR = (("a",), "ab", ("a", 1), 3)


@cache
def programme_file() -> Path:
    """A programme of a small carpet."""
    path = Path(tempfile.mkdtemp()) / "programme.ilmek"
    write_programme(path, small_programme())
    return path


def of_programme(function: Callable[..., Any]) -> Callable[..., Any]:
    """The function with the file in the place of the word."""
    return lambda file, *more, **named: function(programme_file() if file == "programme" else file, *more, **named)


PROGRAMME = Other("programme", wrong=("no.ilmek", ".", str(JANSEN), "a\0b", "", 3))
NO_SETTINGS = ({"x": 1}, {1: 1}, 3)
NO_LOCKED = ({"rocker": 1.0}, {"crank": 1.0}, {1: 1.0}, 3)
TURKISH = PointsOf(tuple(0.001 * point for point in (1 + 3j, 1 - 2j, -1 - 2j, -1 + 2j, 3 + 2j, 3 - 2j, 1 - 2j, 1 + 3j)))


@cache
def measured() -> Path:
    """A file with a measured curve of the tufting machine's drive."""
    path = Path(tempfile.mkdtemp()) / "measured.csv"
    path.write_text("crank angle [deg], main shaft [N*m]\n30, 13.9\n60, 10.8\n90, 4.4\n150, 9.3\n210, -0.6\n")
    return path


CALLS: dict[str, Call] = {
    "Mechanism": Call(
        ilmek.Mechanism,
        (Other(BODIES, wrong=(BODIES[0], (BODIES[0], 3))), Other((SLIDE,), wrong=(SLIDE, ("line",)))),
        {
            "inputs": Other((INPUT,), wrong=(INPUT, ("line",))),
            "branches": Other({}, wrong=({"line": 3}, {"line": 0.5}, {"x": 1}, {"line": np.array([1, 1])})),
            "name": FreeText("press"),
            "pose": Other({"ram": (0j, 0.0)}, wrong=({"ram": 3}, {"ram": (1, 2, 3)}, {"x": (0, 0)})),
            "couplings": Other((), wrong=(3, (4,))),
        },
    ),
    "Body": Call(ilmek.Body, (FreeText("rocker"), Other({"E": 0.3 + 0j}, wrong=({"E": "3kg"}, {2: 1.0}, {"E": None})))),
    "Pin": Call(ilmek.Pin, (FreeText("A"), FreeText("crank"), FreeText("coupler"))),
    "Slide": Call(
        ilmek.Slide, (FreeText("line"), FreeText("ram"), FreeText("ground")), dict(along=angle(), turned=angle())
    ),
    "Rotation": Call(ilmek.Rotation, (FreeText("crank"), FreeText("A0"))),
    "Displacement": Call(ilmek.Displacement, (FreeText("line"),)),
    "Coupling": Call(
        ilmek.Coupling,
        (FreeText("mesh"), FreeText("gears"), Other(("a", "A"), wrong=PAIR), Other(("b", "B"), wrong=PAIR)),
        dict(
            ratio=Quantity(-0.5, ""),
            first_at=angle(),
            second_at=angle(),
            carrier=FreeText("ground"),
            pressure_angle=angle(),
        ),
    ),
    "four_bar": Call(
        ilmek.four_bar,
        (length(0.3), length(0.06), length(0.2), length(0.23)),
        dict(branch=Count(1), points=Other({"rocker": {"E": 0.3 + 0j}}, True, NOT_A_BODY), name=FreeText("four")),
    ),
    "mechanism": Call(
        ilmek.mechanism,
        (
            Other({"ground": {"O": 0, "line": 0}, "arm": {"O": 0}, "ram": {"line": 0}}, wrong=({"arm": {"O": 0}}, 3)),
            Other(["arm", "line"], wrong=("ground", "rm", ["arm", 3], 3)),
        ),
        {
            "slides": Other((SLIDE,), wrong=(SLIDE, ("line",))),
            "branches": Other({}, wrong=({"line": 3}, {"x": 1})),
            "name": FreeText("press"),
        },
    ),
    "slider_crank": Call(
        ilmek.slider_crank,
        (length(0.06), length(0.2)),
        dict(offset=length(0.01), branch=Count(1), points=Other({}, True, NOT_A_BODY), name=FreeText("slider")),
    ),
    "read_mechanism": Call(
        ilmek.read_mechanism,
        (Other(JANSEN, wrong=("no.toml", ".", "a\0b", "")),),
        {"values": Other({}, wrong=({"stroke": "1mm"}, {1: "1mm"}, {"stroke": 3}))},
    ),
    "write_mechanism": Call(
        lambda name, mechanism, inertias: ilmek.write_mechanism(new_path(name), mechanism, inertias),
        (Other("a.toml", wrong=("a.txt", "a/b.toml", "")), Other(four_bar()), Other(INERTIAS, True, WRONG_INERTIAS)),
    ),
    "solve": Call(
        ilmek.solve,
        (Other(four_bar()), Samples(0.5, "rad")),
        dict(
            speed=Samples(1.0, "rad/s"),
            acceleration=Samples(1.0, "rad/s^2"),
            jerk=Samples(1.0, "rad/s^3"),
        ),
    ),
    "solve by input": Call(
        lambda mechanism, values, speed: ilmek.solve(mechanism, values, speed=speed),
        (
            Other(four_bar()),
            Other({"crank": 0.5}, wrong=({}, {"rocker": 1.0}, {1: 2.0}, {"crank": "1m"}, {"crank": [[1.0]]})),
            Other({"crank": 0.5}, wrong=({"rocker": 1.0}, {"crank": np.zeros(3, bool)}, {"crank": [1.0, None]})),
        ),
    ),
    "Inertia": Call(ilmek.Inertia, (Quantity(0.4, "kg"), PointOf(0.1 + 0.02j), Quantity(0.01, "kg*m^2"))),
    "bar": Call(ilmek.bar, (PointOf(0.1j), PointOf(0.3 + 0j)), dict(mass=Quantity(0.4, "kg"), width=length(0.02))),
    "bar_mass": Call(
        ilmek.bar_mass, (Samples(0.3, "m"), Samples(0.03, "m"), Samples(0.01, "m"), Samples(7800.0, "kg/m^3"))
    ),
    "point_mass": Call(ilmek.point_mass, (Quantity(2.5, "kg"), PointOf(0.3 + 0.1j))),
    "combined": Call(ilmek.combined, (Other(INERTIAS["rocker"]), Other(ilmek.Inertia(1, 0.1, 0.1)))),
    "Gravity": Call(ilmek.Gravity, (PointOf(1 - 9.81j, "m/s^2"),)),
    "PointForce": Call(
        lambda body, local, force: ilmek.PointForce((body, local), force),
        (FreeText("rocker"), PointOf(0.3 + 0.1j), PointOf(1 - 2j, "N")),
    ),
    "PointForce at a point": Call(
        lambda body, point, force: ilmek.inverse_dynamics(motion(), {}, [ilmek.PointForce((body, point), force)]),
        (
            Named("rocker"),
            Other("E", wrong=("F", "", [], "1mm")),
            Other(-60j, wrong=("60kg", np.ones(3), lambda _: "x", np.ones((7, 3)), None)),
        ),
    ),
    "Torque": Call(ilmek.Torque, (FreeText("rocker"), Samples(5.0, "N*m", gaps=True))),
    "Torque in dynamics": Call(
        lambda body, torque: ilmek.inverse_dynamics(motion(), {}, [ilmek.Torque(body, torque)]),
        (Named("rocker"), Other(5.0, wrong=(np.ones(3), lambda _: None, lambda _: np.ones(4), "5m"))),
    ),
    "Spring": Call(
        lambda *ends, **more: ilmek.Spring(ends[:2], ends[2:], **more),
        tuple(FreeText(name) for name in ("ground", "S", "rocker", "E")),
        SPRING,
    ),
    "Spring in dynamics": Call(
        lambda *ends: ilmek.inverse_dynamics(motion(), {}, [ilmek.Spring(ends[:2], ends[2:], 200.0, 0.1)]),
        (Named("ground"), Named("A0"), Named("rocker"), Named("E")),
    ),
    "inverse_dynamics": Call(
        ilmek.inverse_dynamics,
        (Other(motion()), Other(INERTIAS, wrong=WRONG_INERTIAS)),
        dict(
            loads=Other((GRAVITY,), wrong=(GRAVITY, (3,), ilmek.Gravity)),
            joint_frictions=Other(
                (ilmek.PinFriction("B", 0.01, 0.1),), wrong=((GRAVITY,), (ilmek.PinFriction("x", 0.01, 0.1),))
            ),
        ),
    ),
    "forward_dynamics": Call(
        ilmek.forward_dynamics,
        (Other(four_bar()), Other(INERTIAS, wrong=WRONG_INERTIAS), Quantity(0.05, "s", 1.0)),
        dict(
            position=angle(),
            speed=Quantity(10.0, "rad/s"),
            drive=Other(lambda *_: 0.1, True, (5.0, {"rocker": lambda *_: 0.1})),
            loads=Other((GRAVITY,), wrong=(GRAVITY, (3,))),
            joint_frictions=Other(
                (ilmek.PinFriction("B", 0.0, 0.1, 1e-4),), wrong=((GRAVITY,), (ilmek.PinFriction("x", 0.01, 0.1),))
            ),
            flywheel=Quantity(0.01, "kg*m^2"),
            stops=Other([ilmek.EndStop(2.0)], wrong=(3, [3])),
            ratchet=Other(1, wrong=(2, "up")),
            every=Quantity(0.01, "s"),
        ),
    ),
    "EndStop": Call(ilmek.EndStop, (angle(),), dict(rebound=Quantity(0.5, ""), name=FreeText("wall"))),
    "MotorDrive": Call(
        ilmek.MotorDrive,
        (Quantity(2.0, "N*m"),),
        dict(
            speed=Quantity(30.0, "rad/s"),
            slip=Quantity(0.1, ""),
            inertia=Quantity(0.01, "kg*m^2"),
            sharp=Other(True, wrong=(3, "yes")),
        ),
    ),
    "PinFriction": Call(
        ilmek.PinFriction,
        (FreeText("B"), length(0.01)),
        dict(coefficient=Quantity(0.1, ""), drag=Quantity(0.1, "N*m*s")),
    ),
    "SlideFriction": Call(
        ilmek.SlideFriction,
        (FreeText("line"), length(0.1)),
        dict(coefficient=Quantity(0.1, ""), drag=Quantity(0.1, "N*s/m")),
    ),
    "OwnMachine": Call(
        ilmek.OwnMachine,
        (Other(four_bar()),),
        dict(
            inertias=Other(INERTIAS, wrong=WRONG_INERTIAS[1:]),
            gravity=PointOf(-9.81j, "m/s^2"),
            loads=Other((NamedLoad("weight", GRAVITY),), wrong=(GRAVITY, (GRAVITY,))),
            frictions=Other((ilmek.PinFriction("B", 0.01, 0.1),), wrong=((1,),)),
            members=Other({}, wrong=({"rocker": 1},)),
            pins=Other({}, wrong=({"B": 1},)),
            motions=Other({}, wrong=({"crank": 1},)),
            forward=Other(None, True, (1,)),
            study=Other(None, True, ((1.0,),)),
            servo=Other(None, True, (1,)),
            paths=Other((), wrong=(("rocker",), ((1, 2, 3),))),
            transmission=Other((), wrong=((1,), "B")),
        ),
    ),
    "run_machine": Call(
        ilmek.run_machine,
        (Other(four_bar(), wrong=("no.toml",)),),
        dict(
            over=Other(
                (0.0, 1.0), wrong=((0.0,), (0.0, 1.0, 2.0), ("0m", "1m"), "0..1", (0.0, None), (1.0, 1.0), "1deg")
            ),
            speed=Quantity(12.5, "rad/s"),
            steps=Count(4),
        ),
    ),
    "run_machine at a pose": Call(
        ilmek.run_machine,
        (Other(four_bar()),),
        dict(
            fixed=Other(
                {"crank": 1.0}, True, wrong=({"rocker": 1.0}, {"crank": "1m"}, {"crank": None}, {1: 1.0}, [1.0])
            )
        ),
    ),
    "motion_law": Call(
        ilmek.motion_law,
        (Named("modified-sine"),),
        dict(constant_velocity=Other(0.5, wrong=("x", [1.0, 2.0], np.nan, 2.0, np.zeros(3), {}))),
    ),
    "rise": Call(ilmek.rise, (angle(), length(0.04), Named("cycloidal"))),
    "dwell": Call(ilmek.dwell, (angle(),)),
    "fall": Call(ilmek.fall, (angle(), length(0.04), Named("cycloidal"))),
    "cam_programme": Call(
        ilmek.cam_programme, tuple(Other(part, wrong=("rise",)) for part in PARTS), dict(start=angle())
    ),
    "CamProgramme": Call(
        ilmek.CamProgramme,
        (Other(PARTS, wrong=(PARTS[0], (), ("rise",))),),
        dict(start=angle(), revolves=Quantity(0.0, "m", 0.0)),
    ),
    "CamProgramme.at": Call(lambda q: programme().at(q), (Samples(0.5, "rad"),)),
    "plate_cam": Call(
        ilmek.plate_cam,
        (Other(programme()), length(0.1)),
        dict(roller_radius=length(0.01, 0.0), offset=length(0.01, 0.0)),
    ),
    "plate_cam by its pressure angle": Call(ilmek.plate_cam, (Other(programme()),), dict(pressure_angle=angle(0.5))),
    "PlateCam": Call(
        ilmek.PlateCam,
        (Other(programme()), Quantity(0.1, "m")),
        dict(offset=Quantity(0.01, "m", 0.0), roller_radius=Quantity(0.01, "m", 0.0)),
    ),
    "PlateCam.surface": Call(lambda q: cam().surface(q), (Samples(0.5, "rad"),)),
    "PlateCam.pressure_angle": Call(lambda q: cam().pressure_angle(q), (Samples(0.5, "rad"),)),
    "PlateCam.curvature": Call(lambda q: cam().curvature(q), (Samples(0.5, "rad"),)),
    "largest_pressure_angle": Call(ilmek.largest_pressure_angle, (Other(cam()),)),
    "path_four_bars": Call(
        ilmek.path_four_bars,
        (PointsOf(PATH),),
        dict(
            timing=Other(
                (0.0, 1.0, 2.0, 3.0), True, ([0.0, 90.0, 180.0, 360.0], ["0m"] * 4, (0.0, 1.0), "x", ((0.0, 1.0),) * 2)
            ),
            closed=Other(False, wrong=("no", 2)),
            bounds=Other({"crank": (0.01, 0.1)}, True, ({"crnk": (0, 1)}, {"crank": 3}, {"crank": (1, "x")}, [1])),
            kind=Named("crank-rocker"),
            transmission=Quantity(0.1, "rad", 1.0),
            count=Count(1),
            seed=Count(0),
            time_limit=Other(1e-9, wrong=(np.nan, "1m", -1.0, 0.0)),
            progress=Other(ilmek.Progress()),
        ),
        long=True,
    ),
    "motion_four_bars": Call(
        ilmek.motion_four_bars,
        (POSES, Other((0.1, 0.0, -0.4), wrong=((0.1, 0.2), 0.1, "x", (10, 20, 30), [[0.1]] * 3, (0.1, 0.2, None)))),
        long=True,
    ),
    "function_four_bars": Call(
        ilmek.function_four_bars,
        (
            Other(lambda x: np.sqrt(1 + x), wrong=(np.ones(3), lambda _: "x", lambda _: 1.0, lambda x: x * np.nan)),
            Quantity(0.0, "", 0.0),
            Quantity(3.0, "", 3.0),
            angle(1.4),
            angle(1.0),
        ),
        dict(criterion=Named("interpolation"), crank_start=angle(1.0), rocker_start=angle(0.8), ground=length(1.0)),
    ),
    "crank_rocker": Call(ilmek.crank_rocker, (angle(0.5), angle(3.1, 3.0)), dict(beta=angle(0.8), ground=length(0.3))),
    "read_picture": Call(ilmek.read_picture, (Other(MEDALLION, wrong=("no.png", ".", str(JANSEN), "a\0b", "")),)),
    "read_yarns": Call(ilmek.read_yarns, (Other(None, True, ("no.toml", ".", str(JANSEN), "a\0b", "")),)),
    "make_chart": Call(
        ilmek.make_chart,
        (
            Other(
                np.repeat(np.arange(0, 255, 2, np.uint8)[:96].reshape(4, 8, 3), 2, 0),
                wrong=(
                    "no.png",
                    np.zeros((4, 4, 3)),
                    np.zeros((4, 4, 3), bool),
                    np.full((4, 4, 3), 300),
                    np.zeros((4, 4)),
                    np.zeros((0, 4, 3), np.uint8),
                    np.full((4, 4, 3), -1),
                    np.zeros((4, 4, 4), np.uint8),
                ),
            ),
            Other(parse_size("30x40cm"), wrong=("x", "30x40", (0.3, 0.4))),
            Other(parse_quality("10x10/dm"), wrong=("x", 10, "0/dm")),
        ),
        dict(
            yarns=Other(None, True, ("no.toml", (), ("red",), Yarn)),
            knot=Named("symmetric"),
            colours=Other(2, True, ("x", 0, 2.5, np.zeros(2))),
            progress=Other(ilmek.Progress()),
            read=Other("auto", True, ("pictur", 3)),
        ),
    ),
    "Chart": Call(
        ilmek.Chart,
        (
            Other(KNOTS, equal=tuple(KNOTS.astype(kind) for kind in KINDS), wrong=WRONG_KNOTS),
            Other(ilmek.read_yarns()[:2], wrong=((), ("red", "blue"), 3)),
            Other(parse_size("30x40cm"), wrong=(3, (0.3, 0.4), "30x40")),
            Other(parse_quality("10x10/dm"), wrong=(3, "x")),
            Named("symmetric"),
        ),
    ),
    "write_chart": Call(
        lambda name, written: ilmek.write_chart(new_path(name), written),
        (Other("a.oxs", wrong=("a.txt", "a/b.oxs", "")), Other(chart())),
    ),
    "read_chart": Call(ilmek.read_chart, (Other(MEDALLION, wrong=("no.png", ".", "no.oxs", "a\0b", "")),), long=True),
    "weave": Call(
        lambda picture, out, **more: ilmek.weave(picture, new_path(out) if out == "new" else out, **more),
        (Other(MEDALLION, wrong=("no.png", 3)), Other("new", wrong=("a\0b", 3))),
        dict(
            size=Other("30x40cm", True, ("30x40", 3)),
            quality=Other("10x10/dm", True, ("x", 3)),
            knot=Other("symmetric", True, ("x", 3)),
            yarns=Other(None, True, ("no.toml", 3)),
            heads=Other(1, True, ("x", 0, 1.5, -1)),
            deadline=Other("400h", True, ("400", "4kg", -1.0, np.nan, [1])),
            aim=Other("price", True, ("cheap", 3)),
            warp_pitch=Other(None, True, ("x", "1kg", np.zeros(2))),
            loom=Other({}, wrong=({"x": 1}, {1: 1}, 3)),
            loom_file=Other(None, True, ("no.json", 3)),
            force=Other(False, wrong=("no", 3)),
            progress=Other(ilmek.Progress()),
            colours=Other(4, True, ("x", 0)),
        ),
        long=True,
    ),
    "tuft": Call(
        lambda picture, out, **more: ilmek.tuft(picture, new_path(out) if out == "new" else out, **more),
        (Other(MEDALLION, wrong=("no.png", 3)), Other("new", wrong=("a\0b", 3))),
        dict(
            technique=Named("gun"),
            size=Other("30x40cm", True, ("30x40", 3)),
            yarns=Other(None, True, ("no.toml", 3)),
            deadline=Other("400h", True, ("400", "4kg", -1.0, np.nan, [1])),
            machine=Other({}, wrong=({"x": 1}, {1: 1}, 3)),
            force=Other(False, wrong=("no", 3)),
            progress=Other(ilmek.Progress()),
            colours=Other(2, True, ("x", 0)),
        ),
        long=True,
    ),
    "kilim": Call(
        lambda picture, out, **more: ilmek.kilim(picture, new_path(out) if out == "new" else out, **more),
        (Other(MEDALLION, wrong=("no.png", 3)), Other("new", wrong=("a\0b", 3))),
        dict(
            size=Other("30x40cm", True, ("30x40", 3)),
            yarns=Other(None, True, ("no.toml", 3)),
            deadline=Other("4000h", True, ("400", "4kg", -1.0, np.nan, [1])),
            cloth=Other({}, wrong=({"x": 1}, {1: 1}, 3)),
            force=Other(False, wrong=("no", 3)),
            progress=Other(ilmek.Progress()),
            colours=Other(2, True, ("x", 0)),
        ),
        long=True,
    ),
    "study": Call(
        ilmek.study,
        (Named("beat-up"), Other({"swing": "28deg..32deg"}, wrong=({1: "1..2"}, [1], {"swing": 3}, {"swing": "x"}))),
        dict(
            goals=Other(["drive_torque_max"], wrong=("drive_torque_max", ["x"], [3], 3)),
            hold=Other(["drive_torque_max <= 9 N*m"], wrong=("x", ["x"], [3], 3)),
            record=Other([], wrong=("x", ["x"], [3], 3)),
            fixed=Other({}, wrong=({"x": 1}, {1: 1}, 3, {"swing": "30deg"})),
            method=Named("sweep"),
            sampling=Named("grid"),
            samples=Count(2),
            seed=Count(1),
            correlate=Other([], wrong=("x", ["x"], [3], 3, ["swing, speed = 0.5"])),
            yield_target=Other(0.0, wrong=("x", "1kg", 0.5, 2.0, -1.0, np.nan)),
            costs=Other({}, wrong=({"x": 1}, {1: 1}, 3, {"swing": 0.0})),
            file=Other(None, True, (3, "a\0b")),
            workers=Count(1),
            cluster=Other(None, True, (3,)),
            progress=Other(ilmek.Progress()),
        ),
        long=True,
    ),
    "optimise": Call(
        ilmek.optimise,
        (
            Named("beat-up"),
            Other({"swing": "28deg..32deg"}, wrong=({1: "1..2"}, [1], {"swing": 3}, {"swing": "x"})),
            Other("drive_torque_max", wrong=("x", ["x"], [3], 3)),
        ),
        dict(
            subject_to=Other(["drive_torque_max <= 9 N*m"], wrong=("x", ["x"], [3], 3)),
            samples=Count(2),
            seed=Count(1),
            workers=Count(1),
            progress=Other(ilmek.Progress()),
        ),
        long=True,
    ),
    "compare": Call(
        lambda file, machine, **more: ilmek.compare(measured() if file == "measured" else file, machine, **more),
        (Other("measured", wrong=("no.csv", 3)), Named("tufting")),
        dict(
            settings=Other({}, wrong=({"x": 1}, {1: 1}, 3)),
            fit=Other([], wrong=("friction_force", ["x"], [3], 3)),
            align=Other(False, wrong=("no", 3)),
            within=Other(0.5, True, ("x", "1kg", -1.0, np.nan)),
            progress=Other(ilmek.Progress()),
        ),
        long=True,
    ),
    "judged": Call(
        ilmek.judged,
        (Other(four_bar()),),
        dict(
            by=Other("crank", True, ("rocker", "", 3)),
            locked=Other({}, wrong=NO_LOCKED),
            inertias=Other(INERTIAS, wrong=WRONG_INERTIAS[1:]),
            loads=Other((GRAVITY,), wrong=(GRAVITY, (3,), ilmek.Gravity)),
            joint_frictions=Other((ilmek.PinFriction("B", 0.01, 0.1),), wrong=((GRAVITY,),)),
            speed=Quantity(10.0, "rad/s"),
        ),
    ),
    "Motion.plot": Call(
        lambda name, over: motion().plot(name, over=over), (Named("rocker angle"), Other("crank", True, ("x", "", 3)))
    ),
    "Motion.save": Call(
        lambda name: motion().save(new_path(name)), (Other("a.csv", wrong=("a.txt", "a", "a/b.csv", "")),)
    ),
    "Report.number": Call(lambda name: report().number(name), (Named("prime_radius"),)),
    "Report.figure": Call(lambda name: report().figure(name), (Named("cam"),)),
    "knot": Call(
        ilmek.knot,
        (TURKISH,),
        dict(
            pitch=length(0.002),
            warps=Count(12),
            first=PointOf(0j),
            keep_out=Quantity(0.0, "m", 0.0),
            smooth=Other(False, wrong=("no", 2)),
            closed=Other(False, wrong=("no", 2)),
        ),
        long=True,
    ),
    "cyclogram": Call(
        ilmek.cyclogram,
        (Named("weaver"),),
        dict(
            settings=Other({}, wrong=NO_SETTINGS),
            goal=Other(None, True, ("x", 3)),
            progress=Other(ilmek.Progress()),
        ),
        long=True,
    ),
    "call": Call(ilmek.call, (Other(chart()), Count(1)), dict(by=Named("runs"), direction=Named("right"))),
    "check": Call(
        of_programme(ilmek.check),
        (PROGRAMME,),
        dict(loom=Other(None, True, ("no.json", 3)), progress=Other(ilmek.Progress())),
        long=True,
    ),
    "inspect": Call(
        of_programme(ilmek.inspect),
        (PROGRAMME,),
        dict(row=Other(1, True, ("x", 0, 99, 1.5)), progress=Other(ilmek.Progress())),
        long=True,
    ),
    "convert": Call(
        lambda file, name, **more: of_programme(ilmek.convert)(file, new_path(name), **more),
        (PROGRAMME, Other("a.txt", wrong=("a.png", "a/b.txt", ""))),
        dict(force=Other(False, wrong=("no", 3)), progress=Other(ilmek.Progress())),
        long=True,
    ),
    "simulate_loom": Call(
        of_programme(ilmek.simulate_loom),
        (PROGRAMME,),
        dict(
            settings=Other({}, wrong=NO_SETTINGS),
            seed=Count(3),
            seeds=Count(0),
            deadline=Other(None, True, ("x", 3)),
            progress=Other(ilmek.Progress()),
        ),
        long=True,
    ),
    "run_loom": Call(
        lambda file, **more: of_programme(ilmek.run_loom)(file, journal=new_path("journal"), **more),
        (PROGRAMME,),
        dict(
            new=Other(False, wrong=("no", 3)), faults=Other(7, True, ("x", -1, 1.5)), rates=Other({}, wrong=NO_SETTINGS)
        ),
        long=True,
    ),
    "plc": Call(
        lambda file, out, **more: of_programme(ilmek.plc)(file, new_path(out), **more),
        (PROGRAMME, Other("new", wrong=("a\0b", 3))),
        dict(target=Named("openplc"), force=Other(False, wrong=("no", 3)), progress=Other(ilmek.Progress())),
        long=True,
    ),
    "plan": Call(
        ilmek.plan,
        (Other(ORDERS, wrong=("no.toml", 3, str(JANSEN))), Other(LOOMS, wrong=("no.toml", 3, str(JANSEN)))),
        dict(time_limit=Quantity(1.0, "s"), aim=Named("late"), progress=Other(ilmek.Progress())),
        long=True,
    ),
    "order": Call(
        ilmek.order,
        (Other(ROOT / "examples" / "order.toml", wrong=("no.toml", 3, str(JANSEN))), Other("order", wrong=(3,))),
        dict(progress=Other(ilmek.Progress())),
        long=True,
    ),
    "verify": Call(ilmek.verify, (Other("no record", wrong=("no.json", 3, str(JANSEN))),), long=True),
    "Chart.of": Call(
        ilmek.Chart.of,
        (
            Other(KNOTS, equal=tuple(KNOTS.astype(kind) for kind in KINDS), wrong=WRONG_KNOTS),
            Other(ilmek.read_yarns()[:2], wrong=(("red", "blue"),)),
            Other("30x40cm", wrong=("30x40", 3, (0.3, 0.4))),
            Other("10x10/dm", wrong=("x", 3)),
            Named("symmetric"),
        ),
    ),
    "list_machines": Call(ilmek.list_machines),
    "parameters": Call(ilmek.parameters, (Named("beat-up"),)),
    "design": Call(
        ilmek.design,
        (Named("beat-up"), Other({"beta": "48deg"}, wrong=({1: 2}, [1], {"beta": "48m"}, {"beta": np.zeros(2)}))),
        dict(
            progress=Other(ilmek.Progress()),
            swing=Other(0.5, True, wrong=("30kg", "x", 30, np.nan, [0.5], np.array([0.5]), 0.5j, True, "30", 1e300)),
        ),
        long=True,
    ),
    "Report[name]": Call(lambda name: report()[name], (Named("prime_radius"),)),
    "reproduce": Call(ilmek.reproduce, (Named("beat-up"),), dict(progress=Other(ilmek.Progress())), long=True),
    "units": Call(ilmek.units.parse_quantity, (FreeText("60mm"), FreeText("m"))),
    "PlateCam.response": Call(
        lambda follower, speed: cam().response(follower, speed),
        (Other(one_mass(2.0, 2e5, 0.05), wrong=(3.0,)), Quantity(15.0, "rad/s", 16.0)),
    ),
    "Motion.point": Call(lambda body, point: motion().point(body, point), (Named("rocker"), Named("E"))),
    "Motion.angle": Call(lambda body: motion().angle(body), (Named("rocker"),)),
    "Motion.omega": Call(lambda body: motion().omega(body), (Named("rocker"),)),
    "Motion.alpha": Call(lambda body: motion().alpha(body), (Named("rocker"),)),
    "Motion[point].jerk": Call(lambda point: motion()[point].jerk, (Named("rocker.E"),)),
    "Motion.origin": Call(lambda body: motion().origin(body), (Named("rocker"),)),
    "Motion.pose": Call(lambda sample: motion().pose(sample), (Count(3),)),
    "Forces.pin": Call(lambda name, on: forces().pin(name, on), (Named("B"), Named("rocker"))),
    "Forces.effort": Call(lambda name: forces().effort(name), (Named("crank"),)),
    "Forces.tooth": Call(lambda name: forces().tooth(name), (Other("x", wrong=("x", [])),)),
    "ForwardRun.require_turns": Call(lambda turns: run().require_turns(turns), (Quantity(1.0, "", 1.0),)),
    "Mechanism.point": Call(lambda body, point: four_bar().point(body, point), (Named("rocker"), Named("E"))),
}
"""Each public name, and the methods that its page documents, by one valid call."""
