"""What holds for a made part as a whole: material, hardening, general tolerances, edges, surface without a feature."""

import numpy as np

from ilmek.elements.materials import Hardening
from ilmek.part.blanks import sold_as
from ilmek.part.forms import form_of, members_of
from ilmek.part.part import Part
from ilmek.records import record
from ilmek.units import mm, um

AS_DELIVERED = frozenset({"welded frame", "steel tube", "steel bar", "carbon tube", "laser-cut part"})
"""Processes that leave the surface of stock, or of a laser's cut."""

WELDMENT = "ISO 13920-AF"
"""General tolerances of what is welded: its seats are machined after."""

_MACHINED = 3.2 * um
"""Ra of machined surfaces without a function [m]; assumed by this project."""

_SHARE, _DEPTHS = 1 / 8, (0.3 * mm, 1.5 * mm)
"""Hardened depth over the least dimension of a part, and its bounds [m]: a tough core is left; assumed."""

_STEP = 0.1 * mm

YARN_ROUGH = 0.4 * um
"""Ra of edges on which yarns run [m]; assumed by this project, as makers of yarn guides polish them."""

_ROUNDED, _LEFT, _FINE = 0.5 * mm, 0.3, 0.05 * mm
"""Radius of such an edge, its most over the least side of the part, and its step [m]; assumed by this project."""


@record
class PartSpecification:
    """What a drawing states once.

    designation  of the material      hardening  of its surface; None: as delivered
    depth      least hardened depth [m], which may be exceeded by half; 0: through, or not hardened
    general    tolerances of dimensions without one: ISO 2768-mK, of weldments ISO 13920-AF
    roughness  Ra of all other surfaces [m]: ISO 21920; None: not machined, as cut or delivered
    outer_edge, inner_edge   ISO 13715: undercut below 0, burr or passing above 0 [m]
    yarn_edge  least radius of the edges on which yarns run [m], polished to `YARN_ROUGH`; 0: none do
    """

    designation: str
    hardening: Hardening | None
    depth: float
    general: str
    roughness: float | None
    outer_edge: float = -0.3 * mm
    inner_edge: float = 0.3 * mm
    yarn_edge: float = 0.0


def specification(part: Part) -> PartSpecification:
    """The specification of a made part.

    >>> from ilmek.elements.materials import find_material
    >>> from ilmek.part.shapes import bar
    >>> pin = Part("pin", "pin", "pin or bush", bar(0.008, 0.1), find_material("induction-hardened steel"))
    >>> specification(pin).designation, round(specification(pin).depth, 6)
    ('C45+QT EN 10083-2', 0.001)
    """
    assert part.material is not None
    hardening = part.material.treatment
    return PartSpecification(
        sold_as(part),
        hardening,
        _depth(part) if hardening is not None and hardening.kind else 0.0,
        WELDMENT if part.process == "welded frame" else "ISO 2768-mK",
        None if part.process in AS_DELIVERED else _MACHINED,
        yarn_edge=_yarn_edge(part) if part.yarns else 0.0,
    )


def _yarn_edge(part: Part) -> float:
    """Least radius of the edges on which yarns run [m]: of thin parts less, so that a face is left."""
    assert part.shape is not None
    thin = min(min(form_of(member).size) for member, _ in members_of(part.shape))
    return round(min(_ROUNDED, max(_LEFT * thin // _FINE, 1) * _FINE), 6)


def _depth(part: Part) -> float:
    """Least hardened depth [m]."""
    assert part.shape is not None
    thin = float(np.ptp(np.concatenate(part.shape.pieces(_STEP)), axis=0).min())
    return round(float(np.clip(_SHARE * thin, *_DEPTHS)) / _STEP) * _STEP
