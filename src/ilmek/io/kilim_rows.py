"""The rows of a kilim to weave by as text: a header, then the rows from the first that is woven, read from the left.

    ilmek-kilim 1
    ...
    yarn A #8c2d2a madder
    5: 12A|3B v 40A        row 5, with three bobbins: 12 cells of A, an open slit, 3 of B, dovetailed with 40 of A
    6: 2· 51A 2·           two cells outside of the shape, which no weft crosses, 51 of A, and two outside again

Every row has the picks that the header states, and each run is woven with all of them.
"""

from collections.abc import Iterator
from pathlib import Path

from ilmek.carpet.kilim import DOVETAIL, INTERLOCK, SLIT, borders, joined, row_runs
from ilmek.carpet.kilim_cloth import KilimCloth
from ilmek.errors import printable
from ilmek.io.chart.symbols import NO_SIGN, signs_of_codes, symbols
from ilmek.sentences import Sentence, in_language, noun, translated

MAGIC = "ilmek-kilim 1"
"""First line: name and version of the format."""

SIGNS = {SLIT: "|", DOVETAIL: " v ", INTERLOCK: " x ", "": " "}
"""What stands between two runs; a blank at the outline of the shape."""


def write_kilim_rows(path: Path, cloth: KilimCloth, language: str) -> None:
    """Write the rows of a kilim; language: of the comments and of the yarns' names."""
    with in_language(language, "kilim"):
        lines = [*_header(cloth), *_rows(cloth)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _header(cloth: KilimCloth) -> list[str]:
    chart, params = cloth.chart, cloth.params
    yarns = [
        f"yarn {sign} {yarn.hex} {' '.join(printable(translated(noun(yarn.name))).split())}"
        for sign, yarn in zip(symbols(chart.yarns), chart.yarns, strict=True)
    ]
    about = [Sentence("kilim.rows", picks=params.step), Sentence("kilim.joins")]
    if chart.cells is not None:
        about += [Sentence("rows.text-plain", sign=NO_SIGN)]
    return [
        MAGIC,
        *(f"# {translated(sentence)}" for sentence in about),
        f"size {chart.size.width!r} {chart.size.length!r}",
        f"warps {params.warps!r}",
        f"picks {params.picks!r}",
        f"step {params.step}",
        f"join {params.join}",
        f"rows {chart.rows}",
        f"columns {chart.columns}",
        *yarns,
        "",
    ]


def _rows(cloth: KilimCloth) -> Iterator[str]:
    chart, signs = cloth.chart, signs_of_codes(cloth.chart.yarns)
    joints = joined(chart.knots, cloth.params)
    for number in range(1, chart.rows + 1):
        row = chart.rows - number
        text, met = f"{number}: ", borders(chart.knots[row : row + 1])[0]
        for run in row_runs(chart.knots[row], joints[row]):
            if run.first:
                text += SIGNS[cloth.params.join if joints[row][run.first - 1] else SLIT if met[run.first - 1] else ""]
            sign = signs[run.yarn]
            text += f"{run.cells}{':' if sign[0].isdigit() else ''}{sign}"
        yield text
