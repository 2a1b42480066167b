"""Carpets: sizes, quality, yarn, colour, chart, yarn bill.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "YarnBill": "ilmek.carpet.bill",
    "yarn_bill": "ilmek.carpet.bill",
    "Chart": "ilmek.carpet.chart",
    "make_chart": "ilmek.carpet.chart",
    "srgb_to_lab": "ilmek.carpet.colour",
    "ciede2000": "ilmek.carpet.colour_difference",
    "Quality": "ilmek.carpet.quality",
    "parse_quality": "ilmek.carpet.quality",
    "CarpetSize": "ilmek.carpet.sizes",
    "parse_size": "ilmek.carpet.sizes",
    "Yarn": "ilmek.carpet.yarn",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.carpet.bill import YarnBill as YarnBill
    from ilmek.carpet.bill import yarn_bill as yarn_bill
    from ilmek.carpet.chart import Chart as Chart
    from ilmek.carpet.chart import make_chart as make_chart
    from ilmek.carpet.colour import srgb_to_lab as srgb_to_lab
    from ilmek.carpet.colour_difference import ciede2000 as ciede2000
    from ilmek.carpet.quality import Quality as Quality
    from ilmek.carpet.quality import parse_quality as parse_quality
    from ilmek.carpet.sizes import CarpetSize as CarpetSize
    from ilmek.carpet.sizes import parse_size as parse_size
    from ilmek.carpet.yarn import Yarn as Yarn
