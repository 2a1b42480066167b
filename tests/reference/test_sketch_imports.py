"""Mechanisms drawn in other programs: positions by closed forms from the numbers in their files."""

import cmath
import contextlib
import io
import json
import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.io.imports.reading import ImportedMechanism, imported_mechanism
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve

UNIT = 0.0254 / 96
"""One unit of the coordinates of Linkage [m]."""


def corner(a: complex, b: complex, to_a: float, to_b: float, near: complex) -> complex:
    """The point at two distances, the one of both nearer to another."""
    span = abs(b - a)
    along = (to_a**2 - to_b**2 + span**2) / (2 * span)
    across = math.sqrt(to_a**2 - along**2)
    unit = (b - a) / span
    return min((a + unit * complex(along, side * across) for side in (-1, 1)), key=lambda at: abs(at - near))


def read(tmp_path: Path, name: str, text: str) -> ImportedMechanism:
    path = tmp_path / name
    path.write_text(text, encoding="latin-1")
    return imported_mechanism(path)


def moved(imported: ImportedMechanism, value: float) -> Motion:
    return solve(imported.file.plan(), value).require()


LINKAGE2 = """<linkage2>
  <program zoom="1" units="Millimeters"/>
  <connector id="0" x="0" y="0" anchor="true" input="true" rpm="30"/>
  <connector id="1" x="40" y="30"/>
  <connector id="2" x="190" y="90"/>
  <connector id="3" x="160" y="0" anchor="true"/>
  <connector id="4" x="120" y="140" draw="true" name="pen"/>
  <connector id="5" x="130" y="66" slider="true"><slidelimit id="1"/><slidelimit id="2"/></connector>
  <connector id="6" x="130" y="-40" anchor="true"/>
  <connector id="7" x="1" y="1" layer="1"/>
  <Link id="0"><connector id="0"/><connector id="1"/></Link>
  <Link id="1"><connector id="1"/><connector id="2"/><connector id="4"/></Link>
  <Link id="2"><connector id="2"/><connector id="3"/></Link>
  <Link id="2"><connector id="5"/><connector id="6"/></Link>
  <Link id="4"><connector id="0"/><connector id="3"/></Link>
</linkage2>
"""


def test_linkage2_four_bar_with_a_slider(tmp_path: Path) -> None:
    """Two circles, then a circle and a line that moves; a link on two anchors is the frame."""
    imported = read(tmp_path, "a.linkage2", LINKAGE2)
    assert imported.file.machine.motions["L0"].speed == pytest.approx(-math.pi)
    assert "drawing and measuring elements" in imported.left_out
    for turned in np.linspace(-0.6, 0.2, 9):
        motion = moved(imported, turned)
        b = (40 + 30j) * cmath.exp(1j * turned)
        c = corner(b, 160, abs(150 + 60j), abs(30 + 90j), 190 + 90j)
        pen = b + (80 + 110j) * (c - b) / (150 + 60j)
        along = (c - b) / abs(c - b)
        arm = (130 - 40j - b) * along.conjugate()
        slider = b + along * (arm.real + math.sqrt(106**2 - arm.imag**2))
        for point, body, expected in (("P2", "L1", c), ("P4", "L1", pen), ("P5", "L2 2", slider)):
            assert abs(complex(motion.point(body, point).position[0]) - expected * UNIT) < 1e-12


ACTUATOR = """<linkage2>
  <connector id="0" x="0" y="0" anchor="true"/>
  <connector id="1" x="0" y="100"/>
  <connector id="2" x="-120" y="20" anchor="true"/>
  <Link id="0"><connector id="0"/><connector id="1"/></Link>
  <Link id="1" actuator="true" throw="20" cpm="15"><connector id="2"/><connector id="1"/></Link>
</linkage2>
"""


def test_linkage2_actuator(tmp_path: Path) -> None:
    """Law of cosines: an arm that a cylinder turns."""
    imported = read(tmp_path, "a.linkage2", ACTUATOR)
    drawn = abs(120 + 80j)
    lengths, _, _ = imported.file.machine.motions["C1"].law(np.array([0.0, 2.0]))
    assert lengths == pytest.approx([drawn * UNIT, (drawn + 20) * UNIT])
    for longer in np.linspace(0, 20, 5):
        motion = moved(imported, (drawn + longer) * UNIT)
        end = corner(-120 + 20j, 0, drawn + longer, 100, 100j)
        assert abs(complex(motion.point("L0", "P1").position[0]) - end * UNIT) < 1e-12


GEARS = """<linkage2>
  <connector id="0" x="0" y="0" anchor="true" input="true" rpm="-12"/>
  <connector id="1" x="90" y="0" anchor="true"/>
  <connector id="2" x="0" y="20"/>
  <connector id="3" x="90" y="35"/>
  <element id="0" gear="true" fastenlink="2"><connector id="0"/></element>
  <element id="1" gear="true"><connector id="1"/><fastenconnector id="3"/></element>
  <element id="2"><connector id="0"/><connector id="2"/></element>
  <ratios><ratio type="TYPE"><link id="0" size="20"/><link id="1" size="30"/></ratio></ratios>
</linkage2>
"""


@pytest.mark.parametrize(("kind", "sense"), [("gears", -1), ("chain", 1)])
def test_linkage2_gears_and_chain(kind: str, sense: int, tmp_path: Path) -> None:
    imported = read(tmp_path, "a.linkage2", GEARS.replace("TYPE", kind))
    for turned in np.linspace(-2, 2, 5):
        pin = moved(imported, turned).point("L1", "P3").position[0]
        assert abs(complex(pin) - (90 + 35j * cmath.exp(1j * sense * turned * 20 / 30)) * UNIT) < 1e-12


def test_linkage2_slider_on_an_arc(tmp_path: Path) -> None:
    """The slider keeps its distance from the middle of the arc."""
    centre, radius = 100 + 0j, 80.0
    limits = [centre + radius * cmath.exp(1j * angle) for angle in (0.6, 2.5)]
    slider = centre + radius * cmath.exp(1.7j)
    places = {0: 0j, 1: 10 + 30j, 2: slider, 3: limits[0], 4: limits[1]}
    entries = {
        0: 'anchor="true" input="true"',
        2: 'slider="true" slideradius="80"',
        3: 'anchor="true"',
        4: 'anchor="true"',
    }
    connectors = "".join(
        f'<connector id="{key}" x="{at.real:.12f}" y="{at.imag:.12f}" {entries.get(key, "")}>'
        + ('<slidelimit id="3"/><slidelimit id="4"/>' if key == 2 else "")
        + "</connector>"
        for key, at in places.items()
    )
    links = "".join(
        f'<Link id="{key}">' + "".join(f'<connector id="{end}"/>' for end in ends) + "</Link>"
        for key, ends in enumerate([(0, 1), (1, 2), (3, 4)])
    )
    imported = read(tmp_path, "a.linkage2", f"<linkage2>{connectors}{links}</linkage2>")
    for turned in np.linspace(-0.2, 0.2, 5):
        end = complex(moved(imported, turned).point("L1", "P2").position[0]) / UNIT
        crank = places[1] * cmath.exp(1j * turned)
        assert abs(end - corner(crank, centre, abs(slider - places[1]), radius, slider)) < 1e-8


DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"


def encoded(number: float) -> str:
    """A number of an address: thousandths to base 64, a leading 0 for a minus."""
    rest, text = abs(round(number * 1000)), ""
    while rest or not text:
        text = DIGITS[rest % 64] + text
        rest //= 64
    return ("0" if number < 0 else "") + text


def address(joints: list[tuple[str, str, complex, float]], links: list[str], unit: str = "1") -> str:
    entries = "".join(
        f"{flags}{name},{name},{encoded(at.real)},{encoded(at.imag)},{encoded(angle)}."
        for flags, name, at, angle in joints
    )
    body = f"0P.TY.A,0.{unit}01.{entries}.{''.join(f'{link}.' for link in links)}...JA"
    return f"https://pmks.example/?{body}{DIGITS[len(body) % 62]}"


def link(name: str, kind: str = "R") -> str:
    return f"Y{kind}{name},{name},Fe,Fe,0,0,c5cae9,{','.join(name)},,"


FOUR_BAR = [("M", "A", 0j, 0.0), ("G", "B", 1.5 + 2j, 0.0), ("G", "C", 8 + 4.25j, 0.0), ("K", "D", 7 - 1j, 0.0)]
SLIDER_CRANK = [("M", "A", 0j, 0.0), ("G", "B", 1 + 2j, 0.0), ("G", "C", 7 - 0.5j, 0.0), ("L", "D", 7 - 0.5j, 0.3)]


def test_pmks_four_bar(tmp_path: Path) -> None:
    """Two circles, in cm; 10 rpm clockwise."""
    imported = read(tmp_path, "a.txt", address(FOUR_BAR, [link("AB"), link("BC"), link("CD")]))
    assert imported.left_out[0].startswith("masses")
    assert imported.file.machine.motions["AB"].speed == pytest.approx(-2 * math.pi / 6)
    for turned in np.linspace(-0.5, 0.5, 7):
        b = (1.5 + 2j) * cmath.exp(1j * turned)
        c = corner(b, 7 - 1j, abs(6.5 + 2.25j), abs(1 + 5.25j), 8 + 4.25j)
        assert abs(complex(moved(imported, turned).point("BC", "C").position[0]) - 0.01 * c) < 1e-12


def test_pmks_slider_crank(tmp_path: Path) -> None:
    """A circle and the line of the slide, in m; the piston does not turn."""
    imported = read(tmp_path, "a.txt", address(SLIDER_CRANK, [link("AB"), link("BC"), link("CD", "P")], unit="2"))
    along = cmath.exp(0.3j)
    for turned in np.linspace(-0.5, 0.5, 7):
        motion = moved(imported, turned)
        b = (1 + 2j) * cmath.exp(1j * turned)
        arm = (b - (7 - 0.5j)) * along.conjugate()
        c = 7 - 0.5j + along * (arm.real + math.sqrt(abs(6 - 2.5j) ** 2 - arm.imag**2))
        assert abs(complex(motion.point("BC", "C").position[0]) - c) < 1e-12
        assert abs(float(motion.angle("CD")[0])) < 1e-12


PYSLVS = """M[J[R, color[Green], P[0, 0], L[ground, crank]],  # the motor
J[R, P[30, 40], L[crank, rod]], J[RP, A[10], color[(1, 2, 3)], P[200, 20], L[ground, rod, arm]],
J[R, P[260, 90], L[arm, rocker]], J[R, P[300, 0], L[ground, rocker]]]
"""


def test_pyslvs_slider_of_two_links(tmp_path: Path) -> None:
    """The crank drives a pin in a slot of the ground, which two links share."""
    imported = read(tmp_path, "a.pyslvs", PYSLVS)
    assert imported.left_out == ("the input, which the file does not have: P0 turns crank",)
    along = cmath.exp(1j * math.radians(10))
    for turned in np.linspace(-0.3, 0.3, 7):
        motion = moved(imported, turned)
        crank = 50 * cmath.exp(1j * (math.atan2(4, 3) + turned))
        arm = (crank - (200 + 20j)) * along.conjugate()
        pin = 200 + 20j + along * (arm.real + math.sqrt(abs(170 - 20j) ** 2 - arm.imag**2))
        top = corner(pin, 300, abs(60 + 70j), abs(40 - 90j), 260 + 90j)
        assert abs(complex(motion.point("rod", "P2").position[0]) - 1e-3 * pin) < 1e-12
        assert abs(complex(motion.point("rocker", "P3").position[0]) - 1e-3 * top) < 1e-12


def sketch_file() -> str:
    """A four-bar of SolveSpace: crank from the origin, coupler, rocker to a locked point, and a bracket."""
    lines = {4: (0j, 30 + 40j), 5: (30 + 40j, 150 + 100j), 6: (150 + 100j, 140 + 0j), 7: (150 + 100j, 120 + 160j)}
    blocks = ["\u00b1\u00b2\u00b3SolveSpaceREVa\n"]
    handles: dict[complex, list[str]] = {}
    for request, ends in lines.items():
        keys = [f"{request:04x}000{end}" for end in (1, 2)]
        blocks.append(
            f"Entity.h.v={request:04x}0000\nEntity.type=11000\nEntity.construction=0\n"
            f"Entity.point[0].v={keys[0]}\nEntity.point[1].v={keys[1]}\nAddEntity\n"
        )
        for key, at in zip(keys, ends, strict=True):
            handles.setdefault(at, []).append(key)
            blocks.append(
                f"Entity.h.v={key}\nEntity.type=2001\nEntity.actPoint.x={at.real:.20f}\n"
                f"Entity.actPoint.y={at.imag:.20f}\nAddEntity\n"
            )
    blocks.append("Entity.h.v=00010001\nEntity.type=2000\nAddEntity\n")
    pairs = [(key, same) for key, *others in handles.values() for same in others] + [(handles[0j][0], "00010001")]
    constraints = [f"type=20\nptA.v={first}\nptB.v={second}" for first, second in pairs]
    constraints += [f"type=200\nptA.v={handles[140 + 0j][0]}", "type=122\nentityA.v=00050000\nentityB.v=00070000"]
    constraints += ["type=30\nptA.v=00040001\nptB.v=00040002\nvalA=50", "type=90\nentityA.v=00050000"]
    for index, constraint in enumerate(constraints, 1):
        keyed = constraint.replace("\n", "\nConstraint.")
        blocks.append(f"Constraint.h.v={index:08x}\nConstraint.{keyed}\nConstraint.reference=0\nAddConstraint\n")
    return "\n".join(blocks)


def test_solvespace_four_bar(tmp_path: Path) -> None:
    """Two circles; the bracket turns with the coupler."""
    imported = read(tmp_path, "a.slvs", sketch_file())
    assert imported.left_out[0].startswith("constraint of type 90")
    assert len(imported.file.mechanism.bodies) == 4
    for turned in np.linspace(-0.3, 0.3, 7):
        motion = moved(imported, turned)
        b = (30 + 40j) * cmath.exp(1j * turned)
        c = corner(b, 140, abs(120 + 60j), abs(10 + 100j), 150 + 100j)
        bracket = c + (-30 + 60j) * (c - b) / (120 + 60j)
        own = complex(motion.point("L50000", "P70002").position[0])
        assert abs(own - 1e-3 * bracket) < 1e-12


def drawing(units: int = 4) -> str:
    """A four-bar in DXF with a lever on the coupler, its pins as circles."""
    document = ezdxf.new(units=units)
    space = document.modelspace()
    space.add_line((0, 0), (3, 4), dxfattribs={"layer": "input"})
    space.add_lwpolyline([(3, 4), (15, 10), (9, 13)])
    space.add_line((15, 10), (14, 0))
    space.add_line((15 - 2, 9), (13, 30))
    space.add_circle((13, 9), 0.5)
    space.add_line((13, 30), (20, 31))
    for centre in ((0, 0), (14, 0), (20, 31)):
        space.add_circle(centre, 0.4, dxfattribs={"layer": "ground"})
    space.add_text("crank")
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


@pytest.mark.parametrize(("units", "length"), [(4, 1e-3), (5, 1e-2), (1, 0.0254), (0, 1e-3)])
def test_dxf_skeleton(units: int, length: float, tmp_path: Path) -> None:
    """Two circles, and the pin in the middle of the coupler at its part of the way."""
    imported = read(tmp_path, "a.dxf", drawing(units))
    assert imported.left_out == ("TEXT",)
    for turned in np.linspace(-0.3, 0.3, 7):
        motion = moved(imported, turned)
        b = (3 + 4j) * cmath.exp(1j * turned)
        c = corner(b, 14, abs(12 + 6j), abs(1 + 10j), 15 + 10j)
        pin = b + (10 + 5j) * (c - b) / (12 + 6j)
        tip = corner(pin, 20 + 31j, 21, abs(7 + 1j), 13 + 30j)
        places = {point: body.name for body in imported.file.mechanism.bodies for point in body.points}
        ends = [complex(motion.point(body, point).position[0]) / length for point, body in places.items()]
        for expected in (c, pin, tip):
            assert min(abs(end - expected) for end in ends) < 1e-9


DAMAGED = {
    "unknown connector": (
        LINKAGE2.replace('<connector id="6"/>', '<connector id="5"/>'),
        "cannot|on no|no joint|constrained",
    ),
    "one limit": (LINKAGE2.replace('<slidelimit id="2"/>', ""), "slider 5 has 1 limits"),
    "no common link": (LINKAGE2.replace('<slidelimit id="2"/>', '<slidelimit id="6"/>'), "on no common link"),
    "no number": (LINKAGE2.replace('x="190"', 'x="far"'), "x of <connector> 2 is 'far'"),
    "no anchor": (LINKAGE2.replace("anchor", "floating"), "no joint on the ground"),
    "actuator": (ACTUATOR.replace('<connector id="2"/><connector id="1"/>', '<connector id="2"/>'), "has 1 connectors"),
    "gear": (GEARS.replace('size="30"', 'size="0"'), "a gear has size 0"),
    "gear of no link": (GEARS.replace('<link id="1"', '<link id="9"'), "a ratio has the links"),
    "address cut": (address(FOUR_BAR, [link("AB"), link("BC"), link("CD")])[:-5], "check character"),
    "unit": (address(FOUR_BAR, [link("AB"), link("BC"), link("CD")], unit="7"), "unit of length '7'"),
    "unknown joint": (address(FOUR_BAR, [link("AB"), link("BX"), link("CD")]), "unknown point 'X'"),
    "loose slide": (address(SLIDER_CRANK, [link("AB"), link("BC")]), "the slide D joins 1 links"),
    "grammar": (PYSLVS.replace("J[RP", "J[RQ"), "no expression of Pyslvs"),
    "slot of one": (PYSLVS.replace("L[ground, rod, arm]", "L[rod]"), "has 1 links"),
    "no lines": ("\u00b1\u00b2\u00b3SolveSpaceREVa\n\n", "no line segment"),
    "no lock": (sketch_file().replace("Constraint.type=200\n", "Constraint.type=90\n"), "no input"),
    "no dxf": ("0\nSECTION\n2\nHEADER\n", "is no DXF"),
    "empty drawing": ("0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n", "has no lines"),
    "another text": ("crank 20 mm, rod 80 mm\n", "JSON"),
    "another object": (json.dumps({"links": []}), "no list of joints"),
}


@pytest.mark.parametrize("case", DAMAGED)
def test_damaged_files_are_one_error(case: str, tmp_path: Path) -> None:
    text, message = DAMAGED[case]
    suffix = "slvs" if "SolveSpace" in text else "txt"
    with pytest.raises(MechanismError, match=message) as error:
        read(tmp_path, f"file.{suffix}", text)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("seed", range(300))
def test_mutated_files_are_read_or_refused(seed: int, tmp_path: Path) -> None:
    """Pieces deleted, doubled and reversed: a mechanism or a MechanismError, nothing else."""
    rng = np.random.default_rng(seed)
    texts = (LINKAGE2, ACTUATOR, GEARS, PYSLVS, sketch_file(), drawing())
    name, text = ("a.slvs", "a.slvs", "a.slvs", "a.slvs", "a.slvs", "a.dxf")[seed % 6], texts[seed % 6]
    for _ in range(int(rng.integers(1, 6))):
        start, length = int(rng.integers(len(text))), int(rng.integers(1, 12))
        piece = text[start : start + length]
        text = text[:start] + ("", piece * 2, piece[::-1])[int(rng.integers(3))] + text[start + length :]
    with contextlib.suppress(MechanismError):
        read(tmp_path, name, text)
