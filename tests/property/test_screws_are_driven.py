"""Whether a straight key reaches each screw of the loom: rays about its axis against the meshes of what it joins."""

from collections import defaultdict

import numpy as np
import pytest
from default_machines import default_design

from ilmek.elements.machine_screws import screw_of
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.bolting import bolted
from ilmek.part.contacts import joined_by
from ilmek.part.insertion_units import StandingPart, is_screw, standing_parts
from ilmek.part.part import WELDED
from ilmek.part.poses import chains
from ilmek.part.welds import welded_together

KEY = 0.06
"""Length of a key over the head [m]."""


def hits(start: np.ndarray, towards: np.ndarray, corners: np.ndarray) -> bool:
    """Whether a ray meets a triangle within a key's length (Möller and Trumbore)."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(towards, second)
    det = (first * normal).sum(1)
    crossing = np.abs(det) > 1e-15
    inverse = np.where(crossing, 1.0, 0.0) / np.where(crossing, det, 1.0)
    off = start - corners[:, 0]
    u = inverse * (off * normal).sum(1)
    across = np.cross(off, first)
    v, t = inverse * (across @ towards), inverse * (second * across).sum(1)
    return bool((crossing & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-6) & (t < KEY)).any())


def blocked(screw: StandingPart, piece: StandingPart, corners: np.ndarray) -> bool:
    """Whether a piece is over the head of a screw; corners of its triangles."""
    assert screw.part.purchase is not None
    assert screw.part.shape is not None
    row = screw_of(screw.part.purchase.row)
    assert row is not None
    points = screw.part.shape.mesh().points
    wide = np.hypot(points[:, 0], points[:, 1]) > 0.6 * row.diameter
    top = points[wide, 2].mean() > points[:, 2].mean()
    out, level = (1.0, points[:, 2].max()) if top else (-1.0, points[:, 2].min())
    own, towards = piece.position.inverse, screw.position.rotation[:, 2] * out
    for angle in np.linspace(0, 2 * np.pi, 8, endpoint=False).tolist():
        rim = 0.45 * row.across * np.exp(1j * angle)
        start = screw.position.points(np.array([rim.real, rim.imag, level + out * 1e-4]))
        if hits(own.points(start), own.rotation @ towards, corners):
            return True
    return False


@pytest.mark.one_in(2)
@pytest.mark.parametrize("share", range(8))
def test_a_straight_key_reaches_every_screw(share: int) -> None:
    tree = bolted(loom_tree(default_design("automated-loom")))
    pieces = defaultdict[str, list[StandingPart]](list)
    for links in chains(tree):
        for piece in standing_parts(links):
            pieces[piece.part.id].append(piece)
    screws = [own for every in pieces.values() for own in every[:4] if is_screw(own.part)]
    screws = [own for own in screws if own.part.purchase and screw_of(own.part.purchase.row)]
    joined = joined_by(tree, frozenset(own.part.id for own in screws))
    seen = 0
    for screw in screws[share::8]:
        for name in joined[screw.part.id]:
            mesh = pieces[name][0].part.shape.mesh()  # type: ignore[union-attr]
            for piece in pieces[name]:
                apart = (piece.box[0] > screw.box[1] + 1e-3) | (piece.box[1] < screw.box[0] - 1e-3)
                if not apart.any():
                    seen += 1
                    assert not blocked(screw, piece, mesh.points[mesh.triangles]), (screw.part.id, name)
    assert seen > 10


def test_no_head_is_in_stock_that_is_closed_round_it() -> None:
    """Rays across the axis over a head all meet the wall of one part: a tube that is welded over it."""
    tree = bolted(loom_tree(default_design("automated-loom")))
    pieces = [piece for links in chains(tree) for piece in standing_parts(links)]
    parts = {piece.part.id: piece.part for piece in pieces}
    stock = [piece for piece in pieces if piece.part.process == WELDED]
    boxes = np.array([piece.box for piece in stock])
    for screw in (piece for piece in pieces if is_screw(piece.part)):
        over = screw.position.points(np.array([0.0, 0.0, -8e-3]))  # z is along the screw, from under its head
        near = np.flatnonzero(((boxes[:, 0] < over) & (over < boxes[:, 1])).all(1))
        for piece in (stock[number] for number in near):
            if not any(welded_together(piece.part, parts[name]) for name in screw.part.joins):
                continue
            mesh = piece.part.shape.mesh()  # type: ignore[union-attr]
            own = piece.position.inverse
            across = (
                screw.position.rotation @ np.array([np.cos(angle), np.sin(angle), 0.0])
                for angle in np.linspace(0.1, 2 * np.pi + 0.1, 8, endpoint=False)
            )
            start, corners = own.points(over), mesh.points[mesh.triangles]
            assert not all(hits(start, own.rotation @ ray, corners) for ray in across), (screw.part.id, piece.part.id)
