"""Draws docs/_static/overview.svg: what goes into `ilmek weave` and what comes out, from a real run on the medallion.

Run it as `python examples/draw_overview.py`.
"""

import base64
import io
from pathlib import Path

import numpy as np
from PIL import Image

from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.quality import parse_quality
from ilmek.carpet.sizes import parse_size
from ilmek.io.picture import read_picture
from ilmek.io.yarn_file import default_yarns
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design
from ilmek.machines.beat_up import MACHINE as BEAT_UP
from ilmek.machines.beat_up import BeatUpParams
from ilmek.report import Figure
from ilmek.viz.carpet_picture import draw_carpet
from ilmek.viz.svg import svg

EXAMPLES = Path(__file__).parent
OUT = EXAMPLES.parent / "docs" / "_static" / "overview.svg"
LOOM = OUT.with_name("loom.webp")
WIDTH, HEIGHT = 1240, 1100
INK, MUTED = "#1f2933", "#52606d"


def embedded(jpeg: bytes) -> str:
    """A picture as an address that holds it."""
    return "data:image/jpeg;base64," + base64.b64encode(jpeg).decode("ascii")


def jpeg(pixels: np.ndarray, width: int, height: int) -> bytes:
    """Pixels as a JPEG file of a size."""
    room = io.BytesIO()
    Image.fromarray(pixels).resize((width, height), Image.Resampling.LANCZOS).save(room, "JPEG", quality=82)
    return room.getvalue()


def chart_pixels(chart: Chart) -> np.ndarray:
    """A corner of the chart, a grid between the knots."""
    colours = np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)
    cell = 12
    cells: np.ndarray = colours[chart.knots[:84, :56]].repeat(cell, axis=0).repeat(cell, axis=1)
    cells[::cell] = cells[:, ::cell] = 90
    cells[:: 10 * cell] = cells[:, :: 10 * cell] = 15
    return cells


def caption(x: float, y: float, head: str, text: str) -> str:
    """A heading and a line under it."""
    return (
        f'<text x="{x}" y="{y}" font-size="17" font-weight="700" fill="{INK}">{head}</text>'
        f'<text x="{x}" y="{y + 19}" font-size="13" fill="{MUTED}">{text}</text>'
    )


def picture(x: float, y: float, width: float, height: float, address: str) -> str:
    """A raster picture in its place."""
    return f'<image x="{x}" y="{y}" width="{width}" height="{height}" href="{address}"/>'


def figure(drawn: Figure, x: float, y: float, width: float, height: float) -> str:
    """A figure of the report in its place, its proportions kept."""
    place = f'<svg x="{x}" y="{y}" width="{width}" height="{height}" '
    return svg(drawn).replace("<svg ", place, 1)


def arrow(x: float, y: float) -> str:
    """An arrow to the right."""
    return f'<path d="M{x} {y}h30m-9-8l9 8l-9 8" fill="none" stroke="{INK}" stroke-width="2.5"/>'


def draw() -> str:
    """The whole picture."""
    photo = read_picture(EXAMPLES / "medallion.png").rgb
    size, quality = parse_size("seccade"), parse_quality("25x25/dm")
    chart = make_chart(photo, size, quality, default_yarns())
    params = AutomatedLoomParams(
        width=size.width, length=size.length, knots_across=quality.across, knots_along=quality.along
    )
    loom, beat_up = MACHINE.report(design(params)), BEAT_UP.report(BEAT_UP.design(BeatUpParams()))
    figures = {one.name: one for made in (loom, *loom.children, beat_up) for one in made.figures}
    tall, wide = 300, 200
    parts = [
        caption(30, 40, "A picture", "medallion.png, 120 × 180 cm"),
        picture(30, 75, wide, tall, embedded(jpeg(photo, 400, 600))),
        arrow(245, 225),
        caption(290, 40, "its knot chart", f"{chart.colours} wool yarns, 135 000 knots"),
        picture(290, 75, wide, tall, embedded(jpeg(chart_pixels(chart), 448, 672))),
        arrow(505, 225),
        caption(550, 40, "the carpet", "as it will look"),
        picture(545, 68, 216, 320, embedded(draw_carpet(chart, longest=700).jpeg)),
        arrow(775, 225),
        caption(
            830, 40, "and the loom that weaves it", f"{design(params).warps} warps at 2 mm, all parts held and driven"
        ),
        picture(830, 68, 330, 320, embedded(jpeg(np.asarray(Image.open(LOOM).convert("RGB")), 825, 800))),
        caption(30, 440, "beat-up linkage", "synthesised, its forces checked"),
        figure(figures["beat-up"], 10, 470, 420, 290),
        caption(30, 790, "shedding cams", "sized for pressure angle and shaft"),
        figure(figures["shedding-cam"], 10, 815, 420, 275),
        caption(460, 440, "and one cyclogram for all", "a knot on one turn of six cams"),
        figure(figures["knot"], 445, 475, 785, 615),
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}"'
        f' font-family="Helvetica Neue, Arial, Liberation Sans, DejaVu Sans, sans-serif">'
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>{"".join(parts)}</svg>\n'
    )


if __name__ == "__main__":
    OUT.write_text(draw(), encoding="utf-8")
    print(f"{OUT.name}: {OUT.stat().st_size / 1e3:.0f} kB")
