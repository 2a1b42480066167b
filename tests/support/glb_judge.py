"""A GLB file judged as a machine builder would: what touches nothing, what runs through what, which meshes are open.

Of the project it takes nothing: it reads the meshes, nodes and animations of the file. Instances of one name are not
compared with each other; slivers between the facets of a shaft and its bore are not counted.
"""

import json
import struct
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import fcl
import numpy as np
from manifold3d import Error, Manifold, Mesh
from scipy.spatial.transform import Rotation

TYPES = {5126: "<f4", 5125: "<u4", 5123: "<u2", 5121: "u1"}
COMPONENTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
GAP, VOLUME, DEPTH = 1e-4, 5e-8, 1e-4
"""Distance of what touches [m]; volume in common [m³], and its mean depth [m], of what is through each other."""

Pair = tuple[int, int, bytes]
"""Two meshes, and the second's place as the first sees it: instances of one pair are judged once."""

Channels = dict[tuple[int, str], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Instance:
    """A mesh at a place, by the name of its part."""

    name: str
    mesh: int
    place: np.ndarray


class GlbJudge:
    """The content of a GLB file."""

    def __init__(self, content: bytes) -> None:
        (size,) = struct.unpack_from("<I", content, 12)
        self._document, self._binary = json.loads(content[20 : 20 + size]), content[28 + size :]
        self.meshes = [self._mesh(mesh) for mesh in self._document["meshes"]]
        self._common: dict[Pair, float] = {}

    def _array(self, number: int) -> np.ndarray:
        accessor = self._document["accessors"][number]
        view = self._document["bufferViews"][accessor["bufferView"]]
        wide = COMPONENTS[accessor["type"]]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        values = np.frombuffer(self._binary, TYPES[accessor["componentType"]], accessor["count"] * wide, begin)
        return values.reshape(-1, wide) if wide > 1 else values

    def _mesh(self, mesh: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
        """Corners, equal ones once, and triangles."""
        (primitive,) = mesh["primitives"]
        points = self._array(primitive["attributes"]["POSITION"]).astype(float)
        corners, number = np.unique(points.round(9), axis=0, return_inverse=True)
        return corners, number.reshape(-1)[self._array(primitive["indices"]).astype(int)].reshape(-1, 3)

    @cached_property
    def _solids(self) -> list[Manifold]:
        meshes = (Mesh(np.float32(corners), np.uint32(faces)) for corners, faces in self.meshes)
        return [Manifold(mesh) for mesh in meshes]

    @cached_property
    def animations(self) -> dict[str, Channels]:
        """Channels of each animation: times and values by node and path."""
        return {
            animation["name"]: {
                (channel["target"]["node"], channel["target"]["path"]): (
                    self._array(animation["samplers"][channel["sampler"]]["input"]),
                    self._array(animation["samplers"][channel["sampler"]]["output"]),
                )
                for channel in animation["channels"]
            }
            for animation in self._document.get("animations", ())
        }

    def instances(self, motion: str = "", share: float = 0.0) -> list[Instance]:
        """All meshes where they are at a share of an animation, the others at their beginning."""
        pose = {
            key: _between(times, values, share if name == motion else 0.0)
            for name, channels in self.animations.items()
            for key, (times, values) in channels.items()
        }
        roots = self._document["scenes"][0]["nodes"]
        return [instance for root in roots for instance in self._placed(root, np.eye(4), pose)]

    def _placed(self, number: int, parent: np.ndarray, pose: dict[tuple[int, str], np.ndarray]) -> Iterator[Instance]:
        node, place = self._document["nodes"][number], np.eye(4)
        turned = pose.get((number, "rotation"), node.get("rotation", (0, 0, 0, 1)))
        place[:3, :3] = Rotation.from_quat(turned).as_matrix()
        place[:3, 3] = pose.get((number, "translation"), node.get("translation", (0, 0, 0)))
        place = parent @ place
        if "mesh" in node:
            yield Instance(node.get("extras", {}).get("part", node["name"]), node["mesh"], place)
        for child in node.get("children", ()):
            yield from self._placed(child, place, pose)

    def groups(self) -> list[Counter[str]]:
        """What touches, in the pose at the beginning; the largest group first."""
        instances, models = self.instances(), {}
        for instance in instances:
            if instance.mesh not in models:
                corners, faces = self.meshes[instance.mesh]
                models[instance.mesh] = fcl.BVHModel()
                models[instance.mesh].beginModel(len(corners), len(faces))
                models[instance.mesh].addSubModel(corners, faces)
                models[instance.mesh].endModel()
        bodies = [fcl.CollisionObject(models[one.mesh], fcl.Transform(*_parted(one.place))) for one in instances]
        labels, touch = np.arange(len(bodies)), dict[Pair, bool]()
        for first, other in self._near(instances, GAP):
            if labels[first] != labels[other]:
                if (pair := _pair(instances[first], instances[other])[0]) not in touch:
                    touch[pair] = fcl.distance(bodies[first], bodies[other]) <= GAP
                if touch[pair]:
                    labels[labels == labels[other]] = labels[first]
        found = [Counter(instances[k].name for k in np.flatnonzero(labels == group)) for group in np.unique(labels)]
        return sorted(found, key=lambda group: -group.total())

    def overlaps(self, motion: str = "", share: float = 0.0) -> dict[tuple[str, str], float]:
        """Volume that two names have in common, the largest of their instances [m³]."""
        instances, volumes = self.instances(motion, share), dict[tuple[str, str], float]()
        for first, other in self._near(instances, -1e-6):
            one, its = instances[first], instances[other]
            if one.name == its.name:
                continue
            if (volume := self._in_common(one, its)) > 0.0:
                low, high = sorted((one.name, its.name))
                volumes[low, high] = max(volumes.get((low, high), 0.0), volume)
        return volumes

    def _in_common(self, one: Instance, its: Instance) -> float:
        """Volume of two instances through each other, else 0 [m³]; once for each pair."""
        pair, relative = _pair(one, its)
        if pair not in self._common:
            common = self._solids[one.mesh] ^ self._solids[its.mesh].transform(relative)
            volume = abs(common.volume())
            deep = volume > VOLUME and 2 * volume > DEPTH * common.surface_area()
            self._common[pair] = volume if deep else 0.0
        return self._common[pair]

    def open_meshes(self) -> set[str]:
        """Names of what encloses no volume."""
        is_open = [solid.status() != Error.NoError or solid.is_empty() for solid in self._solids]
        return {instance.name for instance in self.instances() if is_open[instance.mesh]}

    def _near(self, instances: list[Instance], gap: float) -> Iterator[tuple[int, int]]:
        """Numbers of two instances whose boxes are within a gap."""
        corners = [self.meshes[one.mesh][0] @ one.place[:3, :3].T + one.place[:3, 3] for one in instances]
        low, high = (np.array([limit(points, axis=0) for points in corners]) for limit in (np.min, np.max))
        for first in range(1, len(instances)):
            near = (low[:first] <= high[first] + gap) & (high[:first] >= low[first] - gap)
            yield from ((first, other) for other in np.flatnonzero(near.all(axis=1)).tolist())


def _pair(one: Instance, its: Instance) -> tuple[Pair, np.ndarray]:
    relative = np.linalg.solve(one.place, its.place)[:3]
    return (one.mesh, its.mesh, (relative.round(9) + 0.0).tobytes()), relative


def _parted(place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return place[:3, :3], place[:3, 3]


def _between(times: np.ndarray, values: np.ndarray, share: float) -> np.ndarray:
    """The value at a share of the times, linear between its samples; of quaternions the shorter way."""
    time = share * float(times[-1])
    after = min(max(int(np.searchsorted(times, time, side="right")), 1), len(times) - 1)
    weight = np.clip((time - times[after - 1]) / max(times[after] - times[after - 1], 1e-12), 0, 1)
    first, second = values[after - 1].astype(float), values[after].astype(float)
    if len(first) == 4 and first @ second < 0:
        second = -second
    mixed = first * (1 - weight) + second * weight
    return np.asarray(mixed / np.linalg.norm(mixed) if len(first) == 4 else mixed)
