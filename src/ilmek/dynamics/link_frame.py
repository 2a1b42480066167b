"""The frame of straight beams that stands for a link: its nodes, the shortest tree through them, its masses."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.dynamics.inertia import Inertia
from ilmek.plane.vectors import dot
from ilmek.records import record

SAME = 1e-9
"""Distance of two points, over the size of the body, below which they are one."""

Tree: TypeAlias = tuple[tuple[int, int], ...]


@record
class LinkFrame:
    """Nodes and edges of a link's frame.

    names, nodes  of the nodes, their positions in the body's frame [m]      tree  edges: pairs of nodes
    beyond     for each edge the edges on the side of its second node      joints  names of the nodes with a joint
    masses     at the nodes [kg]                                           line_mass  of the edges [kg/m]
    """

    names: tuple[str, ...]
    nodes: tuple[complex, ...]
    tree: Tree
    beyond: tuple[frozenset[int], ...]
    joints: frozenset[str]
    masses: tuple[float, ...] = ()
    line_mass: float = 0.0

    def ends(self, edge: int) -> tuple[complex, complex]:
        """Positions of an edge's two nodes [m]."""
        start, end = self.tree[edge]
        return self.nodes[start], self.nodes[end]

    def nearest(self, at: ComplexArray) -> tuple[IntArray, FloatArray]:
        """Edge nearest to each position [m], and the position along it [m]."""
        away, along = [], []
        for edge in range(len(self.tree)):
            start, end = self.ends(edge)
            length = abs(end - start)
            direction = (end - start) / length
            position = np.clip(dot(direction, at - start), 0.0, length)
            along.append(position)
            away.append(np.abs(start + direction * position - at))
        chosen = np.argmin(away, axis=0)
        return chosen, np.take_along_axis(np.asarray(along), chosen[None], axis=0)[0]


def frame_through(nodes: Mapping[str, complex], joints: frozenset[str]) -> LinkFrame:
    """The frame through named nodes [m], no two at one point; joints: names of the nodes with a joint."""
    positions = tuple(nodes.values())
    tree = _shortest_tree(positions)
    return LinkFrame(tuple(nodes), positions, tree, tuple(_beyond(tree, edge) for edge in range(len(tree))), joints)


def with_masses(frame: LinkFrame, inertia: Inertia, line_mass: float) -> LinkFrame:
    """The frame with its line mass, and the rest of the mass at the ends of the edge nearest the rest's centre."""
    lengths = [abs(end - start) for start, end in map(frame.ends, range(len(frame.tree)))]
    total = sum(lengths)
    line_mass = min(line_mass, inertia.mass / total) if total else 0.0
    rest = inertia.mass - line_mass * total
    masses = [0.0] * len(frame.nodes)
    if frame.tree and rest > SAME * inertia.mass:
        moment = inertia.mass * inertia.centre
        for edge, length in enumerate(lengths):
            moment -= line_mass * length * sum(frame.ends(edge)) / 2
        edge, at = (one.item() for one in frame.nearest(np.array([moment / rest])))
        start, end = frame.tree[int(edge)]
        share = at / lengths[int(edge)]
        masses[start] += rest * (1 - share)
        masses[end] += rest * share
    return replace(frame, masses=tuple(masses), line_mass=line_mass)


def _shortest_tree(nodes: Sequence[complex]) -> Tree:
    """The shortest tree through all nodes, edge by edge from the first node [Prim]."""
    reached, edges = [0], []
    while nodes and len(reached) < len(nodes):
        _, start, end = min(
            (abs(nodes[one] - nodes[other]), one, other)
            for one in reached
            for other in range(len(nodes))
            if other not in reached
        )
        edges.append((start, end))
        reached.append(end)
    return tuple(edges)


def _beyond(tree: Tree, edge: int) -> frozenset[int]:
    """Edges on the side of an edge's second node; every edge leads away from the first node."""
    found, nodes = set(), {tree[edge][1]}
    for other in range(edge + 1, len(tree)):
        if tree[other][0] in nodes:
            found.add(other)
            nodes.add(tree[other][1])
    return frozenset(found)
