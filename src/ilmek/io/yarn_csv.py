"""The yarn bill as CSV: one line per yarn."""

from collections.abc import Sequence
from pathlib import Path

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.yarn import Yarn
from ilmek.io.csv_cells import csv_rows
from ilmek.units import g

COLUMNS = ("yarn", "use", "srgb", "knots", "length [m]", "mass [g]", "price")
"""The heading; price is empty if the list gives none."""


def write_yarn_csv(path: Path, bill: YarnBill, yarns: tuple[Yarn, ...]) -> None:
    """Write the bill in UTF-8, lengths to 0.1 m and masses to 0.1 g."""
    colours = {yarn.name: yarn.hex for yarn in yarns}
    rows: list[Sequence[object]] = [COLUMNS]
    for need in bill.needs:
        price = "" if need.price is None else f"{need.price:.2f}"
        colour = colours[need.name] if need.use == "pile" else ""
        rows.append(
            (need.name, need.use, colour, need.knots or "", f"{need.length:.1f}", f"{need.mass / g:.1f}", price)
        )
    path.write_text(csv_rows(rows), encoding="utf-8")
