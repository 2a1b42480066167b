"""Tasks of the linkage editor: structure of finished and unfinished mechanisms, motion, a dragged joint, quality."""

import cmath
import copy
import math
import tomllib
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from ilmek.errors import MechanismError, ParameterError
from ilmek.io.mechanism_file import mechanism_of_data, read_mechanism
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.linkage.answer import MechanismAnswer
from ilmek.jobs.studio.linkage.foreign import ForeignRequest, foreign_mechanism
from ilmek.jobs.studio.linkage.part import joined_part
from ilmek.jobs.studio.linkage.quality import quality
from ilmek.jobs.studio.linkage.tasks import DraggedJoint, MechanismRequest, changed, mechanism

EXAMPLES = Path(__file__).parents[2] / "examples"
MECHANISMS = ("jansen_leg", "stephenson_dwell", "tufting_needle", "quick_return", "slider_crank_press", "peaucellier")
MECHANISMS += ("class_three", "klann_leg")

FOUR_BAR: dict[str, Any] = {
    "name": "four-bar",
    "inputs": {"A0": "crank"},
    "branches": {"B": 1},
    "bodies": {
        "ground": {"points": {"A0": [0, 0], "B0": ["300mm", 0]}},
        "crank": {"length": "60mm"},
        "coupler": {"length": "200mm", "points": {"P": {"radius": "100mm", "angle": "25deg"}}},
        "rocker": {"length": "230mm"},
    },
    "joints": {
        "A0": {"pin": ["ground", "crank"]},
        "A": {"pin": ["crank", "coupler"]},
        "B": {"pin": ["coupler", "rocker"]},
        "B0": {"pin": ["ground", "rocker"]},
    },
}


def example(name: str) -> dict[str, Any]:
    return tomllib.loads((EXAMPLES / f"{name}.toml").read_text())


def shown(data: dict[str, Any], **more: Any) -> MechanismAnswer:
    return mechanism(MechanismRequest(data, **more), Context())


def poses_of(answer: MechanismAnswer, sample: int) -> dict[str, tuple[float, float, float]]:
    assert answer.motion is not None
    return {
        body: (float(one.x[sample] or 0), float(one.y[sample] or 0), float(one.angle[sample] or 0))
        for body, one in answer.motion.poses.items()
    }


def position(answer: MechanismAnswer, poses: dict[str, tuple[float, float, float]], joint: str) -> complex:
    """A joint of the file in the world [m]; of a slide the point of its guide."""
    one = next(one for one in answer.joints if one.file_joint == joint)
    body = one.bodies[-1]
    x, y, angle = poses.get(body, (0.0, 0.0, 0.0))
    local = next(other.points for other in answer.bodies if other.name == body)[one.name]
    return complex(x, y) + complex(*local) * cmath.rect(1, angle)


def test_the_motion_is_that_of_the_command_line_to_six_digits() -> None:
    answer = shown(FOUR_BAR)
    motion = answer.motion
    assert motion is not None
    assert len(motion.values) == 361
    assert motion.status == [0] * 361
    crank = complex(0.06 * math.cos(1.0), 0.06 * math.sin(1.0))
    at = np.interp(1.0, motion.values, motion.points["crank"]["A"].x)  # type: ignore[arg-type]
    assert at == pytest.approx(crank.real, abs=2e-5)
    assert motion.closing == ((0.0, 2 * math.pi),)
    assert set(motion.points["coupler"]) == {"B", "P"}
    assert min(angle or 0 for angle in motion.transmission["B"]) > 0.5


def test_assur_groups_are_named_as_one_draws() -> None:
    structure = shown(FOUR_BAR).structure
    assert (structure.degrees_of_freedom, structure.driven, structure.loops) == (1, 1, 1)
    assert [(group.kind, group.symbol, group.bodies, group.free) for group in structure.groups] == [
        ("input", "", ("crank",), ""),
        ("dyad", "RRR", ("coupler", "rocker"), "B"),
    ]
    assert structure.missing is None


def test_an_unfinished_mechanism_moves_as_far_as_it_is_determined() -> None:
    data = copy.deepcopy(FOUR_BAR)
    data["joints"]["B0"]["pin"] = ["ground", "rocker"]
    data["bodies"]["link"] = {"points": {"C": ["10mm", "20mm"], "D": ["30mm", "40mm"]}}
    data["bodies"]["arm"] = {"points": {"B0": [0, 0], "E": ["50mm", 0]}}
    data["joints"]["B0"]["pin"] = ["ground", "rocker", "arm"]
    answer = shown(data)
    assert answer.structure.loose == ("link",)
    assert answer.bodies[-1].points == {"C": (0.01, 0.02), "D": (0.03, 0.04)}
    assert answer.structure.left == ("arm",)
    assert answer.structure.missing is not None
    assert "under-constrained at arm" in answer.structure.missing.given
    assert answer.motion is not None
    assert set(answer.motion.poses) == {"crank", "coupler", "rocker"}
    assert set(answer.poses) == {"link", "arm"}


def test_a_drawing_without_a_drive_has_a_structure_and_no_motion() -> None:
    answer = shown({"bodies": {"ground": {"points": {"O": [0, 0]}}, "link": {"points": {"O": [0, 0], "A": ["9mm", 0]}}},
                    "joints": {"O": {"pin": ["ground", "link"]}}})  # fmt: skip
    assert answer.motion is None
    assert answer.structure.degrees_of_freedom == 1
    assert "under-constrained" in (answer.structure.missing.given if answer.structure.missing else "")
    assert shown({}).structure.degrees_of_freedom == 0
    bars = {f"bar{n}": {"points": {f"P{n}": [0, 0], f"P{n + 1}": ["9mm", 0]}} for n in range(3)}
    pins = {f"P{n}": {"pin": [f"bar{n - 1}", f"bar{n}"]} for n in (1, 2)}
    chain = shown({"bodies": bars, "joints": pins}).structure
    assert (chain.degrees_of_freedom, chain.loops) == (5, 0)


def test_branches_of_a_drawing_are_those_that_it_shows() -> None:
    drawn = shown(FOUR_BAR)
    poses = poses_of(drawn, 0)
    points = {name: position(drawn, poses, name) for name in FOUR_BAR["joints"]}
    links = {"crank": ("A0", "A"), "coupler": ("A", "B"), "rocker": ("B", "B0")}
    for mirrored in (1, -1):
        at = {name: [f"{one.real * 1e3}mm", f"{mirrored * one.imag * 1e3}mm"] for name, one in points.items()}
        data = {
            "bodies": {"ground": {"points": {"A0": at["A0"], "B0": at["B0"]}}}
            | {body: {"points": {name: at[name] for name in names}} for body, names in links.items()},
            "joints": FOUR_BAR["joints"],
            "inputs": FOUR_BAR["inputs"],
        }
        answer = shown(data)
        assert answer.changes == ()  # the coordinates state the branch
        assert [(group.branch, group.drawn) for group in answer.structure.groups] == [(0, False), (mirrored, True)]
        assert answer.motion is not None
        assert answer.motion.status[0] == 0
        contrary = shown({**data, "branches": {"B": -mirrored}})
        assert contrary.refused is not None
        assert contrary.refused.allowed == f"the drawing has B = {mirrored:+d}"
        assert contrary.structure.groups[1].branch == mirrored


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("name", MECHANISMS)
def test_only_the_dragged_joint_moves(name: str) -> None:
    data = example(name)
    before = shown(data, steps=36)
    poses = poses_of(before, 2)
    for joint, table in data["joints"].items():
        if "slide" in table:
            continue
        to = position(before, poses, joint) + complex(0.002, 0.001)
        answer = shown(data, steps=4, poses=poses, drag=DraggedJoint(joint, to.real, to.imag))
        after = mechanism_of_data(changed(data, list(answer.changes)))
        fixed = {
            one.name: f"{answer.values[one.name]}{'rad' if one.kind == 'rotation' else 'm'}" for one in answer.inputs
        }
        there = shown(changed(data, list(answer.changes)), fixed=fixed, poses=poses)
        moved = poses_of(there, 0)
        on_line = any(not data["bodies"][body].get("points") and "length" not in data["bodies"][body]
                      for body in table["pin"] if body != "ground")  # fmt: skip
        assert after.mechanism.name == before.name
        for other in data["joints"]:
            if "slide" in data["joints"][other]:
                continue
            apart = abs(position(there, moved, other) - (to if other == joint else position(before, poses, other)))
            assert apart < 1e-6 or (on_line and other == joint), (joint, other, apart)


def test_a_drag_keeps_the_form_of_each_number() -> None:
    poses = poses_of(shown(FOUR_BAR), 40)
    answer = shown(FOUR_BAR, poses=poses, drag=DraggedJoint("B", 0.2, 0.2))
    changes = {".".join(one.path): one.value for one in answer.changes}
    assert set(changes) == {"bodies.coupler.length", "bodies.rocker.length"}
    assert changes["bodies.rocker.length"] == "223.6068mm"
    below = shown(FOUR_BAR, poses=poses, drag=DraggedJoint("B", 0.2, -0.2))
    assert ("branches", "B") in {one.path for one in below.changes}


def test_an_impossible_mechanism_is_drawn_up_to_where_it_fails_with_the_reason() -> None:
    data = copy.deepcopy(FOUR_BAR)
    data["bodies"]["crank"]["length"] = "200mm"
    motion = shown(data).motion
    assert motion is not None
    assert motion.fault is not None
    assert "cannot close for crank" in motion.fault.given
    assert [round(math.degrees(end), 3) for ends in motion.closing for end in ends] == [0, 117.226, 242.774, 360]
    assert motion.dead_centres[0].bodies == ("coupler", "rocker")
    assert motion.poses["rocker"].x[0] is not None
    assert math.isnan(motion.poses["rocker"].angle[180] or math.nan)
    assert b"null" in msgspec.json.encode(motion)


EVERY = {"ground", "crank", "coupler", "rocker"}


@pytest.mark.parametrize(
    ("path", "value", "words", "left"),
    [
        (("bodies", "crank"), {"length": 0}, "bodies.crank.length: is 0 m", EVERY - {"crank"}),
        (("bodies", "crank"), {"points": {"A0": [0, 0], "A": [0, 0]}}, "zero length", EVERY - {"crank"}),
        (("joints", "A"), {"pin": ["crank", "crank"]}, "joins 'crank' to itself", EVERY - {"coupler"}),
        (("bodies", "rocker"), {"length": "1mm"}, "300 to 1", EVERY),
        (("loads",), {"pull": {"force": "1N", "on": "crank.Z"}}, "loads.pull", EVERY),
        (("branches",), {"Q": 1}, "branches", EVERY),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_left_out_with_the_reason(
    path: tuple[str, ...], value: Any, words: str, left: set[str]
) -> None:
    data = copy.deepcopy(FOUR_BAR)
    table = data
    for key in path[:-1]:
        table = table[key]
    table[path[-1]] = value
    answer = shown(data, steps=4)
    assert answer.refused is not None
    assert words in answer.refused.given
    assert {body.name for body in answer.bodies} == left


def test_wrong_entries_are_named_by_their_key() -> None:
    data = copy.deepcopy(FOUR_BAR)
    data["bodies"]["crank"]["length"] = "60 apples"
    refused = shown(data, drag=DraggedJoint("A", 0, 0)).refused
    assert refused is not None
    assert "mechanism, bodies.crank.length: " in refused.given
    fault = quality(MechanismRequest(data), Context()).fault
    assert fault is not None
    assert fault.given == refused.given
    with pytest.raises(ParameterError, match="steps"):
        shown(FOUR_BAR, steps=10**7)
    deep: Any = []
    for _ in range(30):
        deep = [deep]
    with pytest.raises(MechanismError, match="nested too deeply"):
        mechanism_of_data({"bodies": deep})


def test_a_drag_that_makes_a_link_of_no_length_is_refused() -> None:
    answer = shown(FOUR_BAR, poses=poses_of(shown(FOUR_BAR), 0), drag=DraggedJoint("A", 0, 0))
    assert answer.refused is not None
    assert answer.refused.given == "link 'crank' would have no length: A and A0 coincide"
    assert answer.changes == ()
    assert answer.motion is not None
    unknown = shown(FOUR_BAR, drag=DraggedJoint("Z", 0, 0)).refused
    assert unknown is not None
    assert "no joint 'Z'" in unknown.given


def test_forces_and_rates_come_if_required() -> None:
    data = example("tufting_needle")
    motion = shown(data, rates=True, forces=True).motion
    assert motion is not None
    assert motion.forces is not None
    file = read_mechanism(EXAMPLES / "tufting_needle.toml")
    assert set(motion.forces.joints) == {joint.name for joint in file.mechanism.joints}
    assert max(abs(one or 0) for one in motion.forces.effort) > 1
    assert motion.rates["needle"]["F"].velocity.x[10] is not None
    without = shown(FOUR_BAR, forces=True).motion
    assert without is not None
    assert without.forces is None
    assert "mass" in without.no_forces


def test_quality_has_circuits_dead_centres_curves_and_checks() -> None:
    found = quality(MechanismRequest(FOUR_BAR), Context())
    assert [one.current for one in found.circuits].count(True) == 1
    assert len(found.circuits) == 2
    assert found.mobility == "1 degree of freedom by count and by rank"
    assert [one.point for one in found.curves] == ["P"]
    assert found.curves[0].length > 0.1
    assert found.transmission[0].pin == "B"
    open_chain = {key: value for key, value in FOUR_BAR.items() if key != "inputs"}
    assert quality(MechanismRequest(open_chain), Context()).fault is not None


def in_place(**corners: complex) -> dict[str, Any]:
    """A four-bar by the coordinates of its pins [m], drawn in one frame."""
    at = {name: [f"{point.real!r}m", f"{point.imag!r}m"] for name, point in corners.items()}
    links = {"ground": ("A0", "B0"), "crank": ("A0", "A"), "coupler": ("A", "B"), "rocker": ("B", "B0")}
    return {
        "bodies": {body: {"points": {name: at[name] for name in names}} for body, names in links.items()},
        "joints": FOUR_BAR["joints"],
        "inputs": FOUR_BAR["inputs"],
    }


DRAWN = in_place(A0=0j, A=0.04 + 0.045j, B=0.22 + 0.21j, B0=0.3 + 0j)


@pytest.mark.parametrize("stated", [{}, {"branches": {"B": 1}}])
def test_a_joint_dragged_to_the_other_side_takes_the_other_branch(stated: dict[str, Any]) -> None:
    answer = shown(DRAWN | stated, drag=DraggedJoint("B", 0.22, -0.21))
    changes = {one.path: one.value for one in answer.changes}
    assert changes.get(("branches", "B")) == (-1 if stated else None)  # what the drawing shows is not written
    after = mechanism_of_data(changed(DRAWN | stated, list(answer.changes)))
    assert after.mechanism.branches == {"B": -1}
    assert answer.refused is None


def test_a_joint_dragged_in_another_position_keeps_its_branch() -> None:
    """In the new frames the coordinates coincide nowhere: the branch is written."""
    poses = poses_of(shown(DRAWN), 40)
    answer = shown(DRAWN, poses=poses, drag=DraggedJoint("B", 0.2, 0.19))
    after = mechanism_of_data(changed(DRAWN, list(answer.changes)))
    assert after.mechanism.branches == {"B": 1}
    assert {one.path: one.value for one in answer.changes}[("branches", "B")] == 1


def test_a_cylinder_of_a_loose_body_is_left_out_with_it() -> None:
    data = {
        "bodies": {"ground": {"points": {"A": [0, 0]}}, "arm": {"points": {"A": [0, 0]}}, "lid": {}},
        "joints": {"A": {"pin": ["ground", "arm"]}},
        "inputs": {},
        "cylinders": {"lift": {"between": ["ground.A", "lid.P"]}},
        "branches": {"lid": 1},  # a joint may have the name of a body
    }
    part, loose = joined_part(data)
    assert loose == ("lid",)
    assert "cylinders" not in part
    assert part["branches"] == {"lid": 1}


def test_a_file_of_another_program_is_the_text_of_a_mechanism_file(tmp_path: Path) -> None:
    """As `ilmek import`; bytes of no UTF-8 are read as the programs write them."""
    joints = {"0,0": "ground,crank", "0,20": "crank,rod", "90,60": "rod,rocker", "80,0": "ground,rocker"}
    expression = f"M[{','.join(f'J[R,P[{at}],L[{links}]]' for at, links in joints.items())}]"
    answer = foreign_mechanism(
        ForeignRequest("a.txt", b"# four-bar, 20 \xb5m\n" + expression.encode()), Context(str(tmp_path))
    )
    assert mechanism_of_data(tomllib.loads(answer.text)).mechanism.name == "mechanism"
    assert answer.left_out == ("the input, which the file does not have: P0 turns crank",)
    for content, message in ((b"\0" * 2_000_000, "at most 1,000,000"), (b"crank", "a.txt: .*JSON")):
        with pytest.raises(MechanismError, match=message):
            foreign_mechanism(ForeignRequest("a.txt", content), Context(str(tmp_path)))
