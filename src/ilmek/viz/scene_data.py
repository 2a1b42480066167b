"""A scene as data for a page: its description as JSON, its numbers in one block of floats and one of integers."""

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field

import numpy as np

from ilmek.arrays import FloatArray, Int32, IntArray
from ilmek.records import JsonObject
from ilmek.report import Json
from ilmek.report.scene import Scene, SceneBody, SceneFrame, SceneMotion, ScenePart, SceneYarn, Solid
from ilmek.viz.thinning import divided

SHIFT_ERROR, TURN_ERROR = 2e-5, 2e-4
"""Deviations of the samples that are sent from those of a motion, at most [m, rad]."""


@dataclass(eq=False, frozen=True, slots=True)
class SceneData:
    """A scene: JSON, 32-bit floats, and 32-bit integers; a part of a block is [first, number]."""

    about: JsonObject
    floats: bytes
    integers: bytes


@dataclass(eq=False, slots=True)
class _Blocks:
    floats: list[FloatArray] = field(default_factory=list)
    integers: list[IntArray] = field(default_factory=list)
    _counts: list[int] = field(default_factory=lambda: [0, 0])

    def put(self, values: FloatArray) -> list[int]:
        """Where the values stand among the floats."""
        flat = np.asarray(values, float).ravel()
        self.floats.append(flat)
        self._counts[0] += len(flat)
        return [self._counts[0] - len(flat), len(flat)]

    def put_integers(self, values: IntArray) -> list[int]:
        """Where the values stand among the integers."""
        flat = np.asarray(values).ravel()
        self.integers.append(flat)
        self._counts[1] += len(flat)
        return [self._counts[1] - len(flat), len(flat)]


def scene_data(scene: Scene) -> SceneData:
    """The scene as a page reads it."""
    blocks = _Blocks()
    warps, carpet = scene.warps, scene.carpet
    about = {
        "title": scene.title,
        "heads": scene.heads,
        "tools": dict(scene.tools),
        "dyed": list(scene.dyed),
        "phases": [asdict(one) for one in scene.phases],
        "guards": list(scene.guards),
        "floor": scene.floor,
        "bodies": {name: _body(body) for name, body in scene.bodies.items()},
        **judgement(scene),
        "periods": dict(scene.periods),
        "frames": [_frame(blocks, one) for one in scene.frames],
        "parts": [_part(blocks, one) for one in scene.parts],
        "warps": {
            "x": blocks.put(warps.x),
            "shaft": blocks.put_integers(warps.shaft),
            "odd": blocks.put_integers(warps.odd),
            "line": blocks.put(warps.line),
            "lifted": list(warps.lifted),
            "lifts": list(warps.lifts),
            "angle": blocks.put(warps.angle),
            "even": blocks.put(warps.even_share),
            "oddShare": blocks.put(warps.odd_share),
            "diameter": warps.diameter,
        },
        "yarns": [_yarn(blocks, one) for one in scene.yarns],
        "carpet": {
            "width": carpet.width,
            "columns": carpet.columns,
            "rows": carpet.rows,
            "columnPitch": carpet.column_pitch,
            "rowPitch": carpet.row_pitch,
            "pile": carpet.pile,
            "line": blocks.put(carpet.line),
        },
    }
    return SceneData(about, _bytes(blocks.floats, "<f4"), _bytes(blocks.integers, "<u4"))


def judgement(scene: Scene) -> JsonObject:
    """What is found of a loom: the checks that fail, and the pairs of parts that come nearest; null: not compared."""
    failures = [check.as_json() for check in scene.failures]
    return {"failures": failures, "nearest": scene.nearest}


def checks_of_parts(scene: Scene) -> JsonObject:
    """The checks of each part that has some, by its name."""
    return {part.name: [check.as_json() for check in part.checks] for part in scene.parts if part.checks}


def _bytes(values: Iterable[FloatArray | IntArray], kind: str) -> bytes:
    return np.concatenate([np.zeros(0), *values]).astype(kind).tobytes()


def _body(one: SceneBody) -> JsonObject:
    return {
        "parent": one.parent,
        "joint": one.joint,
        "drive": one.drive,
        "motor": one.motor,
        "follows": list(one.follows),
        "passive": one.passive,
    }


def _frame(blocks: _Blocks, one: SceneFrame) -> dict[str, Json]:
    return {
        "name": one.name,
        "parent": one.parent,
        "origins": blocks.put(one.origins),
        "phases": None if one.phases is None else blocks.put(one.phases),
        "axis": list(one.axis),
        "motion": None if one.motion is None else _motion(blocks, one.motion),
    }


def _motion(blocks: _Blocks, one: SceneMotion) -> dict[str, Json]:
    kept = needed_samples(one)
    return {
        "drive": one.drive,
        "angle": blocks.put(one.angle[kept]),
        "shift": blocks.put(one.shift[kept]) if one.shift.any() else None,
        "rotation": blocks.put(one.rotation[kept]) if one.rotation.any() else None,
    }


def needed_samples(one: SceneMotion) -> Int32[np.ndarray, " kept"]:
    """The samples of a motion between which straight lines stay within the errors allowed.

    [Douglas and Peucker 1973, deviations at equal angles]
    """
    values = np.column_stack([one.shift / SHIFT_ERROR, one.rotation / TURN_ERROR])

    def away(number: IntArray, begin: IntArray, end: IntArray) -> FloatArray:
        long = one.angle[end] - one.angle[begin]
        share = (one.angle[number] - one.angle[begin]) / np.where(long > 0, long, 1.0)
        straight = values[begin] + share[:, None] * (values[end] - values[begin])
        return np.asarray(np.abs(values[number] - straight).max(axis=1))

    ends = np.isin(np.arange(len(one.angle)), [0, len(one.angle) - 1])
    return np.flatnonzero(divided(ends, away, 1.0)).astype(np.int32)


def _part(blocks: _Blocks, one: ScenePart) -> dict[str, Json]:
    return {
        "name": one.name,
        "title": one.title,
        "machine": one.machine,
        "frame": one.frame,
        "solids": [
            _solid(blocks, solid, deviation) for solid, deviation in zip(one.solids, one.deviations, strict=True)
        ],
        "material": one.material,
        "mass": None if math.isnan(one.mass) else one.mass,
        "number": one.number,
        "checks": [check.as_json() for check in one.checks],
        "plate": one.plate,
        "envelope": one.envelope,
        "extents": one.extents.tolist(),
        "ids": list(one.ids),
    }


def _solid(blocks: _Blocks, one: Solid, deviation: float) -> dict[str, Json]:
    return {"points": blocks.put(one.points), "triangles": blocks.put_integers(one.triangles), "deviation": deviation}


def _yarn(blocks: _Blocks, one: SceneYarn) -> JsonObject:
    return {
        "name": one.name,
        "title": one.title,
        "frame": one.frame,
        "drive": one.drive,
        "angle": blocks.put(one.angle),
        "points": blocks.put(one.points),
        "number": int(one.points.shape[1]),
        "diameter": one.diameter,
    }
