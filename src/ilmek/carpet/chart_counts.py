"""What is counted of a chart: its statistics and its yarns, by modules that read charts and stand above them."""

from importlib import import_module
from typing import TYPE_CHECKING

from ilmek.report.shown import Shown

if TYPE_CHECKING:
    from ilmek.carpet.bill import YarnBill
    from ilmek.carpet.statistics import ChartStatistics


class ChartCounts(Shown):
    """The statistics and the bill of a chart."""

    __slots__ = ()

    @property
    def statistics(self) -> "ChartStatistics":
        """Changes of yarn by row, the hardest rows, small patches."""
        made: ChartStatistics = import_module("ilmek.carpet.statistics").chart_statistics(self)
        return made

    def bill(self) -> "YarnBill":
        """The yarns to buy, by the usual allowances; `yarn_bill` takes others."""
        made: YarnBill = import_module("ilmek.carpet.bill").yarn_bill(self)
        return made
