"""Knot charts as OXS, the open XML charts of cross-stitch programs: a full stitch for a knot, a three-quarter stitch in
two colours for two half knots, bare cloth for a cell without a knot.

    <chart>
      <properties software="ilmek" chartwidth chartheight stitchesperinch stitchesperinch_y palettecount .../>
      <palette>  <palette_item index number name color .../>  </palette>        item 0 is the cloth
      <fullstitches>  <stitch x y palindex/>  </fullstitches>                    x to the right, y down, both from 0
      <partstitches>  <partstitch x y palindex1 palindex2 direction/>  </partstitches>     left and right half knots
      <backstitches/> ...                                                        empty
      <ilmek facts overlay cells/>                                               all facts of the chart
    </chart>

Other programs ignore the element `ilmek`. Format: the specification of UrsaSoftware, which made it, as extended by
Embroidery Space (xsp-specs, oxs/OXS.md).
"""

from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.sax.saxutils import quoteattr

from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.overlay import HALF
from ilmek.io.carpet_facts import chart_facts
from ilmek.io.cells_text import cells_text
from ilmek.io.overlay_text import overlay_text
from ilmek.io.picture import METRE
from ilmek.progress import SILENT, Progress

MOST_OXS_KNOTS = 4_000_000
"""Largest number of knots of an OXS file: 160 MB."""


def write_chart_oxs(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the chart, of at most MOST_OXS_KNOTS knots, to `path`. Raises OSError."""
    with path.open("w", encoding="utf-8", newline="\n") as file:
        for number, text in enumerate(_lines(chart)):
            file.write(text)
            progress(min(1.0, number / chart.rows))


def _lines(chart: Chart) -> Iterator[str]:
    """The text of the file in parts, one for each row of knots."""
    yield '<?xml version="1.0" encoding="UTF-8"?>\n<chart>\n'
    properties = {
        "oxsversion": "1.0",
        "software": "ilmek",
        "chartheight": chart.rows,
        "chartwidth": chart.columns,
        "charttitle": "Knot chart",
        "stitchesperinch": f"{chart.quality.across * METRE:.6g}",
        "stitchesperinch_y": f"{chart.quality.along * METRE:.6g}",
        "palettecount": len(chart.yarns),
    }
    yield f"  {_element('properties', properties)}\n  <palette>\n"
    cloth = {"index": 0, "number": "cloth", "name": "cloth", "color": "FFFFFF"}
    yield f"    {_element('palette_item', cloth)}\n"
    for index, yarn in enumerate(chart.yarns, start=1):
        item = {"index": index, "number": f"ilmek {index}", "name": yarn.name, "color": yarn.hex[1:].upper()}
        yield f"    {_element('palette_item', {**item, 'strands': yarn.ply})}\n"
    yield "  </palette>\n  <fullstitches>\n"
    begins = [f'    <stitch x="{column}" y="' for column in range(chart.columns)]
    halves = [mark for mark in chart.overlay if mark.kind == HALF]
    in_halves = {(mark.row, mark.column) for mark in halves}
    for number, row in enumerate(chart.knots):
        ends = [f'{number}" palindex="{yarn + 1}"/>\n' for yarn in range(len(chart.yarns))]
        stitches = [begin + ends[yarn] for begin, yarn in zip(begins, row.tolist(), strict=True) if yarn != NO_KNOT]
        if halves:
            knots = [at for at, yarn in enumerate(row.tolist()) if yarn != NO_KNOT]
            stitches = [one for at, one in zip(knots, stitches, strict=True) if (number, at) not in in_halves]
        yield "".join(stitches)
    yield "  </fullstitches>\n  <partstitches>\n"
    for row, column, _, second in halves:
        colours = {"palindex1": int(chart.knots[row, column]) + 1, "palindex2": second + 1}
        yield f"    {_element('partstitch', {'x': column, 'y': row, **colours, 'direction': 1})}\n"
    yield "  </partstitches>\n"
    for empty in ("backstitches", "ornaments_inc_knots_and_beads", "commentboxes"):
        yield f"  <{empty}/>\n"
    facts = {"facts": chart_facts(chart), "overlay": overlay_text(chart.overlay, chart.columns)}
    if chart.cells is not None:
        facts["cells"] = cells_text(chart.cells)
    yield f"  {_element('ilmek', facts)}\n</chart>\n"


def _element(name: str, attributes: Mapping[str, object]) -> str:
    return f"<{name} {' '.join(f'{key}={quoteattr(str(value))}' for key, value in attributes.items())}/>"
