"""Published carpet numbers: sizes, densities and the yarn of worked examples."""

from dataclasses import replace

import numpy as np
import pytest

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.design import knot_grid
from ilmek.carpet.ground import GroundParams
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import Quality, parse_quality, write_quality
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.carpet.usual_pile import MassBand, with_counts
from ilmek.carpet.washing import WashParams
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.elements.carpet_yarns import CarpetYarnParams
from ilmek.elements.yarns import usual_warp_density
from ilmek.units import cm, g, mm


@pytest.mark.parametrize(
    ("name", "length", "width"),
    [
        ("küçük yastık", 40, 25),
        ("yastık", 100, 60),
        ("çeyrek", 135, 90),
        ("seccade", 180, 120),
        ("seccade-130x200", 200, 130),
        ("karyola", 220, 150),
        ("kelle", 300, 200),
    ],
)
def test_sizes_of_table_1_1(name: str, length: float, width: float) -> None:
    """Thesis, Table 1.1: length × width in cm."""
    size = parse_size(name)
    assert (size.length, size.width) == (length / 100, width / 100)


def test_thesis_loom_weaves_a_very_coarse_seccade() -> None:
    """Thesis: 600 warps at 2 mm are 300 knots; 25 × 25 per dm is 62,500 per m²; 1.2 × 1.8 m has 135,000 knots."""
    quality = parse_quality("25x25/dm")
    assert quality.knots_per_area == 62_500
    assert quality.warp_pitch == 2 * mm
    assert knot_grid(parse_size("seccade"), quality) == (450, 300)


@pytest.mark.parametrize(
    ("raj", "density"), [(30, 183_673), (40, 326_531), (50, 510_204), (60, 734_694), (70, 1_000_000)]
)
def test_raj_per_gereh_of_7_cm(raj: int, density: int) -> None:
    """Knots per m² of a raj (tekstilbilgi.net has 326,528 for 40, from rounded steps)."""
    quality = parse_quality(f"{raj} raj")
    assert round(quality.knots_per_area) == density
    kpsi = (raj / 7 * 2.54) ** 2  # kibek.de, rugrag.com
    assert float(write_quality(quality, "kpsi").removesuffix("kpsi")) == pytest.approx(kpsi, rel=1e-12)


def test_india_9_60_is_133_knots_per_square_inch() -> None:
    """A·B/4.05 (little-persia.com); rugrag.com rounds to A·B/4."""
    assert write_quality(parse_quality("9/60"), "kpsi", digits=3) == "133kpsi"
    assert float(write_quality(parse_quality("9/60"), "kpsi", digits=12)[:-4]) == pytest.approx(9 * 60 / 4.05)


def test_chinese_line_is_knots_per_foot() -> None:
    """kpsi = L²/144 (rugrag.com): 90 line is 56.25."""
    assert write_quality(parse_quality("90line"), "kpsi") == "56.25kpsi"


def test_density_in_two_notations() -> None:
    """100,000 per m² = 1000 per dm² = 65 per square inch (Wikipedia, Knot density)."""
    quality = parse_quality("100000/m2")
    assert write_quality(quality, "dm2") == "1000/dm2"
    assert write_quality(quality, "kpsi", digits=2) == "65kpsi"


@pytest.mark.parametrize(
    ("text", "density"), [("60x60/dm", 360_000), ("40x40/dm", 160_000), ("26x33/dm", 85_800), ("18x18/cm", 3_240_000)]
)
def test_turkish_densities(text: str, density: float) -> None:
    assert parse_quality(text).knots_per_area == pytest.approx(density, rel=1e-15)


def worked_example() -> Chart:
    """40 raj of 6.5 cm, 104 x 156 cm, in one wool."""
    size, quality = parse_size("104x156cm"), parse_quality("40raj/6.5cm")
    wool = Yarn("wool", (0, 0, 0), (0.0, 0.0, 0.0), price=20.0)
    knots = np.zeros(knot_grid(size, quality), dtype=np.uint8)
    return Chart(knots, with_counts((wool,), quality, "asymmetric"), size, quality, "asymmetric")


def test_raj_with_its_gereh_gives_the_knots_of_the_worked_example() -> None:
    """40 raj counted over the Tehran gereh of 6.5 cm: 640 x 960 = 614,400 knots; over 7 cm it would be 529,254."""
    chart = worked_example()
    assert (chart.columns, chart.rows, chart.knots.size) == (640, 960, 614_400)
    rows, columns = knot_grid(chart.size, parse_quality("40raj"))
    assert rows * columns == 529_254
    assert write_quality(chart.quality, "raj", gereh=0.065) == "40raj/6.5cm"


def test_pile_yarn_of_the_worked_example() -> None:
    """614,400 knots of 40 mm: 24,576 m, 15.1 km/m² (iran-carpet.com 1705).

    40 mm of so fine a carpet are mostly waste of the hand cut. The weaver measures them, and calibrates: once by the
    factor, once by the waste at each end, 12 to 13 mm.
    """
    chart = worked_example()
    plain = YarnPlanParams()
    geometric = yarn_bill(chart, plain).pile[0].length / chart.knots.size
    waste = plain.cut_waste + (40 * mm - geometric) / 2
    assert 12 * mm < waste < 13 * mm
    for plan in (replace(plain, calibration=40 * mm / geometric), replace(plain, cut_waste=waste)):
        (need,) = yarn_bill(chart, plan).pile
        assert need.knots == 614_400
        assert need.length == pytest.approx(24_576, rel=1e-12)
        assert need.length / (1.04 * 1.56) / 1e3 == pytest.approx(15.1, abs=0.05)
        assert need.mass == pytest.approx(24_576 * chart.yarns[0].linear_density)
        assert need.price == pytest.approx(1.1 * need.mass * 20.0)


def test_warp_of_the_worked_example() -> None:
    """640 knots need 1280 warps; in wool 8/3 they weigh 960 g (iran-carpet.com 1726) if each is 2.00 m long: the 1.56 m
    of the carpet and 44 cm for crimp and ends, within the `up to 60 cm` of the same source.
    """
    yarns, unwashed = CarpetYarnParams(warp="wool", warp_density=3 / 8 * g), WashParams(shrink_along=0.0)
    ground = GroundParams(crimp=0.0, selvedge_warps=0, yarns=yarns, washing=unwashed)
    plan = YarnPlanParams(fringe=0.1, loom_waste=0.24)
    warp = yarn_bill(worked_example(), plan, ground).ground[0]
    assert (warp.name, warp.length) == ("warp", pytest.approx(1280 * 2.00))
    assert warp.mass == pytest.approx(0.960)


@pytest.mark.parametrize(("raj", "count", "ply"), [(15, 3, 3), (20, 4, 3), (25, 5, 3), (30, 6, 3), (40, 8, 3)])
def test_wool_warp_counts_follow_one_law(raj: int, count: int, ply: int) -> None:
    """Nm/ply of wool warps by raj (iran-carpet.com 1804): 3/7 g/m for each mm of pitch gives all five."""
    assert usual_warp_density(parse_quality(f"{raj} raj").warp_pitch, "wool") == pytest.approx(ply / count * g)


@pytest.mark.parametrize(
    ("raj", "count", "ply"),
    [(15, 20, 24), (20, 20, 20), (25, 20, 18), (30, 20, 16), (40, 20, 12), (50, 20, 6), (60, 40, 6), (70, 40, 4)],
)
def test_cotton_warp_counts(raj: int, count: int, ply: int) -> None:
    """Ne/ply of cotton warps by raj (iran-carpet.com 1804): 590.5 tex for a strand of Ne 1."""
    assert usual_warp_density(parse_quality(f"{raj} raj").warp_pitch) == pytest.approx(0.5905 * ply / count * g)


@pytest.mark.parametrize(
    ("knots_per_dm", "pile_height", "count", "low", "high"), [(40, 6, 5.0, 25, 28), (35, 8, 4.0, 30, 35)]
)
def test_knot_length_within_the_hand_weavers_range(
    knots_per_dm: int, pile_height: float, count: float, low: float, high: float
) -> None:
    """25 to 28 mm at 40 knots per dm and 30 to 35 mm at 35 (az. Wikipedia); it names no pile: 6 and 8 mm here."""
    quality = Quality(10.0 * knots_per_dm, 10.0 * knots_per_dm)
    length = knot_length("symmetric", quality, 2 / count * g, PileParams(pile_height=pile_height * mm))
    assert low <= length / mm <= high


def test_knot_of_40_raj_with_the_waste_of_a_hand_cut() -> None:
    """40 mm at 40 raj (iran-carpet.com 1705) is a pile of 8 mm with 7 to 8 mm cut off each end."""
    quality = parse_quality("40raj")
    least, most = (knot_length("symmetric", quality, 0.25 * g, PileParams(cut_waste=c * mm)) / mm for c in (7, 8))
    assert least <= 40 <= most


@pytest.mark.parametrize("knot", ["symmetric", "asymmetric"])
@pytest.mark.parametrize(("density", "least", "most"), [(56_000, 4.5, 5.0), (80_000, 3.5, 4.25), (125_000, 2.5, 3.5)])
def test_mass_of_nepalese_carpets(density: float, least: float, most: float, knot: str) -> None:
    """60, 80 and 100 knots per square inch: 4.5-5.0, 3.5-4.25, 2.5-3.5 kg/m² (nepalcarpet.org).

    The plan has no number of these rows but the share of the ground that the pile fills; the symmetric knot is within
    10 % of the middle of each, and both knots are within each.
    """
    size, quality = CarpetSize(1.4, 2.0), parse_quality(f"{density}/m2")
    wool = with_counts((Yarn("wool", (0, 0, 0), (0.0, 0.0, 0.0)),), quality, knot)
    bill = yarn_bill(Chart(np.zeros(knot_grid(size, quality), dtype=np.uint8), wool, size, quality, knot))
    assert bill.band == MassBand(pytest.approx(least), pytest.approx(most))
    assert least <= bill.mass_per_area <= most
    if knot == "symmetric":
        assert bill.mass_per_area == pytest.approx((least + most) / 2, rel=0.10)


@pytest.mark.parametrize(("per_dm", "low", "high"), [(40, 25, 28), (35, 30, 35)])
def test_usual_knot_is_as_long_as_the_hand_weavers(per_dm: int, low: float, high: float) -> None:
    """25 to 28 mm at 40 knots per dm and 30 to 35 mm at 35 (az. Wikipedia), to 3 %, with the usual pile and count."""
    quality = Quality(10.0 * per_dm, 10.0 * per_dm)
    wool = with_counts((Yarn("wool", (0, 0, 0), (0.0, 0.0, 0.0)),), quality, "symmetric")[0]
    length = knot_length("symmetric", quality, wool.linear_density, YarnPlanParams().pile(quality))
    assert 0.97 * low <= length / mm <= 1.03 * high


def test_pazyryk_carpet() -> None:
    """3.62 m² at 347,000 knots per m²: 1,256,140 knots, 1.6976 mm from knot to knot (thesis, chapter 1)."""
    quality = parse_quality("347000/m2")
    assert 1 / quality.across / mm == pytest.approx(1.6976, abs=5e-5)
    side = (3.62) ** 0.5
    rows, columns = knot_grid(CarpetSize(side, side), quality)
    assert rows * columns == pytest.approx(1_256_140, rel=1e-3)
    assert parse_size("362x100cm").area == pytest.approx(3.62)
    assert parse_size("362x100cm").width / cm == pytest.approx(362)
