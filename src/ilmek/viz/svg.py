"""Figures of a report as inline SVG.

The look is `style`, the kinds of figure are `plot`, `drawing`, `animation` and `timing`, the text is made in
`svg_cleanup`.
"""

import warnings

from matplotlib import rc_context

from ilmek.report import Animation, Drawing, Figure, Plot
from ilmek.viz.animation import draw_animation
from ilmek.viz.drawing import draw_drawing
from ilmek.viz.plot import draw_plot
from ilmek.viz.style import RC
from ilmek.viz.svg_cleanup import inline_svg, slug
from ilmek.viz.timing import draw_timing


def svg(figure: Figure, prefix: str = "") -> str:
    """The figure as the text of an `<svg>` element; the same figure gives the same text.

    prefix  put before every id, so that one page can hold figures of the same name
    """
    with rc_context(RC), warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"Glyph .* missing from font")  # the reader's fonts may have it
        over = ""
        if isinstance(figure, Plot):
            sheet = draw_plot(figure)
        elif isinstance(figure, Drawing):
            sheet = draw_drawing(figure)
        elif isinstance(figure, Animation):
            sheet, over = draw_animation(figure)
        else:
            sheet, over = draw_timing(figure)
        return inline_svg(sheet, figure.title, slug(f"{prefix}-{figure.name}"), over)
