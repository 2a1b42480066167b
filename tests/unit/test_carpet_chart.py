"""Chart and yarn bill: picture in, knots, statistics and yarn out."""

from dataclasses import replace

import numpy as np
import pytest

from ilmek.carpet.bill import YarnBill, yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.chart_reading import ChartReading
from ilmek.carpet.ground import GroundParams, sinuous_length
from ilmek.carpet.palette_rules import PaletteParams
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import Quality, parse_quality
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.elements.carpet_yarns import CarpetYarnParams
from ilmek.elements.knot_kinds import asymmetric_wrap, parse_knot, symmetric_wrap
from ilmek.errors import CarpetError, PictureError, YarnError
from ilmek.io.yarn_file import yarns_from_records
from ilmek.jobs.yarn_choice import yarn_notes
from ilmek.progress import Progress

SIZE, QUALITY = CarpetSize(0.6, 0.9), Quality(1000.0, 1000.0)


def wools(*colours: str, price: float | None = 20.0) -> tuple[Yarn, ...]:
    return yarns_from_records([{"name": c, "srgb": c, "nm": 2.5, "ply": 2, "price": price} for c in colours])


YARNS = wools("9e2b25", "1b2442", "efe6d0", "c0872b", "7f8b5b", "34568b", "1d1815", "c9807b", "5c3d28", "b98f5e")


def medallion(height: int = 900, width: int = 600) -> np.ndarray:
    """Field, medallion, corners and borders with abrash and grain."""
    y, x = np.mgrid[-1 : 1 : height * 1j, -1 : 1 : width * 1j]
    radius, angle = np.hypot(x * 2 / 3, y), np.arctan2(y, x)
    border = np.minimum((1 - np.abs(x)) * 2 / 3, 1 - np.abs(y))
    rgb = np.full((height, width, 3), (150.0, 48.0, 40.0))
    rgb[np.hypot(1 - np.abs(x), 1 - np.abs(y)) < 0.6] = (42, 62, 105)
    rgb[radius < 0.4 + 0.05 * np.cos(8 * angle)] = (226, 214, 186)
    rgb[radius < 0.34 + 0.05 * np.cos(8 * angle)] = (38, 48, 84)
    rgb[radius < 0.14] = (190, 130, 60)
    rgb[border < 0.2] = (224, 208, 176)
    rgb[(border < 0.17) & (border > 0.05)] = (70, 40, 32)
    rng = np.random.default_rng(1)
    abrash = 5 * np.sin(np.arange(height) / 31)[:, None, None]
    return np.clip(np.rint(rgb + abrash + rng.normal(scale=5.0, size=rgb.shape)), 0, 255).astype(np.uint8)


@pytest.fixture(scope="module")
def chart() -> Chart:
    return make_chart(medallion(), SIZE, QUALITY, YARNS)


def test_counts_are_of_all_knots(chart: Chart) -> None:
    assert sum(chart.counts) == chart.knots.size
    assert chart.counts[0] == np.count_nonzero(chart.knots == 0)
    assert chart.colours == sum(count > 0 for count in chart.counts)


def test_same_picture_same_chart(chart: Chart) -> None:
    assert np.array_equal(make_chart(medallion(), SIZE, QUALITY, YARNS).knots, chart.knots)


def test_top_of_the_picture_is_row_0() -> None:
    rgb = np.zeros((40, 20, 3), dtype=np.uint8)
    rgb[:20] = (255, 255, 255)
    knots = make_chart(rgb, CarpetSize(0.2, 0.4), Quality(100.0, 100.0), wools("ffffff", "000000")).knots
    assert knots[0].tolist() == [0] * 20
    assert knots[39].tolist() == [1] * 20


def test_best_colours_keep_the_order_of_the_list() -> None:
    chart = make_chart(
        medallion(90, 60),
        CarpetSize(0.6, 0.9),
        Quality(100.0, 100.0),
        YARNS,
        palette=PaletteParams(colours=4),
        knot="Persian",
    )
    places = [YARNS.index(yarn) for yarn in chart.yarns]
    assert len(places) == 4
    assert places == sorted(places)
    assert chart.knot == "asymmetric"


def test_progress_rises_to_one() -> None:
    shares: list[float] = []
    make_chart(
        medallion(90, 60),
        CarpetSize(0.5, 0.7),
        Quality(400.0, 400.0),
        YARNS,
        progress=Progress(lambda _, share: shares.append(share)),
    )
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert len(shares) >= 3


def test_refused_in_words() -> None:
    rgb = medallion(9, 6)
    with pytest.raises(YarnError, match="1 yarn"):
        make_chart(rgb, SIZE, QUALITY, YARNS[:1])
    with pytest.raises(YarnError, match="2 to 10"):
        make_chart(rgb, SIZE, QUALITY, YARNS, palette=PaletteParams(colours=11))
    with pytest.raises(CarpetError, match="did you mean symmetric"):
        make_chart(rgb, SIZE, QUALITY, YARNS, knot="symetric")
    with pytest.raises(PictureError, match="empty"):
        make_chart(rgb[:0], SIZE, QUALITY, YARNS)


def test_trade_names_of_knots() -> None:
    assert {parse_knot(name) for name in ("Turkish", "ghiordes", "GÖRDES", "double", "symmetric")} == {"symmetric"}
    assert {parse_knot(name) for name in ("persian", "Senneh", "senna", "single")} == {"asymmetric"}


def test_wraps_against_their_limits() -> None:
    # A yarn without thickness lies straight between the warps; round touching warps it has no straight part.
    assert symmetric_wrap(2e-3, 0.0) == asymmetric_wrap(2e-3, 0.0) == 2e-3
    assert asymmetric_wrap(2e-3, 1e-3) == pytest.approx(3 * np.pi * 1e-3)
    assert asymmetric_wrap(2e-3, 1.2e-3) == pytest.approx(3 * np.pi * 1.2e-3)
    assert symmetric_wrap(2e-3, 1e-3) == pytest.approx(2e-3 + 3 * np.pi * 1e-3)


def test_asymmetric_wrap_is_the_length_of_its_path() -> None:
    """The path traced as points: down the first warp, under it, across, round the second, up between them."""
    pitch, r = 2.0, 0.6
    alpha = np.arcsin(2 * r / pitch)
    under = np.linspace(-np.pi, -np.pi / 2 + alpha, 20_001)
    over = np.linspace(np.pi / 2 + alpha, np.pi / 2 + alpha - (3 * np.pi / 2 + alpha), 20_001)
    path = np.concatenate([-pitch / 2 + r * np.exp(1j * under), pitch / 2 + r * np.exp(1j * over)])
    assert path[-1] == pytest.approx(pitch / 2 - r)
    assert np.abs(np.diff(path)).sum() == pytest.approx(asymmetric_wrap(pitch, r), rel=1e-6)


def test_knot_length_grows_by_what_is_said() -> None:
    plain = knot_length("symmetric", QUALITY, 0.2e-3)
    assert knot_length("symmetric", QUALITY, 0.2e-3, PileParams(pile_height=9e-3)) == pytest.approx(plain + 2e-3)
    assert knot_length("symmetric", QUALITY, 0.2e-3, PileParams(cut_waste=2e-3)) == pytest.approx(plain + 2e-3)
    assert knot_length("symmetric", QUALITY, 0.2e-3, PileParams(calibration=1.1)) == pytest.approx(1.1 * plain)
    assert knot_length("asymmetric", QUALITY, 0.2e-3) < plain


def test_sinuous_weft_is_the_length_of_its_curve() -> None:
    x = np.linspace(0, 0.1, 2_000_001)
    curve = np.abs(np.diff(x + 1j * 0.4e-3 * np.sin(np.pi * x / 2e-3))).sum()
    assert sinuous_length(0.1, 2e-3, 0.4e-3) == pytest.approx(curve, rel=1e-6)


def test_bill_adds_up(chart: Chart) -> None:
    bill = yarn_bill(chart, YarnPlanParams(pile_height=8e-3))
    per_knot = knot_length("symmetric", QUALITY, 0.8e-3)
    assert isinstance(bill, YarnBill)
    assert bill.knots == chart.knots.size
    assert [need.name for need in bill.ground] == ["warp", "straight weft", "sinuous weft", "ends", "selvedges"]
    assert sum(need.length for need in bill.pile) == pytest.approx(chart.knots.size * per_knot)
    assert bill.pile_mass == pytest.approx(chart.knots.size * per_knot * 0.8e-3)
    prices = {"selvedges": 20.0} | dict.fromkeys(("warp", "straight weft", "sinuous weft", "ends"), 8.0)
    ground = sum(prices[need.name] * need.mass for need in bill.ground)
    assert bill.price == pytest.approx(1.1 * (20 * bill.pile_mass + ground))
    assert bill.mass == pytest.approx(sum(need.mass for need in bill.needs))


def test_bill_of_the_ground(chart: Chart) -> None:
    yarns = CarpetYarnParams(warp_density=1e-3, straight_weft_density=2e-3, sinuous_weft_density=0.5e-3)
    params = GroundParams(weft_share=0.0, yarns=yarns)
    warp, straight, sinuous, ends, _ = yarn_bill(chart, ground=params).ground
    assert warp.length == pytest.approx((2 * 600 + 8) * (0.9 / 0.99 * 1.03 + 0.6))
    across = 0.6 + 8 * 0.5e-3  # the wefts run over the selvedges
    assert straight.length == pytest.approx(900 * (across + 0.02)) == sinuous.length
    assert ends.length == pytest.approx(2 * 24 * (across + 0.02))  # 20 mm of picks of 0.835 mm, at each end
    assert (warp.mass, straight.mass) == pytest.approx((warp.length * 1e-3, straight.length * 2e-3))
    assert yarn_bill(chart).ground[2].length > straight.length


def test_bill_without_prices_or_knots_of_a_yarn() -> None:
    rgb = np.zeros((10, 10, 3), dtype=np.uint8)
    yarns = wools("000000", "ffffff", price=None)
    chart = make_chart(rgb, CarpetSize(0.1, 0.1), Quality(100.0, 100.0), yarns)
    bill = yarn_bill(chart)
    assert [need.name for need in bill.pile] == ["000000"]
    (need,) = bill.pile
    assert need.price == pytest.approx(20 * need.to_buy)  # wool in EUR
    lira = yarn_bill(chart, YarnPlanParams(currency="TRY", warp_price=300, weft_price=300))
    assert (lira.price, lira.pile[0].price, lira.currency) == (None, None, "TRY")
    assert all(line.price for line in lira.ground if line.use != "selvedge")


def test_prices_of_the_shipped_wools_give_way_to_a_currency_and_a_price() -> None:
    shipped = wools("000000", "ffffff", price=24.0)
    assert YarnPlanParams().priced(shipped) == tuple(shipped)
    for plan in (YarnPlanParams(currency="TRY"), YarnPlanParams(pile_price=30.0)):
        assert [yarn.price for yarn in plan.priced(shipped)] == [None, None]


def test_a_chart_that_is_read_otherwise_keeps_its_tally() -> None:
    knots = np.random.default_rng(2).integers(0, 3, (20, 20))
    yarns = yarns_from_records(
        [{"name": name, "srgb": code} for name, code in zip("abc", ("#111111", "#888888", "#eeeeee"), strict=True)]
    )
    chart = Chart(knots, yarns, parse_size("20x20cm"), parse_quality("10x10/dm"), "symmetric")
    tally = chart.tally()
    again = chart.read_as(ChartReading("flat", "as a test", 1.0, 0.5))
    assert again.tally() is tally
    assert again.reading.reason == "as a test"
    assert again.counts == tuple(np.bincount(knots.ravel(), minlength=3))


def test_a_dyed_yarn_that_no_knot_has_is_not_counted() -> None:
    """The reading may propose a shade whose last knots are then woven in another."""
    reading = ChartReading("photo", "as a test", 1.0, 0.5, dyed=("1b2442", "efe6d0"))
    knots, size, quality = np.array([[0, 1], [1, 0]]), parse_size("2x2cm"), parse_quality("10x10/dm")
    chart = Chart(knots, YARNS, size, quality, "symmetric", reading)
    assert (chart.colours, chart.dyed) == (2, 1)
    assert yarn_notes(chart)[0].startswith("1 of 2 yarns dyed to order")
    assert chart.read_as(replace(reading, dyed=("efe6d0",))).dyed == 0
