"""Pictures of packages whose colours are lost by a nearest yarn for each colour alone, and others of their kinds."""

from pathlib import Path

import numpy as np
import pytest
from drawn_colours import PICTURES, blocks, charted, chroma, colours_of, edge_share, saved, yarn_at
from skimage import data
from skimage.color import deltaE_ciede2000, rgb2lab

from ilmek.carpet.picture_points import hex_colour
from ilmek.jobs.chart import ChartResult, chart_results

SKIMAGE = Path(data.__file__).parent
RED, GREEN, WHITE, BLACK, PURPLE = (255, 0, 0), (0, 255, 0), (255, 255, 255), (0, 0, 0), (150, 0, 200)


def failed(made: ChartResult) -> list[str]:
    return [check.name for check in made.checks if not check.ok]


def differences(made: ChartResult) -> tuple[float, float]:
    """Mean CIEDE2000 of the chart, and of a nearest yarn for each colour."""
    return made.chart.reading.mean_delta_e, made.chart.reading.least_delta_e


@pytest.mark.parametrize(("name", "size"), [("rubik", "98x98cm"), ("smarties", "104x90cm"), ("matrix", "130x73cm")])
def test_a_drawing_without_a_list_has_its_own_shades(name: str, size: str) -> None:
    made = charted(PICTURES / f"{name}.png", size)
    assert made.chart.reading.mean_delta_e < 1.0  # the highlights of the sweets are no colours of the drawing
    assert not failed(made)
    assert not made.chart.reading.lost


def test_the_faces_of_a_cube_stay_apart_on_the_shelf() -> None:
    made = charted(PICTURES / "rubik.png", "98x98cm", yarns="wool")
    assert (yarn_at(made, 0.03, 0.03), yarn_at(made, 0.15, 0.5)) == ("ivory", "sage green")
    assert len({one["yarn"] for one in chart_results(made)["assignment"]}) == 5
    mean, least = differences(made)
    assert mean - least < 1.1
    assert not failed(made)


def test_every_sweet_is_seen_on_the_shelf() -> None:
    made = charted(PICTURES / "smarties.png", "104x90cm", yarns="wool")
    ground = next(one["yarn"] for one in chart_results(made)["assignment"] if one["colour"] == "#fefefe")
    sweets = [one for one in chart_results(made)["assignment"] if one["knots"] > 400 and one["yarn"] == ground]
    assert [one["colour"] for one in sweets] == ["#fefefe"]
    mean, least = differences(made)
    assert mean - least < 1.1


@pytest.mark.parametrize("colours", [[GREEN, RED, PURPLE], [(0, 255, 255), (255, 0, 255), (255, 200, 0)]])
def test_discs_of_strong_colours_are_seen_on_the_shelf(tmp_path: Path, colours: list[tuple[int, int, int]]) -> None:
    picture = saved(tmp_path, "discs", blocks(colours, WHITE))
    made = charted(picture, "80x27cm", yarns="wool", read="flat")
    places = [yarn_at(made, (2 * number + 1) / 6, 0.5) for number in range(3)]
    assert len({yarn_at(made, 0.01, 0.02), *places}) == 4
    own = charted(picture, "80x27cm", read="flat")
    assert own.chart.reading.mean_delta_e < 0.01


def test_lost_tones_of_a_phantom_fail_and_are_named_with_their_cure() -> None:
    shelf, own = (charted(PICTURES / "phantom.png", "98x98cm", yarns=yarns) for yarns in ("wool", None))
    assert failed(shelf) == ["colours of the drawing lost"]
    (lost,) = chart_results(shelf)["lost"]
    assert (lost["colour"], lost["share"] > 0.05) == ("#333333", True)
    assert "#333333" in lost["cure"]
    assert not failed(own)
    assert yarn_at(own, 0.36, 0.5) != yarn_at(own, 0.5, 0.45)


@pytest.mark.parametrize(("ground", "drawn"), [((0, 0, 0), (48, 48, 48)), ((255, 250, 240), (196, 196, 196))])
def test_a_tone_that_the_list_does_not_have_is_a_failed_check(
    tmp_path: Path, ground: tuple[int, int, int], drawn: tuple[int, int, int]
) -> None:
    picture = saved(tmp_path, "tones", blocks([drawn, drawn], ground))
    (tmp_path / "two.csv").write_text("name,srgb\nnear-black,#1d1815\nivory,#efe6d0\nred,#9e2b25\n")
    made = charted(picture, "60x30cm", yarns=tmp_path / "two.csv", read="flat")
    assert failed(made) == ["edges of the picture kept", "colours of the drawing lost"]
    assert not failed(charted(picture, "60x30cm", read="flat"))
    accepted = charted(picture, "60x30cm", yarns=tmp_path / "two.csv", read="flat", least_edges="0%", most_lost="100%")
    assert not failed(accepted)


def test_the_lines_of_a_logo_are_seen_on_the_shelf() -> None:
    made = charted(SKIMAGE / "logo.png", "100x100cm", "25x25/dm", yarns="wool")
    yarns = {one["colour"]: one["yarn"] for one in chart_results(made)["assignment"]}
    assert (yarns["#96c84b"], yarns["#6c9136"]) == ("sage green", "dark green")
    assert not failed(made)
    mean, least = differences(made)
    assert mean - least < 1.1


def test_a_colour_takes_the_yarn_that_is_given(tmp_path: Path) -> None:
    given = {"yarns": "wool", "map": "#6c9136=near-black; #ff7f1f=madder red"}
    made = charted(SKIMAGE / "logo.png", "100x100cm", **given)
    yarns = {one["colour"]: one["yarn"] for one in chart_results(made)["assignment"]}
    assert yarns["#6c9136"] == "near-black"
    own = charted(SKIMAGE / "logo.png", "100x100cm", map="#6c9136=dark green")
    yarns = {one["colour"]: one["yarn"] for one in chart_results(own)["assignment"]}
    assert yarns["#6c9136"] == "dark green"
    assert own.chart.reading.mean_delta_e < 1.5


@pytest.mark.parametrize("name", ["camera", "brick", "page"])
@pytest.mark.parametrize("halftone", ["0%", "100%"])
def test_grey_photos_are_neutral(name: str, halftone: str) -> None:
    for yarns in (None, "wool"):
        made = charted(SKIMAGE / f"{name}.png", "60x60cm", yarns=yarns, halftone=halftone, read="photo")
        assert chroma(made) < 12.5
        assert len(made.chart.used) >= (2 if yarns and name == "brick" else 3)  # all tones of brick lie between two
    tinted = charted(SKIMAGE / f"{name}.png", "60x60cm", yarns="wool", neutral="no", halftone="100%", read="photo")
    assert chroma(tinted) > 15


@pytest.mark.parametrize(("across", "down"), [(6, 5), (9, 5)])
def test_a_map_of_many_colours_keeps_them_all_or_says_which_are_lost(tmp_path: Path, across: int, down: int) -> None:
    """Provinces with lines between them: no two colours touch. The wools have not so many greens."""
    steps = np.linspace(0, 255, 4).astype(int)
    solid = [(r, g, b) for g in steps for r in steps for b in steps if 90 < r + g + b < 700]
    cells = np.array(solid)[np.linspace(0, len(solid) - 1, across * down).astype(int)].reshape(down, across, 3)
    drawn = np.zeros((down * 20 + 4, across * 20 + 4, 3), dtype=np.uint8)
    drawn[4:, 4:] = cells.repeat(20, 0).repeat(20, 1)
    drawn[np.arange(len(drawn)) % 20 < 4] = drawn[:, np.arange(drawn.shape[1]) % 20 < 4] = 0
    picture, size = saved(tmp_path, "map", drawn), f"{2 * (across * 20 + 4)}x{2 * (down * 20 + 4)}cm"
    own, wool = (charted(picture, size, "5x5/dm", yarns=yarns, read="flat") for yarns in (None, "wool"))
    assert not failed(own)
    lab = rgb2lab(cells.reshape(1, -1, 3).astype(np.uint8))[0]
    apart = deltaE_ciede2000(lab[:, None], lab[None]) >= 5.0
    of_own, of_wool = (made.chart.knots[12::20, 12::20].ravel() for made in (own, wool))
    assert np.all((of_own[:, None] != of_own[None])[apart])
    assert failed(wool) == ["colours of the drawing lost"]
    lost = {one["colour"] for one in chart_results(wool)["lost"]}
    is_lost = np.array([hex_colour(colour) in lost for colour in cells.reshape(-1, 3).tolist()])
    assert np.all((is_lost[:, None] | is_lost[None])[apart & (of_wool[:, None] == of_wool[None])])
    assert not is_lost[np.bincount(of_wool)[of_wool] == 1].any()
    check = next(one for one in wool.checks if one.name == "colours of the drawing lost")
    assert check.value == pytest.approx(sum(one["share"] for one in chart_results(wool)["lost"]))
    assert all(f"{lost.hex}, " in check.cure for lost in wool.chart.reading.lost[:2])


@pytest.mark.parametrize("turned", [False, True])
def test_grey_ramps_are_neutral(tmp_path: Path, turned: bool) -> None:
    ramp = np.tile(np.linspace(20, 240, 300), (200, 1)).astype(np.uint8)
    picture = saved(tmp_path, "ramp", np.stack([ramp.T if turned else ramp] * 3, axis=-1))
    made = charted(picture, "40x40cm", yarns="wool", read="photo", fit="stretch")
    assert {made.chart.yarns[yarn].name for yarn in made.chart.used} == {"ivory", "grey", "near-black"}


def test_flags_are_red(tmp_path: Path) -> None:
    swiss = np.full((64, 64, 3), RED)
    swiss[26:38, 12:52] = swiss[12:52, 26:38] = WHITE
    danish = np.full((56, 74, 3), (200, 16, 46))
    danish[24:32, :] = danish[:, 24:32] = WHITE
    flags = [(PICTURES / "tr.png", "113x85cm", 0.2, 0.8), (saved(tmp_path, "ch", swiss), "64x64cm", 0.05, 0.05)]
    flags.append((saved(tmp_path, "dk", danish), "74x56cm", 0.05, 0.05))
    for picture, size, x, y in flags:
        made = charted(picture, size)
        rows, columns = made.chart.knots.shape
        red, green, blue = colours_of(made)[int(y * rows), int(x * columns)].tolist()
        assert red > 190
        assert max(green, blue) < 75
        assert made.chart.reading.mean_delta_e < 1.5


def test_a_photo_of_tones_between_two_yarns_is_no_blank_carpet(tmp_path: Path) -> None:
    made = charted(PICTURES / "star.png", "98x98cm", yarns="wool", halftone="0%")
    assert not failed(made)
    y, x = np.mgrid[:150, :150] / 150
    waves = 128 + 14 * np.sign(np.sin(24 * x + 9 * y)) + 3 * np.sin(40 * y)
    rings = 150 + 14 * np.sign(np.sin(30 * np.hypot(x - 0.5, y - 0.5))) + 3 * np.sin(40 * x)
    for name, grey in (("waves", waves), ("rings", rings)):
        picture = saved(tmp_path, name, np.stack([grey] * 3, axis=-1))
        made = charted(picture, "60x60cm", "25x25/dm", yarns="wool", read="photo", halftone="0%")
        assert "tones stretched" in made.chart.reading.reason
        assert not failed(made)
        assert edge_share(np.asarray(np.stack([grey] * 3, axis=-1), dtype=np.uint8), colours_of(made), 8.0) > 0.9


def test_a_drawing_in_the_colours_of_wools_is_tied_in_them() -> None:
    shelf, own = (charted(Path("examples/medallion.png"), "60x90cm", yarns=yarns) for yarns in ("wool", None))
    assert np.array_equal(shelf.chart.knots, own.chart.knots)
    assert shelf.chart.yarns == own.chart.yarns
    assert shelf.bill == own.bill
