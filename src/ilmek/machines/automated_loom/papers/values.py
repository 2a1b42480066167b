"""What the papers of a loom read: values of its report by their names, and how much it works in a year."""

from typing import Any

from ilmek.machines.automated_loom.cost import rates_of
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.records import record
from ilmek.report import Report
from ilmek.report.document import UnknownResult


def value_of(report: Report, name: str) -> Any:
    """The value of a result by its dotted name [SI]. Raises UnknownResult."""
    return report[name]


def known(report: Report, name: str) -> Any:
    """The value of a result by its dotted name [SI]; None where this loom has none."""
    try:
        return report[name]
    except UnknownResult:
        return None


@record
class YearOfWork:
    """What a loom does in a year: rows, and knots of one head or weaver; and the years over which it is paid."""

    rows: float
    knots: float
    years: float


def year_of_work(loom: LoomDesign, report: Report) -> YearOfWork:
    """The work of a loom in a year, by the carpets that it weaves in one."""
    carpets: float = value_of(report, "carpets_per_year")
    each = loom.columns / max(loom.knotters, 1)
    return YearOfWork(carpets * loom.rows, carpets * loom.rows * each, rates_of(loom, loom.weavers).life)
