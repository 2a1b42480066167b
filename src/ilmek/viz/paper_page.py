"""The page of a sheet of squared paper: each doubtful cell in the picture and as it was read, to correct.

A click or a key chooses another yarn. The corrections are edits of a recipe, to copy or to save.
"""

import base64
import io

import numpy as np
from PIL import Image

from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import takes_white
from ilmek.carpet.paper.sheet import VIEW, PaperReading
from ilmek.carpet.picture_points import hex_colour
from ilmek.report import Json
from ilmek.units import counted
from ilmek.viz.page import render

_ACROSS = 20
"""Views in a line of their common picture."""


def paper_page(chart: Chart, title: str) -> str:
    """The page of a chart that was read from squared paper, self-contained HTML."""
    paper = chart.reading.paper
    assert paper is not None
    yarns = [
        {"name": yarn.name, "colour": hex_colour(yarn.srgb), "letters": "#fff" if takes_white(yarn.srgb) else "#000"}
        for yarn in (chart.yarns[number] for number in chart.used)
    ]
    shown = len(paper.shown)
    of_all = "" if shown == paper.doubts else f", the {shown:,} most doubtful ones are shown"
    return render(
        "paper.html.j2",
        title=f"{title}: doubtful cells",
        lead=f"{counted(paper.doubts, 'cell')} of {paper.numbers.size:,}{of_all}",
        views=_sprite(paper),
        data={"yarns": yarns, "cells": _cells(chart, paper), "across": _ACROSS, "view": VIEW},
    )


def _cells(chart: Chart, paper: PaperReading) -> list[dict[str, Json]]:
    """Of each cell shown: row and column as in edits, confidence, the yarns about it (-1: outside), row by row."""
    place = {yarn: number for number, yarn in enumerate(chart.used)}
    padded = np.pad(chart.knots.astype(int), 1, constant_values=-1)
    return [
        {
            "row": chart.rows - row,
            "column": column + 1,
            "confidence": round(float(paper.confidence[row, column]), 3),
            "around": [place.get(yarn, -1) for yarn in padded[row : row + 3, column : column + 3].ravel().tolist()],
        }
        for row, column in paper.shown.tolist()
    ]


def _sprite(paper: PaperReading) -> str:
    """All views in one picture, as a data URL."""
    lines = -(-len(paper.views) // _ACROSS)
    sprite = np.zeros((lines * VIEW, _ACROSS * VIEW, 3), dtype=np.uint8)
    for number, view in enumerate(paper.views):
        y, x = number // _ACROSS * VIEW, number % _ACROSS * VIEW
        sprite[y : y + VIEW, x : x + VIEW] = view
    stored = io.BytesIO()
    Image.fromarray(sprite).save(stored, "PNG")
    return "data:image/png;base64," + base64.b64encode(stored.getvalue()).decode()
