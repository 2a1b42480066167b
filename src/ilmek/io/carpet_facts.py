"""The facts of a carpet as plain data, in the files that carry them: size, quality, knot, yarns.

A chart's files carry them as one JSON text, so that the chart comes back as it was, bit for bit. What is read is
checked whole.
"""

import json
from dataclasses import asdict, fields, replace

from ilmek.arrays import Indices
from ilmek.carpet.cells import CellMap
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_reading import ChartReading
from ilmek.carpet.codes import CODES
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import LARGEST, CarpetSize
from ilmek.carpet.yarn import MOST_YARNS, Yarn
from ilmek.elements.knot_kinds import WRAPS
from ilmek.elements.yarns import MATERIALS
from ilmek.errors import LoomError, shortened
from ilmek.io.meta_entry import MetaEntry
from ilmek.io.yarn_file import yarns_from_records
from ilmek.records import JsonObject, record

_OPTIONAL = ("number", "material")
"""Of a yarn, what the files of earlier versions do not have."""

LONGEST_FACTS = 500_000
"""Largest number of characters of the facts of a chart: 255 yarns with names of 200 characters take 110,000."""


@record
class ChartFacts:
    """What a chart's file states besides the knots."""

    size: CarpetSize
    quality: Quality
    knot: str
    yarns: tuple[Yarn, ...]
    creel: tuple[int, ...] | None = None


def chart_facts(chart: Chart) -> str:
    """The facts of a chart as JSON text."""
    facts = {
        "size": asdict(chart.size),
        "quality": asdict(chart.quality),
        "knot": chart.knot,
        "yarns": [yarn_data(yarn) for yarn in chart.yarns],
        **({} if chart.creel is None else {"creel": chart.creel}),
    }
    return json.dumps(facts, ensure_ascii=False)


def yarn_data(yarn: Yarn) -> JsonObject:
    """A yarn as plain data, without the material where it is that of the carpet's pile."""
    data = asdict(yarn)
    return data if yarn.material is not None else {key: data[key] for key in data if key != "material"}


def read_facts(text: str) -> ChartFacts:
    """The facts of a text that `chart_facts` wrote, checked. Raises an IlmekError."""
    if len(text) > LONGEST_FACTS:
        raise LoomError(f"its facts have {len(text):,} characters", allowed=f"at most {LONGEST_FACTS:,}")
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise LoomError(f"its facts are not JSON ({shortened(str(error), 100)})") from None
    given = MetaEntry("chart", data).table("size", "quality", "knot", "yarns", optional=("creel",))
    yarns, creel = yarn_entries(given["yarns"]), given["creel"]
    return ChartFacts(
        size_entry(given["size"]),
        quality_entry(given["quality"]),
        given["knot"].one_of(*WRAPS),
        yarns,
        None if creel.value is None else tuple(creel.wholes(len(yarns), CODES - 1).tolist()),
    )


def chart_of_facts(knots: Indices, facts: ChartFacts, file: str, cells: CellMap | None = None) -> Chart:
    """The chart of a file; `file`: what it is, for the user."""
    reading = ChartReading("exact", f"{file}: knots and yarns are its own", 0.0, 0.0, 0, 0)
    return Chart(knots, facts.yarns, facts.size, facts.quality, facts.knot, reading, creel=facts.creel, cells=cells)


def size_entry(entry: MetaEntry) -> CarpetSize:
    """A carpet's size."""
    sides = entry.table("width", "length", "name")
    return CarpetSize(sides["width"].number(0.0, LARGEST), sides["length"].number(0.0, LARGEST), sides["name"].text())


def quality_entry(entry: MetaEntry) -> Quality:
    """A quality."""
    return Quality(**{key: one.number() for key, one in entry.table("across", "along").items()})


def yarn_entries(entry: MetaEntry) -> tuple[Yarn, ...]:
    """The yarns, by the rules of a yarn list."""
    yarn_entries = []
    for row in entry.rows(2, MOST_YARNS):
        given = row.table(*(one.name for one in fields(Yarn) if one.name not in _OPTIONAL), optional=_OPTIONAL)
        lightness, a, b = (part.number(-200.0, 200.0) for part in given["lab"].rows(3, 3))
        red, green, blue = (part.whole(0, 255) for part in given["srgb"].rows(3, 3))
        price = None if given["price"].value is None else given["price"].number()
        count = None if given["metric_count"].value is None else given["metric_count"].number()
        ply = given["ply"].whole(1, MOST_YARNS)
        place = None if given["number"].value is None else given["number"].whole(1, MOST_YARNS)
        material = None if given["material"].value is None else given["material"].one_of(*MATERIALS)
        colours = (red, green, blue), (lightness, a, b)
        yarn_entries.append(Yarn(given["name"].text(least=1), *colours, count, ply, price, place, material))
    records = [
        {
            "name": yarn.name,
            "srgb": yarn.hex,
            "nm": yarn.metric_count,
            "ply": None if yarn.metric_count is None and yarn.ply == 1 else yarn.ply,
            "price": yarn.price,
            "material": yarn.material,
        }
        for yarn in yarn_entries
    ]
    for yarn, read in zip(yarn_entries, yarns_from_records(records), strict=True):
        if replace(read, lab=yarn.lab, number=yarn.number) != yarn:
            raise LoomError(f"the yarn {yarn.name!r} has spaces round its name")
    return tuple(yarn_entries)
