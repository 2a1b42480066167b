"""Figures of a report as inline SVG.

`style` has the colours and fonts, `looks` the colour and marker of each label, `sheet` writes SVG; `plot`, `drawing`,
`animation`, `timing` and `lanes` are the kinds of figure.
"""

from ilmek.report import Animation, Drawing, Figure, Gantt, Plot, StackedBars
from ilmek.viz.animation import draw_animation
from ilmek.viz.drawing import draw_drawing
from ilmek.viz.lanes import draw_gantt, draw_stacked
from ilmek.viz.looks import looked
from ilmek.viz.plot import draw_plot
from ilmek.viz.style import FONTS
from ilmek.viz.timing import draw_timing


def svg(figure: Figure) -> str:
    """The figure as the text of an `<svg>` element without ids; the same figure gives the same text. See `looked`."""
    (figure,) = looked((figure,))
    if isinstance(figure, Plot):
        sheet = draw_plot(figure)
    elif isinstance(figure, Drawing):
        sheet = draw_drawing(figure)
    elif isinstance(figure, Animation):
        sheet = draw_animation(figure)
    elif isinstance(figure, Gantt):
        sheet = draw_gantt(figure)
    elif isinstance(figure, StackedBars):
        sheet = draw_stacked(figure)
    else:
        sheet = draw_timing(figure)
    return sheet.svg(figure.title, FONTS)
