"""GLB files, read back by a reader of their own: chunks, accessors, nodes, animations."""

import json
import struct
from functools import cache
from typing import Any

import numpy as np
import pytest
from default_machines import SETTLED, loom_report

from ilmek.io.glb import glb_bytes
from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.in_space.scene import scene
from ilmek.plane.solids import bounds
from ilmek.report.scene import Scene
from ilmek.units import turn

COMPONENTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


@cache
def _scene() -> Scene:
    loom = MACHINE.designed(MACHINE.params.read({**SETTLED, "width": "0.3 m", "length": "0.4 m"}))
    return scene(loom, loom_report(loom))


@cache
def _read() -> tuple[dict[str, Any], bytes]:
    """The JSON and the binary chunk of the file, its header and its chunks checked [glTF 2.0, 4.4]."""
    content = glb_bytes(_scene())
    magic, version, length = struct.unpack_from("<4sII", content)
    assert (magic, version, length) == (b"glTF", 2, len(content))
    size, kind = struct.unpack_from("<I4s", content, 12)
    assert (kind, size % 4) == (b"JSON", 0)
    binary_size, binary_kind = struct.unpack_from("<I4s", content, 20 + size)
    assert (binary_kind, binary_size % 4) == (b"BIN\0", 0)
    binary = content[28 + size :]
    assert len(binary) == binary_size
    found = json.loads(content[20 : 20 + size])
    assert found["buffers"][0]["byteLength"] == binary_size
    return found, binary


def _values(number: int) -> np.ndarray:
    found, binary = _read()
    accessor = found["accessors"][number]
    view = found["bufferViews"][accessor["bufferView"]]
    kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
    width = COMPONENTS[accessor["type"]]
    values = np.frombuffer(binary, kind, accessor["count"] * width, view["byteOffset"])
    assert view["byteOffset"] % 4 == 0
    assert values.nbytes == view["byteLength"]
    return values.reshape(-1, width)


def test_every_node_has_one_parent_or_is_a_root() -> None:
    found, _ = _read()
    children = [one for node in found["nodes"] for one in node.get("children", ())]
    roots = found["scenes"][0]["nodes"]
    assert sorted([*children, *roots]) == list(range(len(found["nodes"])))
    cams = [node for node in found["nodes"] if node.get("extras", {}).get("part") == "shedding/shedding-cam"]
    assert len(cams) == sum(sheet.across.size for sheet in _scene().warps)
    assert len({node["mesh"] for node in cams}) == 1


def test_meshes_are_the_solids_of_the_scene() -> None:
    found, _ = _read()
    parts = {part.name: part for part in _scene().parts}
    assert {mesh["name"] for mesh in found["meshes"]} == set(parts)
    for mesh in found["meshes"]:
        (primitive,) = mesh["primitives"]
        solid = parts[mesh["name"]].solids[0]
        accessor = found["accessors"][primitive["attributes"]["POSITION"]]
        points, indices = _values(primitive["attributes"]["POSITION"]), _values(primitive["indices"])
        assert np.array_equal(indices.reshape(-1, 3), solid.triangles)
        assert np.allclose(points, solid.points, atol=1e-6)
        low, high = bounds(solid)
        assert np.allclose([accessor["min"], accessor["max"]], [low, high], atol=1e-6)
        assert 0 <= primitive["material"] < len(found["materials"])


@pytest.mark.parametrize("drive", ["row", "knot"])
def test_animations_are_the_motions_of_the_frames(drive: str) -> None:
    found, _ = _read()
    made = _scene()
    (animation,) = (one for one in found["animations"] if one["name"] == drive)
    frames = {frame.name: frame for frame in made.frames}
    moved = set()
    for channel in animation["channels"]:
        node = found["nodes"][channel["target"]["node"]]
        frame, sampler = frames[node["name"]], animation["samplers"][channel["sampler"]]
        assert frame.motion is not None
        assert frame.motion.drive == drive
        moved.add(frame.name)
        times, values = _values(sampler["input"]).ravel(), _values(sampler["output"])
        assert times[-1] == pytest.approx(made.periods[drive], rel=1e-6)
        at = times / made.periods[drive] * turn
        if channel["target"]["path"] == "translation":
            shift = np.stack([np.interp(at, frame.motion.angle, one) for one in frame.motion.shift.T], axis=1)
            error = np.abs(values - shift - node["translation"])
            assert np.median(error) < 1e-6
            assert len(values) == len(times)
        else:
            assert np.allclose(np.linalg.norm(values, axis=1), 1.0, atol=1e-6)
            steps = np.sum(values[1:] * values[:-1], axis=1)
            assert (np.abs(steps) > np.cos(turn / 8) - 1e-6).all()
    expected = {frame.name for frame in made.frames if frame.motion is not None and frame.motion.drive == drive}
    assert moved == expected
