"""Crank-rockers with a given swing of the rocker and a given rotation of the crank between the dead centres.

The family of Khare and Dave (Mechanism and Machine Theory 14 (1979) 319), as used for the beat-up of handmade carpet
looms by Topalbekiroglu and Celik, "Kinematic analysis of beat-up mechanism used for handmade carpet looms", here
called [paper]. Everything is a ratio to the ground link, whose length is 1.

    ground D = 0, A = 1     crank DC = a     coupler CB = b     rocker AB = c, B above the ground line (branch +1)
    psi   swing of the rocker
    phi   rotation of the crank, counter-clockwise, from the extended dead centre (D, C, B in line, |DB| = a + b) to the
          folded one (|DB| = b - a); the rocker rotates by +psi meanwhile
    beta  crank angle of the extended dead centre: beat-up position

    (b - a) e^{i(beta + phi - pi)} - 1 = [(a + b) e^{i beta} - 1] e^{i psi}

Three parameters identify a member of the family, each with its own function here: `beta`, the coupler `b`, and the
ratio `a / b`. The first fails at phi = pi + psi, where beta is not free; the others hold for every phi.

All functions take numbers or arrays of any shape, without checks: outside the family the result is NaN or a linkage
that is no crank-rocker. `selection.member` checks its arguments and selects a member.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexField, RealField
from ilmek.units import turn


class LinkRatios(NamedTuple):
    """Link lengths of a four-bar in units of its ground link."""

    crank: RealField
    coupler: RealField
    rocker: RealField


class OpenInterval(NamedTuple):
    """Ends of an open interval."""

    low: RealField
    high: RealField


class DeadCentres(NamedTuple):
    """Swing of the rocker, rotation of the crank between the dead centres, and beta [rad]."""

    swing: RealField
    rotation: RealField
    beta: RealField


def links_of_beta(swing: RealField, rotation: RealField, beta: RealField) -> LinkRatios:
    """Links [ground links] from swing, rotation and the crank angle beta of the extended dead centre [rad].

        a = -sin(psi/2) cos(phi/2 + beta) / sin((phi-psi)/2)      b = sin(psi/2) sin(phi/2 + beta) / cos((phi-psi)/2)
        c^2 = (a + b - cos beta)^2 + sin^2 beta

    0/0 at phi = pi + psi. [paper, Eqs 1 to 3; the last is the sum of squares that is expanded in Eq 3]

    >>> [round(float(link), 4) for link in links_of_beta(np.radians(30), np.pi, np.radians(48))]
    [0.1991, 0.6691, 0.7694]
    """
    half, toggle = swing / 2, rotation / 2 + beta
    crank = -np.sin(half) * np.cos(toggle) / np.sin(rotation / 2 - half)
    coupler = np.sin(half) * np.sin(toggle) / np.cos(rotation / 2 - half)
    return LinkRatios(crank, coupler, _rocker(crank, coupler, beta))


def links_of_ratio(swing: RealField, rotation: RealField, ratio: RealField) -> LinkRatios:
    """Links [ground links] from swing, rotation [rad] and the ratio crank / coupler, for every phi.

        b = sin(psi/2) / sqrt(ratio^2 sin^2((phi-psi)/2) + cos^2((phi-psi)/2)),     a = ratio b

    From `links_of_beta` with beta eliminated by sin^2 + cos^2 = 1. [derived; at phi = pi + psi Eqs 11 to 13]
    """
    half = swing / 2
    coupler = np.sin(half) / np.hypot(ratio * np.sin(rotation / 2 - half), np.cos(rotation / 2 - half))
    crank = ratio * coupler
    return LinkRatios(crank, coupler, _rocker(crank, coupler, beta_of_ratio(swing, rotation, ratio)))


def links_of_coupler(swing: RealField, rotation: RealField, coupler: RealField) -> LinkRatios:
    """Links [ground links] from swing, rotation [rad] and the length of the coupler [ground links], for every phi.

        a = sqrt(sin^2(psi/2) - b^2 cos^2((phi-psi)/2)) / sin((phi-psi)/2)

    [derived as in `links_of_ratio`]
    """
    half = swing / 2
    crank = np.sqrt(np.sin(half) ** 2 - (coupler * np.cos(rotation / 2 - half)) ** 2) / np.sin(rotation / 2 - half)
    return LinkRatios(crank, coupler, _rocker(crank, coupler, beta_of_ratio(swing, rotation, crank / coupler)))


def beta_of_ratio(swing: RealField, rotation: RealField, ratio: RealField) -> RealField:
    """Crank angle of the extended dead centre [rad] of the member with the given ratio crank / coupler.

        phi/2 + beta = arg(-ratio sin((phi-psi)/2) + i cos((phi-psi)/2))  in (0, 2 pi)

    [the quotient of the two Eqs 1; at phi = pi + psi Eq 10, beta = pi - phi/2, for any ratio]
    """
    lag = rotation / 2 - swing / 2
    beta: RealField = np.mod(np.arctan2(np.cos(lag), -ratio * np.sin(lag)), turn) - rotation / 2
    return beta


def _rocker(crank: RealField, coupler: RealField, beta: RealField) -> RealField:
    rocker: RealField = np.hypot(crank + coupler - np.cos(beta), np.sin(beta))
    return rocker


def rotation_limits(swing: RealField) -> OpenInterval:
    """Rotations of the crank between dead centres for which crank-rockers of this swing exist [rad], ends excluded.

    pi/2 + psi/2 < phi < 3 pi/2 + psi/2     [derived: the interval of `coupler_limits` is not empty]
    """
    return OpenInterval(np.pi / 2 + swing / 2, 3 * np.pi / 2 + swing / 2)


def beta_limits(swing: RealField, rotation: RealField) -> OpenInterval:
    """Crank angles of the extended dead centre for which crank-rockers exist [rad], ends (change points) excluded.

    phi <= pi              pi - phi .. pi/2 - psi/2       [paper, Eq 8]
    pi < phi < pi + psi           0 .. pi/2 - psi/2       [paper, Eq 6, which prints it for every phi > pi]
    phi = pi + psi         only pi - phi/2                [paper, Eq 10]: the interval is a point
    phi > pi + psi    pi/2 - psi/2 .. 2 pi - phi          [not in the paper]
    """
    mirror = np.pi / 2 - swing / 2
    toggle = np.where(
        rotation <= np.pi, np.pi - rotation, np.where(rotation < np.pi + swing, 0.0, 2 * np.pi - rotation)
    )
    return OpenInterval(np.minimum(mirror, toggle)[()], np.maximum(mirror, toggle)[()])


def coupler_limits(swing: RealField, rotation: RealField) -> OpenInterval:
    """Couplers for which crank-rockers exist [ground links], ends excluded, for every phi.

    sin(psi/2) < b < sin(psi/2) sin(phi/2) / |cos((phi-psi)/2)|

    The upper end tends to infinity at phi = pi + psi, where the coupler is free. [derived from `beta_limits`]
    """
    low = np.sin(swing / 2)
    return OpenInterval(low, low * np.sin(rotation / 2) / np.abs(np.cos(rotation / 2 - swing / 2)))


def ratio_limits(swing: RealField, rotation: RealField) -> OpenInterval:
    """Ratios crank / coupler [1] for which crank-rockers exist, ends excluded: |cot(phi/2) cot((phi-psi)/2)| < a/b < 1.

    [derived from `coupler_limits`; the ratio falls as the coupler grows]
    """
    low = np.abs(np.cos(rotation / 2) * np.cos(rotation / 2 - swing / 2))
    return OpenInterval(low / np.abs(np.sin(rotation / 2) * np.sin(rotation / 2 - swing / 2)), np.ones_like(low)[()])


def transmission_angles(links: LinkRatios) -> tuple[RealField, RealField]:
    """Angle between coupler and rocker [rad] at the crank angles 0 and pi, where the crank is on the ground line.

        tan^2(mu/2) = (x^2 - (b-c)^2) / ((b+c)^2 - x^2),    x = 1 -+ a

    They are the least and the greatest angle over the turn. Half angles, because arccos loses digits near a toggle.
    [law of cosines in triangle CBA; paper, Eq 7 for x = 1 - a]
    """
    crank, coupler, rocker = links

    def angle(x: RealField) -> RealField:
        open_, shut = (coupler + rocker - x) * (coupler + rocker + x), (x - coupler + rocker) * (x + coupler - rocker)
        return 2 * np.arctan2(np.sqrt(shut), np.sqrt(open_))

    return angle(1 - crank), angle(1 + crank)


def transmission_angle_min(links: LinkRatios) -> RealField:
    """Least acute angle between coupler and rocker over the turn [rad]; NaN where the crank cannot rotate fully.

        mu_min = min(mu(crank at 0), pi - mu(crank at pi))

    The first term is the minimum for phi >= pi [paper, Eqs 7, 14, 18], the second for phi <= pi:
    cos mu = ((1+a)^2 - b^2 - c^2) / (2bc). Eq 9 of the paper has the opposite sign of this numerator, which gives the
    obtuse mu_max (154.92 deg for phi = 160 deg, beta = 70 deg); its Table 1 has the correct value (25.08 deg).
    """
    at_zero, at_half_turn = transmission_angles(links)
    return np.minimum(at_zero, np.pi - at_half_turn)


def best_ratio(swing: RealField, rotation: RealField) -> RealField:
    """Ratio crank / coupler [1] of the member with the greatest least transmission angle; 0 for phi = pi.

        s^4 S^2 x^3 + 2 s^2 c^2 S^2 x^2 - s^2 c^2 S^2 x - c^2 C^2 = 0,     x = (a/b)^2,
        s, c = sin, cos(phi/2),     S, C = sin, cos((phi-psi)/2)

    The cubic of Freudenstein and Primrose, Q^3 + 2 Q^2 - t^2 Q - (t^2/u^2)(1 + t^2) = 0 with t = tan(phi/2),
    u = tan((phi-psi)/2), (b/a)^2 = t^2/Q, without its poles at phi = pi and phi = pi + psi. At phi = pi + psi it gives
    b = sqrt(a(1+a)) [paper, Eq 12]. One root is positive. Newton's method from 1 converges to it monotonically, because
    the cubic is convex and, where crank-rockers exist, positive at 1.
    """
    s, c = np.sin(rotation / 2) ** 2, np.cos(rotation / 2) ** 2
    S, C = np.sin(rotation / 2 - swing / 2) ** 2, np.cos(rotation / 2 - swing / 2) ** 2
    a3, a1, a0 = s * s * S, s * c * S, c * C
    x = np.ones_like(s + S)
    for _ in range(64):
        x = x - (((a3 * x + 2 * a1) * x - a1) * x - a0) / ((3 * a3 * x + 4 * a1) * x - a1)
    ratio: RealField = np.sqrt(np.maximum(x, 0.0))[()]
    return ratio


def grashof_margin(links: LinkRatios) -> RealField:
    """Sum of the two middle links minus the shortest and the longest [ground links]; Grashof condition: above 0.

    [paper, criterion iii]
    """
    crank, coupler, rocker = links
    lengths = np.stack(np.broadcast_arrays(np.ones_like(crank), crank, coupler, rocker))
    margin: RealField = np.sum(lengths, axis=0) - 2 * (np.min(lengths, axis=0) + np.max(lengths, axis=0))
    return margin


def dead_centres(links: LinkRatios) -> DeadCentres:
    """Swing, rotation of the crank and beta of given links [rad]; NaN where a dead centre does not close.

    The distance |DB| is a + b at the extended dead centre and |b - a| at the folded one; B is above the ground line at
    the distance c from A.     [paper, Fig 3; derived]
    """
    crank, coupler, _ = links
    extended, folded = _above(links, crank + coupler), _above(links, np.abs(coupler - crank))
    beta = np.angle(extended)
    rotation = np.mod(np.angle(np.where(coupler >= crank, -folded, folded)) - beta, turn)
    return DeadCentres(np.angle((folded - 1) / (extended - 1)), rotation, beta)


def _above(links: LinkRatios, distance: RealField) -> ComplexField:
    """The point B above the ground line at a distance from D and at the rocker's length from A."""
    along = 0.5 * (distance**2 + 1 - links.rocker**2)
    return along + 1j * np.sqrt(distance**2 - along**2)
