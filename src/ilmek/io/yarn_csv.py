"""The yarn bill as CSV: one line per yarn."""

from collections.abc import Sequence
from pathlib import Path

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.yarn import Yarn
from ilmek.io.csv_cells import csv_rows
from ilmek.units import g

COLUMNS = ("yarn", "use", "srgb", "count", "knots", "length [m]", "mass [g]", "to buy [g]", "hanks", "lots")
"""The heading; the price with its currency follows, empty where it is not known."""


def write_yarn_csv(path: Path, bill: YarnBill, yarns: tuple[Yarn, ...]) -> None:
    """Write the bill in UTF-8, lengths to 0.1 m and masses to 0.1 g."""
    colours = {yarn.name: yarn.hex for yarn in yarns}
    rows: list[Sequence[object]] = [(*COLUMNS, f"price [{bill.currency}]")]
    for need in bill.needs:
        price = "" if need.price is None else f"{need.price:.2f}"
        colour = colours[need.name] if need.use == "pile" else ""
        amounts = (f"{need.length:.1f}", f"{need.mass / g:.1f}", f"{need.to_buy / g:.1f}")
        rows.append((need.name, need.use, colour, need.count, need.knots or "", *amounts, need.hanks, need.lots, price))
    path.write_text(csv_rows(rows), encoding="utf-8")
