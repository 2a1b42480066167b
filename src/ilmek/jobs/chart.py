"""The carpet part: picture to knot chart and yarn bill, and their files."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ilmek.arrays import Rgb
from ilmek.carpet.bill import YarnBill, YarnNeed, yarn_bill
from ilmek.carpet.chart import Chart, make_chart
from ilmek.carpet.design import LARGEST_DISTORTION, distortion
from ilmek.io.chart_pdf import write_chart_pdf
from ilmek.io.chart_png import write_chart_png
from ilmek.io.picture import read_picture
from ilmek.io.yarn_csv import write_yarn_csv
from ilmek.jobs.order import Order
from ilmek.jobs.told import Told, part

FILES = ("chart.png", "chart.pdf", "yarn.csv")
"""What `write_chart` puts into a folder."""


@dataclass(frozen=True, slots=True)
class Charted:
    """An order's chart and yarn bill; notes say what was done to the picture."""

    order: Order
    chart: Chart
    bill: YarnBill
    notes: tuple[str, ...]


def make_charted(order: Order, told: Told | None = None) -> Charted:
    """Read the picture and chart it. Raises PictureError, CarpetError or YarnError."""
    if told is not None:
        told("picture", 0.0)
    picture = read_picture(order.picture)
    chart = make_chart(
        picture.rgb,
        order.size,
        order.quality,
        order.yarns,
        knot=order.knot,
        keep_lone=order.keep_lone,
        colours=order.colours,
        progress=part(told, "chart", 0.1, 1.0),
    )
    return Charted(order, chart, yarn_bill(chart, order.pile), (*picture.notes, *_fit(picture.rgb, chart)))


def _fit(rgb: Rgb, chart: Chart) -> tuple[str, ...]:
    """What a person should know of how the picture fits the carpet."""
    height, width = rgb.shape[:2]
    stretch = distortion(rgb, chart.size)
    notes = []
    if abs(stretch) > LARGEST_DISTORTION:
        wider = f"{abs(stretch):.0%} {'wider' if stretch > 0 else 'narrower'}"
        notes.append(f"the picture ({width} x {height} pixels) is drawn {wider} to fill {chart.size}")
    if width < chart.columns or height < chart.rows:
        knots = f"{chart.columns} x {chart.rows} knots"
        notes.append(
            f"the picture ({width} x {height} pixels) is coarser than the carpet ({knots}): edges will be stepped"
        )
    return tuple(notes)


def chart_results(charted: Charted) -> dict[str, Any]:
    """The results of a chart by their stable names, SI."""
    chart, bill = charted.chart, charted.bill
    return {
        "rows": chart.rows,
        "columns": chart.columns,
        "knots": chart.rows * chart.columns,
        "colours": chart.colours,
        "mean_delta_e": chart.mean_delta_e,
        "least_delta_e": chart.least_delta_e,
        "lone_fraction": chart.lone_fraction,
        "changes_per_knot": chart.changes_per_knot,
        "yarn": [_need(need) for need in bill.pile],
        "ground": [_need(need) for need in bill.ground],
        "pile_mass": bill.pile_mass,
        "yarn_mass": bill.mass,
        "price": bill.price,
    }


def _need(need: YarnNeed) -> dict[str, Any]:
    return {name: getattr(need, name) for name in ("name", "use", "knots", "length", "mass", "price")}


def write_chart(charted: Charted, folder: Path, progress: Callable[[float], None] | None = None) -> None:
    """Write the chart's files into a folder. An OSError passes through."""
    write_chart_png(folder / "chart.png", charted.chart)
    write_chart_pdf(folder / "chart.pdf", charted.chart, progress=progress)
    write_yarn_csv(folder / "yarn.csv", charted.bill, charted.chart.yarns)


def job_json(job: str, parameters: dict[str, Any], results: dict[str, Any], **more: Any) -> dict[str, Any]:
    """The JSON of a job: like a machine's report (parameters, results), and each result under its own name too."""
    return {"job": job, "parameters": parameters, "results": results, **more, **results}
