"""The links of a synthesised four-bar for the workshop."""

from ilmek.elements.plates import link_plates
from ilmek.report import Plate
from ilmek.synthesis.selection import FourBarDesign
from ilmek.units import mm

WIDTH_SHARE, SLENDER, WIDE = 0.2, 4 * mm, 40 * mm
"""Width of a link that is not given: a fifth of the shortest one, within these bounds."""

THICKNESS_SHARE = 1 / 3
"""Thickness of a link that is not given, over its width."""


def plates(made: FourBarDesign) -> tuple[Plate, ...]:
    """Crank, coupler and rocker of the solution that is drawn, bored at their pins and the tracer; none without one."""
    if made.best is None:
        return ()
    params, four_bar = made.params, made.best.candidate.four_bar
    lengths = four_bar.lengths
    tracer = () if four_bar.tracer_on_coupler is None else (("P", complex(four_bar.tracer_on_coupler)),)
    links = {
        "crank": (("A0", 0j), ("A", complex(lengths.crank))),
        "coupler": (("A", 0j), ("B", complex(lengths.coupler)), *tracer),
        "rocker": (("B0", 0j), ("B", complex(lengths.rocker))),
    }
    shortest = min(lengths.crank, lengths.coupler, lengths.rocker)
    width = params.link_width or min(max(WIDTH_SHARE * shortest, SLENDER), WIDE)
    thickness = params.link_thickness or THICKNESS_SHARE * width
    return link_plates(links, width=width, thickness=thickness, material="steel")
