"""A scene as data for a page: its description as JSON, its numbers in one block of floats and one of integers."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray, Int32, IntArray
from ilmek.records import JsonObject
from ilmek.report import Check, plain
from ilmek.report.scene import Scene, SceneMotion, ScenePart, SceneYarn
from ilmek.viz.thinning import divided

FLOATS, INTEGERS = "<f4", "<u4"
"""Types of the two blocks."""

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
    """The arrays of a scene in two blocks, floats and integers, one after the other."""

    blocks: dict[str, list[FloatArray | IntArray]] = field(default_factory=lambda: {FLOATS: [], INTEGERS: []})
    counts: dict[str, int] = field(default_factory=lambda: {FLOATS: 0, INTEGERS: 0})

    def put(self, values: FloatArray | IntArray) -> list[int]:
        """Where the values stand in their block: first, number."""
        kind = FLOATS if np.issubdtype(values.dtype, np.floating) else INTEGERS
        self.blocks[kind].append(values.ravel())
        self.counts[kind] += values.size
        return [self.counts[kind] - values.size, values.size]

    def data(self, value: object) -> Any:
        """The value for JSON: a record by the names of its fields, an array as its position in a block."""
        if isinstance(value, np.ndarray):
            return self.put(value)
        if isinstance(value, Check):
            return value.as_json()
        if isinstance(value, SceneMotion):
            return self._motion(value)
        if is_dataclass(value):
            about = {_camel(own.name): self.data(getattr(value, own.name)) for own in fields(value)}
            return about | _more(value, about)
        if isinstance(value, Mapping):
            return {name: self.data(item) for name, item in value.items()}
        return [self.data(item) for item in value] if isinstance(value, tuple) else plain(value)

    def _motion(self, one: SceneMotion) -> JsonObject:
        """The samples that are needed; null for what stands."""
        kept = needed_samples(one)
        shift, rotation = (self.put(values[kept]) if values.any() else None for values in (one.shift, one.rotation))
        return {"drive": one.drive, "angle": self.put(one.angle[kept]), "shift": shift, "rotation": rotation}


def _camel(name: str) -> str:
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


def _more(value: object, about: JsonObject) -> JsonObject:
    """What a page reads of a part and a yarn in place of their fields, or beside them."""
    if isinstance(value, ScenePart):
        del about["copies"]
        pairs = zip(about.pop("solids"), about.pop("deviations"), strict=True)
        solids = [{**solid, "deviation": deviation} for solid, deviation in pairs]
        return {"extents": value.extents.tolist(), "solids": solids}
    return {"number": value.points.shape[1]} if isinstance(value, SceneYarn) else {}


def scene_data(scene: Scene) -> SceneData:
    """The scene as a page reads it."""
    blocks = _Blocks()
    about = blocks.data(scene)
    floats, integers = (
        np.concatenate([np.zeros(0), *blocks.blocks[kind]]).astype(kind).tobytes() for kind in (FLOATS, INTEGERS)
    )
    return SceneData(about, floats, integers)


def judgement(scene: Scene) -> JsonObject:
    """What is found of a loom: the checks that fail, and the pairs of parts that come nearest; null: not compared."""
    failures = [check.as_json() for check in scene.failures]
    return {"failures": failures, "nearest": scene.nearest}


def checks_of_parts(scene: Scene) -> JsonObject:
    """The checks of each part that has some, by its name."""
    return {part.name: [check.as_json() for check in part.checks] for part in scene.parts if part.checks}


def needed_samples(motion: SceneMotion) -> Int32[np.ndarray, " kept"]:
    """The samples of a motion between which straight lines stay within the errors allowed.

    [Douglas and Peucker 1973, deviations at equal angles]
    """
    values = np.column_stack([motion.shift / SHIFT_ERROR, motion.rotation / TURN_ERROR])

    def away(number: IntArray, begin: IntArray, end: IntArray) -> FloatArray:
        long = motion.angle[end] - motion.angle[begin]
        share = (motion.angle[number] - motion.angle[begin]) / np.where(long > 0, long, 1.0)
        straight = values[begin] + share[:, None] * (values[end] - values[begin])
        return np.asarray(np.abs(values[number] - straight).max(axis=1))

    ends = np.isin(np.arange(len(motion.angle)), [0, len(motion.angle) - 1])
    return np.flatnonzero(divided(ends, away, 1.0)).astype(np.int32)
