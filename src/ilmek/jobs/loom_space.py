"""A loom in space as files: GLB, and the data of the picture in loom.html with the client that draws it."""

import numpy as np

from ilmek.carpet.chart import Chart
from ilmek.io.glb import glb_bytes
from ilmek.jobs.machine_space import bodies_file
from ilmek.jobs.studio.answers import Binary, packed
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.scene import loom_tree, periods_of, scene
from ilmek.machines.hand_loom import HandLoom
from ilmek.machines.hand_loom.scene import scene as hand_scene
from ilmek.report import Json, Report
from ilmek.report.scene import Scene
from ilmek.viz.embedded import client, compressed
from ilmek.viz.loom_page import LoomInSpace
from ilmek.viz.scene_data import scene_data

MOST_KNOTS = 1_000_000
"""Knots of a chart in a page; of a larger one every second, third, ... row and column is shown."""


def loom_glb(loom: LoomDesign, report: Report) -> bytes:
    """A loom as GLB, with its motions over a row and over a knot as animations."""
    return glb_bytes(scene(loom, report))


def loom_file(option: str, loom: LoomDesign, report: Report, pose: str | None = None) -> bytes | str:
    """The content of the file of an option, as `machine_file`."""
    if option == "--glb":
        return loom_glb(loom, report)
    return bodies_file(option, loom_tree(loom), report, pose, periods_of(loom))


def scene_answer(made: Scene, chart: Chart | None, *, most: int | None = None) -> Binary:
    """A scene with the chart of its carpet: JSON, 32-bit floats and integers, a byte a knot, the top row first.

    most  knots of the chart; default: all
    """
    data = scene_data(made)
    knots = np.zeros((0, 0), np.uint8)
    if chart is not None and len(chart.shades) <= np.iinfo(np.uint8).max + 1:
        every = 1 if most is None else max(1, int(np.ceil(np.sqrt(chart.knots.size / most))))
        knots = np.ascontiguousarray(chart.shaded[::every, ::every]).astype(np.uint8)
    shown: dict[str, Json] | None = None
    if chart is not None and knots.size:
        shown = {
            "rows": knots.shape[0],
            "columns": knots.shape[1],
            "colours": [yarn.hex for yarn in chart.shades],
            "yarns": [yarn.name for yarn in chart.shades],
        }
    lengths = [len(data.floats), len(data.integers), knots.nbytes]
    return packed({**data.about, "chart": shown, "lengths": lengths}, data.floats, data.integers, knots.tobytes())


def loom_scene(loom: LoomDesign | HandLoom, report: Report) -> Scene:
    """A loom in space, with drives or without."""
    return hand_scene(loom, report) if isinstance(loom, HandLoom) else scene(loom, report)


def loom_in_space(loom: LoomDesign | HandLoom, report: Report, chart: Chart | None) -> LoomInSpace | None:
    """The picture of a loom for its page; None where the package has no client, as in its sources before a build."""
    script = client("loom")
    if not script:
        return None
    return LoomInSpace(script, compressed(scene_answer(loom_scene(loom, report), chart, most=MOST_KNOTS).body))
