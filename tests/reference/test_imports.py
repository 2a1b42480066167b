"""Mechanisms of other programs: positions by their own definitions, and errors of damaged files."""

import cmath
import contextlib
import json
from pathlib import Path

import mujoco
import numpy as np
import pytest

from ilmek.cli import main
from ilmek.errors import MechanismError
from ilmek.io.imports.reading import imported_mechanism
from ilmek.io.mechanism_file import read_mechanism
from ilmek.linkage.solve import solve

URDF = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0.1" rpy="0 0.3 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.03" izz="0.02" ixy="0" ixz="0.001" iyz="0"/></inertial></link>
  <link name="flange"><inertial><mass value="0.5"/><inertia iyy="0.002"/></inertial></link>
  <link name="fore"/>
  <link name="tool"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0.1 0 0.4" rpy="0 0.2 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="9" velocity="1"/>
  </joint>
  <joint name="weld" type="fixed"><parent link="upper"/><child link="flange"/><origin xyz="0.4 0 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="flange"/><child link="fore"/>
    <origin xyz="0.1 0 0" rpy="0 0.5 0"/><axis xyz="0 -1 0"/></joint>
  <joint name="reach" type="prismatic"><parent link="fore"/><child link="tool"/>
    <origin xyz="0.05 0 0.02" rpy="0 -0.4 0"/><axis xyz="1 0 0"/></joint>
</robot>
"""


def about_y(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def test_urdf_arm(tmp_path: Path) -> None:
    """The tool by the product of the transforms of the specification, at 20 random values of its joints."""
    (tmp_path / "arm.urdf").write_text(URDF)
    file, left_out = imported_mechanism(tmp_path / "arm.urdf")
    assert left_out == ("limit of joint shoulder", "the sense of shoulder: its angle counts against it")
    rng = np.random.default_rng(0)
    q1, q2, s = rng.uniform(-1, 1, (3, 20))
    senses = {"shoulder": -1, "elbow": +1}  # about the normal of x to the right and z up, which is -y
    motion = solve(file.plan(), {"upper": senses["shoulder"] * q1, "fore": senses["elbow"] * q2, "reach": s}).require()
    for k in range(20):
        turned = about_y(0.2) @ about_y(q1[k])
        at = np.array([0.1, 0, 0.4]) + turned @ np.array([0.5, 0, 0])
        turned = turned @ about_y(0.5) @ about_y(-q2[k])
        at = at + turned @ np.array([0.05, 0, 0.02])
        at = at + turned @ about_y(-0.4) @ np.array([s[k], 0, 0])
        own = motion.point("tool", "reach").position[k]
        assert abs(own - complex(at[0], at[2])) < 1e-12
    inertia = file.inertias["upper"]
    assert inertia.mass == pytest.approx(2.5)
    centre = (2 * np.array([0.2, 0, 0.1]) + 0.5 * np.array([0.4, 0, 0])) / 2.5
    world = np.array([0.1, 0, 0.4]) + about_y(0.2) @ centre
    assert inertia.centre == pytest.approx(complex(world[0], world[2]))
    arms = [np.array([0.2, 0, 0.1]) - centre, np.array([0.4, 0, 0]) - centre]
    assert inertia.moment == pytest.approx(0.03 + 0.002 + 2 * arms[0] @ arms[0] + 0.5 * arms[1] @ arms[1])


MJCF = """<mujoco model="slider crank">
  <compiler angle="degree"/>
  <option gravity="0 0 -9.81"/>
  <worldbody>
    <body name="crank" pos="0 0 0.3" euler="0 -40 0">
      <joint name="O" axis="0 1 0"/>
      <inertial pos="0.03 0 0" mass="0.4" diaginertia="1e-4 2e-4 2e-4"/>
      <body name="rod" pos="0.1 0 0" euler="0 65 0">
        <joint name="A" axis="0 1 0"/>
        <inertial pos="0.15 0 0" mass="0.6" diaginertia="1e-4 3e-3 3e-3"/>
      </body>
    </body>
    <body name="ram" pos="RAM">
      <joint name="guide" type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="1.2" diaginertia="1e-3 1e-3 1e-3"/>
    </body>
  </worldbody>
  <equality><connect name="B" body1="rod" body2="ram" anchor="0.3 0 0"/></equality>
  <actuator><motor joint="O"/></actuator>
</mujoco>
"""
PIN = 0.1 * cmath.exp(1j * np.radians(40))
END = PIN + 0.3 * cmath.exp(1j * np.radians(40 - 65))
MJCF = MJCF.replace("RAM", f"{END.real:.17g} 0 {0.3 + END.imag:.17g}")


def test_mjcf_slider_crank(tmp_path: Path) -> None:
    """Positions by MuJoCo's own kinematics: joints set to those of the imported mechanism, gaps and frames compared."""
    path = tmp_path / "model.xml"
    path.write_text(MJCF)
    file, left_out = imported_mechanism(path)
    assert left_out == tuple(f"the sense of {name}: its angle counts against it" for name in "OA")
    assert file.machine.gravity == -9.81j
    assert [entry.name for entry in file.mechanism.inputs] == ["crank"]
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    turned = np.radians(np.linspace(-30, 330, 25))
    motion = solve(file.plan(), turned).require()
    for k, angle in enumerate(turned):
        travel = motion.point("ram", "guide").position[k].real - END.real
        data.qpos[:] = [-angle, -(motion.angle("rod")[k] - angle), travel]
        mujoco.mj_kinematics(model, data)
        for body in ("crank", "rod", "ram"):
            at = data.body(body).xpos
            local = {"crank": "O", "rod": "A", "ram": "B"}[body]
            own = motion.point(body, local).position[k]
            assert abs(own - complex(at[0], at[2])) < 1e-12
        end = data.body("rod").xpos + data.body("rod").xmat.reshape(3, 3) @ np.array([0.3, 0, 0])
        assert np.abs(end - data.body("ram").xpos).max() < 1e-12
        gap = complex(data.body("ram").xipos[0], data.body("ram").xipos[2]) - motion.point("ram", "B").position[k]
        assert abs(gap) < 1e-12


CENTRE = {"inline": True, "type": "Static", "x": 0, "y": 0, "name": "A"}
LINKAGE = {
    "name": "leg",
    "joints": [
        {"type": "Crank", "name": "B", "x": 0.0, "y": 1.0, "joint0": CENTRE, "distance": 1.0, "angle": 0.31},
        {"type": "Revolute", "name": "C", "x": 3.0, "y": 2.0, "joint0": {"ref": "B"}, "joint1": {"ref": "D"},
         "distance0": 3.0, "distance1": 2.0},
        {"type": "Fixed", "name": "P", "joint0": {"ref": "B"}, "joint1": {"ref": "C"}, "distance": 2.5, "angle": 0.6},
        {"type": "Static", "name": "D", "x": 3.5, "y": 0.5},
    ],
}  # fmt: skip


def test_pylinkage_four_bar(tmp_path: Path) -> None:
    """Each joint at its distances from the others, on the side of the file, in mm."""
    path = tmp_path / "leg.json"
    path.write_text(json.dumps(LINKAGE))
    file, left_out = imported_mechanism(path)
    assert left_out == ("angle of each step of crank B: give the speed",)
    for angle in np.linspace(-0.3, 0.3, 9):
        motion = solve(file.plan(), angle).require()
        b = 1e-3j * cmath.exp(1j * angle)  # drawn upright
        c = complex(motion.point("B-C", "C").position[0])
        p = complex(motion.point("B-C", "P").position[0])
        assert abs(c - b) == pytest.approx(3e-3, abs=1e-15)
        assert abs(c - (3.5e-3 + 0.5e-3j)) == pytest.approx(2e-3, abs=1e-15)
        assert p == pytest.approx(b + 2.5e-3 * cmath.exp(0.6j) * (c - b) / abs(c - b), abs=1e-15)
        assert c.imag > b.imag


def test_the_command_writes_a_file_that_is_read_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, target = tmp_path / "arm.urdf", tmp_path / "arm.toml"
    source.write_text(URDF)
    with pytest.raises(SystemExit) as ended:
        main(["import", str(source), str(target)], prog_name="ilmek")
    assert ended.value.code in (0, None)
    assert read_mechanism(target).mechanism == imported_mechanism(source).file.mechanism
    assert "left out: limit of joint shoulder" in capsys.readouterr().err


DAMAGED = {
    "cut off": (URDF[:300], "no XML"),
    "another root": ("<svg/>", "begins with <svg>; URDF, MJCF"),
    "entities": ('<!DOCTYPE a [<!ENTITY b "c">]><robot/>', "document type"),
    "no root": (URDF.replace('<parent link="base"/>', '<parent link="tool"/>'), "hangs on no link"),
    "out of plane": (URDF.replace('<axis xyz="0 -1 0"/>', '<axis xyz="0 0 1"/>'), "out of the plane"),
    "no number": (URDF.replace('value="2"', 'value="two"'), "mass is 'two'"),
    "not finite": (URDF.replace("0.1 0 0.4", "0.1 0 inf"), "a number"),
    "two numbers": (URDF.replace("0.1 0 0.4", "0.1 0"), "has 2 numbers"),
    "floating": (URDF.replace("prismatic", "floating"), "is of type 'floating'"),
    "ball": (MJCF.replace('type="slide"', 'type="ball"'), "is of type 'ball'"),
    "unknown body": (MJCF.replace('body2="ram"', 'body2="anvil"'), "unknown body 'anvil'"),
    "include": (MJCF.replace("<worldbody>", '<include file="x.xml"/><worldbody>'), "<include>"),
    "no world": ("<mujoco/>", "no <worldbody>"),
    "json list": ("[1, 2]", "no list of joints"),
    "no such joint": (json.dumps(LINKAGE).replace('"ref": "D"', '"ref": "E"'), "unknown joint"),
    "type": (json.dumps(LINKAGE).replace("Revolute", "Linear"), "is of type"),
    "no triangle": (json.dumps(LINKAGE).replace('3.0, "distance1"', '30.0, "distance1"'), "form no triangle"),
    "nan": (json.dumps(LINKAGE).replace("2.5", "NaN"), "JSON"),
}


@pytest.mark.parametrize("case", DAMAGED)
def test_damaged_files_are_one_error(case: str, tmp_path: Path) -> None:
    text, message = DAMAGED[case]
    path = tmp_path / "file"
    path.write_text(text)
    with pytest.raises(MechanismError) as error:
        imported_mechanism(path)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("seed", range(300))
def test_mutated_files_are_read_or_refused(seed: int, tmp_path: Path) -> None:
    """Bytes deleted, doubled and exchanged: a mechanism or a MechanismError, nothing else."""
    rng = np.random.default_rng(seed)
    text = (URDF, MJCF, json.dumps(LINKAGE))[seed % 3]
    for _ in range(int(rng.integers(1, 6))):
        start, length = int(rng.integers(len(text))), int(rng.integers(1, 12))
        piece = text[start : start + length]
        text = text[:start] + ("", piece * 2, piece[::-1])[int(rng.integers(3))] + text[start + length :]
    path = tmp_path / "file"
    path.write_text(text)
    with contextlib.suppress(MechanismError):
        imported_mechanism(path)
