"""A scene as GLB: glTF 2.0 in one binary file, with its motions as animations, of a loom `row` and `knot`, in
seconds.

A frame is a node for each of its places in each of its parents, a part a node with a mesh; the same mesh is stored
once. A frame that moves has channels of translation and rotation, linear between its samples.
[Khronos, glTF 2.0 Specification, 3 and 4]
"""

import json
import math
import struct
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.io.colours import colour
from ilmek.report import Json
from ilmek.report.scene import Assembly, Scene, SceneFrame, SceneMotion, ScenePart
from ilmek.units import turn

MAGIC, VERSION, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
_FLOAT, _UNSIGNED = 5126, 5125
_VERTICES, _INDICES = 34962, 34963

_LEAST_ROTATION = math.pi / 2
"""Rotation between two samples above which others are put between: quaternions take the shorter arc."""


@dataclass(slots=True)
class _File:
    """The parts of a file while it is made."""

    nodes: list[dict[str, Json]] = field(default_factory=list)
    meshes: list[dict[str, Json]] = field(default_factory=list)
    materials: list[dict[str, Json]] = field(default_factory=list)
    accessors: list[dict[str, Json]] = field(default_factory=list)
    views: list[dict[str, Json]] = field(default_factory=list)
    data: bytearray = field(default_factory=bytearray)
    material_numbers: dict[tuple[str, bool], int] = field(default_factory=dict)

    def store(self, values: np.ndarray, kind: str, *, target: int | None = None, bounds: bool = False) -> int:
        """The number of the accessor of an array, (elements,) or (elements, components)."""
        array = np.ascontiguousarray(values, "<u4" if values.dtype.kind in "ui" else "<f4")
        view: dict[str, Json] = {"buffer": 0, "byteOffset": len(self.data), "byteLength": array.nbytes}
        if target is not None:
            view["target"] = target
        self.data += array.tobytes()
        self.views.append(view)
        accessor: dict[str, Json] = {
            "bufferView": len(self.views) - 1,
            "componentType": _UNSIGNED if array.dtype.kind == "u" else _FLOAT,
            "count": len(array),
            "type": kind,
        }
        if bounds:
            rows = array.reshape(len(array), -1)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def node(self, **keys: Json) -> int:
        """The number of a new node."""
        self.nodes.append({name: value for name, value in keys.items() if value is not None})
        return len(self.nodes) - 1


def glb_bytes(scene: Scene | Assembly) -> bytes:
    """The scene as the bytes of a GLB file."""
    made = _File()
    carried, parts = defaultdict(list), defaultdict(list)
    for frame in scene.frames:
        carried[frame.parent].append(frame)
    for part in scene.parts:
        parts[part.frame].append((part, _mesh(made, part)))
    moved: dict[str, list[int]] = defaultdict(list)

    def placed(frame: SceneFrame) -> Iterator[int]:
        for index, origin in enumerate(frame.origins):
            children = [one for child in carried[frame.name] for one in placed(child)]
            children += [
                made.node(name=part.title, mesh=mesh, extras=_extras(part)) for part, mesh in parts[frame.name]
            ]
            phase, moved_by = 0.0 if frame.phases is None else float(frame.phases[index]), np.zeros(3)
            if frame.motion is not None:
                # At rest a motion stands at the zero of its cyclogram.
                phase, moved_by = phase + float(frame.motion.rotation[0]), frame.motion.shift[0]
            number = made.node(
                name=frame.name,
                translation=(origin + moved_by).tolist(),
                rotation=_quaternions(frame.axis, np.array([phase]))[0].tolist() if phase else None,
                children=children or None,
            )
            if frame.motion is not None:
                moved[frame.name].append(number)
            yield number

    roots = [number for frame in carried[""] for number in placed(frame)]
    animations = _animations(made, scene, moved)
    return _joined(made, scene.title, roots, animations)


def _mesh(made: _File, part: ScenePart) -> int:
    solid = part.solids[0]
    made.meshes.append(
        {
            "name": part.name,
            "primitives": [
                {
                    "attributes": {"POSITION": made.store(solid.points, "VEC3", target=_VERTICES, bounds=True)},
                    "indices": made.store(solid.triangles.ravel().astype(np.uint32), "SCALAR", target=_INDICES),
                    "material": _material(made, part),
                }
            ],
        }
    )
    return len(made.meshes) - 1


def _material(made: _File, part: ScenePart) -> int:
    key = ("envelope" if part.envelope else part.material, part.envelope)
    if key not in made.material_numbers:
        metal = 0.0 if part.envelope or part.material == "beech" else 0.4
        look: dict[str, Json] = {
            "name": key[0] or "material not stated",
            "pbrMetallicRoughness": {
                "baseColorFactor": list(colour(part.material, envelope=part.envelope)),
                "metallicFactor": metal,
                "roughnessFactor": 0.6,
            },
        }
        made.materials.append(look | ({"alphaMode": "BLEND"} if part.envelope else {}))
        made.material_numbers[key] = len(made.materials) - 1
    return made.material_numbers[key]


def _extras(part: ScenePart) -> dict[str, Json]:
    found: dict[str, Json] = {"part": part.name, "machine": part.machine, "material": part.material}
    found |= {"number": part.number, "envelope": part.envelope}
    if not math.isnan(part.mass):
        found["mass"] = part.mass
    return found | ({"plate": part.plate} if part.plate else {})


def _animations(made: _File, scene: Scene | Assembly, moved: dict[str, list[int]]) -> list[dict[str, Json]]:
    """An animation for each drive, in seconds of its period."""
    animations: list[dict[str, Json]] = []
    for drive, period in scene.periods.items():
        samplers: list[dict[str, Json]] = []
        channels: list[dict[str, Json]] = []
        for frame in scene.frames:
            if frame.motion is None or frame.motion.drive != drive:
                continue
            motion = _with_small_steps(frame.motion)
            times = made.store(motion.angle / turn * period, "SCALAR", bounds=True)
            for index, number in enumerate(moved[frame.name]):
                _channels(made, frame, motion, (index % len(frame.origins), number, times), samplers, channels)
        if channels:
            animations.append({"name": drive, "samplers": samplers, "channels": channels})
    return animations


def _channels(  # noqa: PLR0917
    made: _File,
    frame: SceneFrame,
    motion: SceneMotion,
    node: tuple[int, int, int],
    samplers: list[dict[str, Json]],
    channels: list[dict[str, Json]],
) -> None:
    """The channels of a node: number of its place, its own, and that of the times."""
    index, number, times = node
    phase = 0.0 if frame.phases is None else float(frame.phases[index])
    outputs = {}
    if motion.shift.any():
        outputs["translation"] = made.store(frame.origins[index] + motion.shift, "VEC3")
    if motion.rotation.any():
        outputs["rotation"] = made.store(_quaternions(frame.axis, phase + motion.rotation), "VEC4")
    for path, output in outputs.items():
        samplers.append({"input": times, "output": output, "interpolation": "LINEAR"})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": number, "path": path}})


def _with_small_steps(motion: SceneMotion) -> SceneMotion:
    """The motion with samples so near that none turns by more than a quarter."""
    steps = np.maximum(1, np.ceil(np.abs(np.diff(motion.rotation)) / _LEAST_ROTATION)).astype(int)
    parts = [np.arange(count) / count for count in steps]
    number = np.concatenate([*(index + part for index, part in enumerate(parts)), [len(steps)]])
    index = np.arange(len(motion.angle))
    shift = np.stack([np.interp(number, index, column) for column in motion.shift.T], axis=1)
    return SceneMotion(
        motion.drive, np.interp(number, index, motion.angle), shift, np.interp(number, index, motion.rotation)
    )


def _quaternions(axis: tuple[float, float, float], rotation: FloatArray) -> FloatArray:
    """Rotations about an axis as quaternions (x, y, z, w)."""
    half = np.asarray(rotation) / 2
    return np.column_stack([np.sin(half)[:, None] * np.array(axis), np.cos(half)])


def _joined(made: _File, title: str, roots: list[int], animations: list[dict[str, Json]]) -> bytes:
    made.data += bytes(-len(made.data) % 4)
    content = {
        "asset": {"version": "2.0", "generator": "ilmek"},
        "scene": 0,
        "scenes": [{"name": title, "nodes": roots}],
        "nodes": made.nodes,
        "meshes": made.meshes,
        "materials": made.materials,
        "accessors": made.accessors,
        "bufferViews": made.views,
        "buffers": [{"byteLength": len(made.data)}],
        **({"animations": animations} if animations else {}),
    }
    text = json.dumps(content, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text
    chunks += struct.pack("<II", len(made.data), BINARY_CHUNK) + bytes(made.data)
    return struct.pack("<III", MAGIC, VERSION, 12 + len(chunks)) + chunks
