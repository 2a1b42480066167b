"""Swing of the rocker from three positions of the weaver's hand.               [Topalbekiroglu and Celik, 2.1.2, Fig 2]

The beater follows the hand where the rocker's pivot M is the centre of the circle through the three positions, which is
the three-point synthesis: |M - P1| = |M - P2| = |M - P3|. The swing is the angle P1 M P3 on the side of P2.
"""

import numpy as np

from ilmek.errors import ParameterError
from ilmek.params.text_lists import read_points
from ilmek.plane.vectors import cross
from ilmek.units import turn

FOREARM = 0.35
"""Of a weaver, from the elbow to the beater in her hand [m]; assumed by this project."""

HAND = "(40.1923788646684mm,150mm) (10.2222521132795mm,77.6457135307562mm) (0,0)"
"""Positions on an arc of 30 deg with a radius of 300 mm: the paper's swing. Its Fig 2 prints no coordinates."""


def forearm_positions(height: float) -> str:
    """First, second and final position of a hand that beats from a height over the fell [m], about an elbow level with
    the fell, as a text; about a longer arm where the forearm would swing by more than 45 deg.

    >>> round(float(np.degrees(hand_swing(*hand_positions(forearm_positions(0.175))))), 6)
    30.0
    """
    arm = max(FOREARM, height / np.sin(turn / 8))
    swing = float(np.arcsin(height / arm))
    places = arm * (1 - np.exp(-1j * np.array([swing, swing / 2, 0.0])))
    return " ".join(f"({place.real!r}m,{place.imag!r}m)" for place in places.tolist())


def hand_positions(text: str) -> tuple[complex, complex, complex]:
    """First, second and final position [m] of a text as `read_points` reads it. Raises ParameterError for others."""
    points = read_points("hand", text).tolist()
    if len(points) != 3:
        raise ParameterError(f"hand has {len(points)} positions", allowed="three: first, second, final")
    return points[0], points[1], points[2]


def pivot(first: complex, second: complex, third: complex) -> complex:
    """Centre of the circle through three positions [m]. Raises ParameterError where they are in line."""
    b, c = second - first, third - first
    area = 2 * float(cross(b, c))
    if abs(area) < 1e-12 * max(abs(b), abs(c)) ** 2:
        raise ParameterError("the three positions of the hand are in line", do="move one of them")
    return first + 1j * (b * abs(c) ** 2 - c * abs(b) ** 2) / area


def hand_swing(first: complex, second: complex, third: complex) -> float:
    """Angle of the rocker between the first and the third position, on the side of the second [rad].

    >>> import numpy as np
    >>> on_arc = 0.3 * np.exp(1j * np.radians([150, 165, 180]))
    >>> round(float(np.degrees(hand_swing(*on_arc))), 9)
    30.0
    """
    centre = pivot(first, second, third)
    start = first - centre
    middle, end = (float(np.angle((one - centre) / start)) % turn for one in (second, third))
    return end if middle < end else turn - end
