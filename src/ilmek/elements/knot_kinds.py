"""Kinds of knots: names, and the length of yarn around the warps.

The yarn's axis turns round a warp on the radius r; the warps have the pitch p. In the section across the warps:

    symmetric (Ghiordes, Turkish): over both warps, round the outside of each, up between them. Straight from top to
            top, p; round each warp from its top by the outside and the bottom to the inside, 3/4 turn:

                wrap = p + 2 · (3/2) pi r = p + 3 pi r

    asymmetric (Senneh, Persian): down beside the first warp, behind it, across to the front of the second, right round
            that, up between the two. The crossing is the inner tangent of the two circles, at the angle alpha to the
            plane of the warps, sin alpha = 2r/p, long sqrt(p² - 4r²); the turns are 90° + alpha and 270° + alpha:

                wrap = sqrt(p² - 4r²) + 2 r (pi + alpha)

            Where the warps are closer than 2r the yarn is perpendicular to their plane: alpha = 90°, no straight part.

    single-warp: one and a half turns around one warp (customs definition of heading 5701):

                wrap = 3 pi r

The jufti forms combine neighbouring warps: the straight parts grow by whole pitches, the turns are equal. The same
curve, point by point, is `ilmek.weaving.knots.path`.                                             [derived: geometry]
"""

import difflib
import math
from collections.abc import Callable

from ilmek.errors import CarpetError
from ilmek.records import shown_value


def symmetric_wrap(pitch: float, radius: float, left: int = 1, right: int = 1) -> float:
    """Length of a symmetric knot around its warps [m]: (2 (m + n) - 3) p + 3 pi r.

    pitch  p of the warps [m]      radius  r of the yarn's axis on a warp [m]
    left, right  m and n, warps on each side of its middle: 1, 2 for the jufti form
    """
    return (2 * (left + right) - 3) * pitch + 3 * math.pi * radius


def asymmetric_wrap(pitch: float, radius: float, passed: int = 1, encircled: int = 1) -> float:
    """Length of an asymmetric knot around its warps [m]: (m - 1 + 2 (n - 1)) p + sqrt(p² - 4r²) + 2 r (pi + alpha).

    sin alpha = 2r/p      pitch  p of the warps [m]      radius  r of the yarn's axis on a warp [m]
    passed, encircled  m and n, numbers of warps passed behind and encircled: 1, or 2 for a jufti
    """
    alpha = math.asin(min(1.0, 2 * radius / pitch))
    straight = (passed - 1 + 2 * (encircled - 1)) * pitch + math.sqrt(max(pitch**2 - 4 * radius**2, 0.0))
    return straight + 2 * radius * (math.pi + alpha)


def single_wrap(radius: float) -> float:
    """Length of a single-warp knot around its warp [m]: 3 pi r.

    radius  r of the yarn's axis on the warp [m]
    """
    return 3 * math.pi * radius


WRAPS: dict[str, Callable[[float, float], float]] = {"symmetric": symmetric_wrap, "asymmetric": asymmetric_wrap}

FORMS = ("whole", "half", "jufti")
"""Forms of a carpet's knot: on two warps, on a single one, and on four, in pairs."""


def wrap_of(knot: str, form: str, pitch: float, radius: float) -> float:
    """Length of a form of the carpet's knot around its warps [m]; the single-warp knot has one kind.

    knot  symmetric or asymmetric      form  of FORMS      pitch, radius  p and r [m]

    >>> [round(wrap_of("symmetric", form, 4.0, 1.0), 2) for form in FORMS]
    [13.42, 9.42, 29.42]
    """
    if form == "half":
        return single_wrap(radius)
    if form == "jufti":
        return (symmetric_wrap if knot == "symmetric" else asymmetric_wrap)(pitch, radius, 2, 2)
    return WRAPS[knot](pitch, radius)


_OTHER_NAMES = {
    **dict.fromkeys(("turkish", "ghiordes", "gördes", "gordes", "double"), "symmetric"),
    **dict.fromkeys(("persian", "senneh", "senna", "sine", "single"), "asymmetric"),
}


def parse_knot(text: str) -> str:
    """`symmetric` or `asymmetric` from either name or a trade name. Raises CarpetError for an unknown knot.

    >>> parse_knot("Ghiordes"), parse_knot("persian")
    ('symmetric', 'asymmetric')
    """
    name = str(text).strip().casefold()
    if name in WRAPS:
        return name
    if name in _OTHER_NAMES:
        return _OTHER_NAMES[name]
    matches = difflib.get_close_matches(name, [*WRAPS, *_OTHER_NAMES], n=1)
    raise CarpetError(
        f"unknown knot {shown_value(text)}",
        allowed="symmetric (Turkish) or asymmetric (Persian)",
        do=f"did you mean {matches[0]}?" if matches else "",
    )
