"""Files for other programs, read by what shares nothing with ilmek: WIF by configparser, indexed TIFF by Pillow."""

from configparser import ConfigParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from ilmek.carpet.chart import Chart
from ilmek.carpet.mounting import mounting
from ilmek.io.chart.formats import FORMATS, read_chart
from ilmek.io.yarn_file import default_yarns

CHART = Chart(
    np.random.default_rng(38).integers(0, 3, (12, 9)),
    default_yarns()[:3],
    "9x12cm",
    "10x10/dm",
    "symmetric",
    creel=(5, 0, 9),
)


def test_the_ground_weave_is_read_back(tmp_path: Path) -> None:
    """The drawdown, threading × tie-up × treadling, is plain weave: each warp is lifted by every second pick alone."""
    FORMATS["wif"].save(tmp_path / "a.wif", CHART)
    file = ConfigParser()
    assert file.read(tmp_path / "a.wif", encoding="ascii")
    assert file["WIF"]["Version"] == "1.1"
    assert {name.upper() for name in file["CONTENTS"]} == set(file.sections()) - {"WIF", "CONTENTS"}
    warps, picks = (int(file[name]["Threads"]) for name in ("WARP", "WEFT"))
    made = mounting(CHART)
    assert (warps, picks) == (2 * 9 + made.selvedge_warps, 2 * 12)
    assert float(file["WARP"]["Spacing"]) * warps / 100 == pytest.approx(made.width, rel=1e-5)
    threading = np.array([int(file["THREADING"][str(warp)]) for warp in range(1, warps + 1)])
    lifted = [int(file["TIEUP"][file["TREADLING"][str(pick)]]) for pick in range(1, picks + 1)]
    drawdown = np.array(lifted)[:, np.newaxis] == threading
    assert (drawdown ^ (np.indices(drawdown.shape).sum(0) % 2 == 1)).all()


@pytest.mark.parametrize("name", ["bmp", "tiff"])
def test_the_index_of_a_pixel_is_the_position_in_the_creel(name: str, tmp_path: Path) -> None:
    file = tmp_path / f"a.{name}"
    FORMATS[name].save(file, CHART)
    with Image.open(file) as picture:
        assert picture.mode == "P"
        assert (np.array(picture) == np.array(CHART.creel)[CHART.knots]).all()
        colours = np.array(picture.convert("RGB"))
    assert (colours == np.array([yarn.srgb for yarn in CHART.yarns])[CHART.knots]).all()


def test_oxs_is_the_same_chart_again(tmp_path: Path) -> None:
    FORMATS["oxs"].save(tmp_path / "a.oxs", CHART)
    again, _ = read_chart(tmp_path / "a.oxs")
    assert (again.knots == CHART.knots).all()
    assert again.yarns == CHART.yarns
