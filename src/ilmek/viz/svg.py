"""Figures of a report as inline SVG.

`style` has the colours and fonts, `plot`, `drawing`, `animation` and `timing` the kinds of figure, `sheet` writes SVG.
"""

from ilmek.report import Animation, Drawing, Figure, Plot
from ilmek.viz.animation import draw_animation
from ilmek.viz.drawing import draw_drawing
from ilmek.viz.plot import draw_plot
from ilmek.viz.style import FONTS
from ilmek.viz.timing import draw_timing


def svg(figure: Figure) -> str:
    """The figure as the text of an `<svg>` element without ids; the same figure gives the same text."""
    over = ""
    if isinstance(figure, Plot):
        sheet = draw_plot(figure)
    elif isinstance(figure, Drawing):
        sheet = draw_drawing(figure)
    elif isinstance(figure, Animation):
        sheet, over = draw_animation(figure)
    else:
        sheet, over = draw_timing(figure)
    return sheet.svg(figure.title, FONTS, over)
