"""Palette rules: kept and banned yarns, the number found, the least share, twins and proposed shades."""

import numpy as np
import pytest
from effort import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.carpet.colour import lab_to_srgb, srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.palette import Colours, distinct_colours, nearest_yarns
from ilmek.carpet.palette_rules import LEAST_GAIN, Palette, PaletteParams, choose_yarns, twin_yarns, yarn_names
from ilmek.carpet.proposal import match_shades, propose_shades
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.errors import ParameterError, YarnError
from ilmek.io.yarn_file import default_yarns

WOOL = default_yarns()
NAMES = tuple(yarn.name for yarn in WOOL)


def picture(seed: int, colours: int = 40) -> Colours:
    """Random colours with random areas."""
    rng = np.random.default_rng(seed)
    shown = rng.integers(0, 256, (colours, 3), dtype=np.uint8)
    return distinct_colours(shown[rng.choice(colours, (60, 50), p=rng.dirichlet(np.full(colours, 0.4)))])


def names(palette: Palette) -> list[str]:
    return [yarn.name for yarn in palette.yarns]


def shares(distinct: Colours, palette: Palette) -> np.ndarray:
    index, _ = nearest_yarns(distinct, yarn_labs(palette.yarns))
    knots = np.bincount(index, weights=distinct.counts, minlength=len(palette.yarns))
    return knots / knots.sum()


SETS = st.sets(st.sampled_from(NAMES), max_size=4)


@given(
    st.integers(0, 50),
    SETS,
    SETS,
    st.one_of(st.integers(4, 8), st.just("auto"), st.none()),
    st.sampled_from([0.0, 0.01, 0.1]),
)
@examples(60)
def test_kept_yarns_are_there_and_banned_ones_never(
    seed: int, keep: set[str], never: set[str], colours: int | str | None, least: float
) -> None:
    never -= keep
    distinct = picture(seed)
    params = PaletteParams(
        colours=colours, keep=", ".join(keep) or None, never="; ".join(never) or None, least_share=least
    )
    made = choose_yarns(distinct, WOOL, params)
    assert keep <= set(names(made))
    assert not never & set(names(made))
    assert names(made) == [name for name in NAMES if name in names(made)]
    if isinstance(colours, int):
        assert len(made.yarns) + len(made.merged) == colours
    rare = {yarn.name for yarn, share in zip(made.yarns, shares(distinct, made), strict=True) if 0 < share < least}
    assert rare <= keep


@given(st.integers(0, 50), st.floats(0.005, 0.1))
@settings(max_examples=30, deadline=None)
def test_the_least_share_leaves_nothing_to_merge(seed: int, least: float) -> None:
    distinct = picture(seed)
    once = choose_yarns(distinct, WOOL, PaletteParams(least_share=least))
    again = choose_yarns(distinct, once.yarns, PaletteParams(least_share=least))
    assert again.yarns == once.yarns
    assert again.merged == ()
    assert all(one.share < least and one.into != one.name for one in once.merged)


@given(st.integers(0, 100), SETS)
@settings(max_examples=12, deadline=None)
def test_auto_stops_where_a_further_yarn_gains_little(seed: int, keep: set[str]) -> None:
    distinct, kept = picture(seed), ", ".join(keep) or None

    def mean(count: int) -> float:
        made = choose_yarns(distinct, WOOL, PaletteParams(count, kept))
        _, difference = nearest_yarns(distinct, yarn_labs(made.yarns))
        return float(difference @ distinct.counts / distinct.counts.sum())

    made = choose_yarns(distinct, WOOL, PaletteParams("auto", kept))
    knee, begun = made.knee, max(2, len(keep))
    assert knee is not None
    assert len(made.yarns) == knee.colours
    means = [mean(count) for count in range(begun, min(16, knee.colours + 1) + 1)]
    assert [knee.mean, knee.next_mean] == pytest.approx(
        means[-2:] if knee.colours < 16 else [means[-1], None], rel=1e-5
    )
    gains = -np.diff(means)
    assert (gains[:-1] >= LEAST_GAIN - 1e-5).all()
    assert (gains >= 0).all()


def test_a_larger_gain_takes_no_more_yarns(monkeypatch: pytest.MonkeyPatch) -> None:
    found = []
    for gain in (0.05, 0.25, 0.5, 1.0, 3.0):
        monkeypatch.setattr("ilmek.carpet.palette_rules.LEAST_GAIN", gain)
        found.append(len(choose_yarns(picture(3), WOOL, PaletteParams("auto")).yarns))
    assert found == sorted(found, reverse=True)
    assert found[0] > found[-1]


def test_auto_takes_the_colours_of_a_drawing_in_the_yarns() -> None:
    drawn = np.array([WOOL[k].srgb for k in (2, 5, 9)], dtype=np.uint8)
    made = choose_yarns(distinct_colours(drawn[np.indices((30, 30)).sum(axis=0) % 3]), WOOL, PaletteParams("auto"))
    assert names(made) == [WOOL[k].name for k in (2, 5, 9)]
    assert made.knee is not None
    assert made.knee.mean == pytest.approx(0.0, abs=1e-6)


def test_a_merged_yarn_is_reported_with_its_successor() -> None:
    """Rose has 1 % of the knots; madder red is the nearest of the other two."""
    codes = np.array([WOOL[NAMES.index(name)].srgb for name in ("madder red", "ivory", "rose")], dtype=np.uint8)
    counted = np.repeat([0, 1, 2], [600, 390, 10]).reshape(40, 25)
    yarns = [WOOL[NAMES.index(name)] for name in ("madder red", "indigo navy", "ivory", "rose")]
    made = choose_yarns(distinct_colours(codes[counted]), yarns, PaletteParams(least_share=0.02))
    assert [(one.name, one.into, one.share) for one in made.merged] == [("rose", "madder red", 0.01)]
    kept = choose_yarns(distinct_colours(codes[counted]), yarns, PaletteParams(least_share=0.02, keep="Rose"))
    assert kept.merged == ()


def test_names_may_be_quoted_and_every_shipped_name_works() -> None:
    assert yarn_names("keep", ", ".join(NAMES)) == NAMES
    assert yarn_names("keep", 'a b;"c, d" ; A B,e') == ("A B", "c, d", "e")
    assert names(choose_yarns(picture(1), WOOL, PaletteParams(keep=";".join(NAMES), colours=16))) == list(NAMES)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"keep": "ivory", "never": "Ivory"}, "'ivory' is both in keep and in never"),
        ({"keep": "ivory, gold, rose", "colours": 2}, "keep has 3 yarns, more than colours=2"),
        ({"keep": "ivory,,gold"}, "empty name"),
        ({"never": ""}, "empty name"),
        ({"keep": 'iv"ory'}, "cannot be read"),
        ({"least_share": 0.5}, "did you mean 0.5%"),
        ({"colours": "many"}, "not a number"),
        ({"colours": 1}, "at least 2, at most 255 or auto"),
    ],
)
def test_rules_that_contradict_themselves_are_refused(wrong: dict[str, str], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        PaletteParams(**wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"keep": "ivori"}, "no yarn 'ivori'; did you mean 'ivory'"),
        ({"never": "purple velvet"}, "no yarn 'purple velvet'; the list has madder red, "),
        ({"colours": 17}, "2 to 16, the yarns of the list"),
        ({"colours": 16, "never": "ivory"}, "2 to 15, the yarns of the list without"),
        ({"never": ", ".join(NAMES[1:])}, "leaves 1 of 16 yarns"),
    ],
)
def test_rules_that_the_list_cannot_meet_are_refused(wrong: dict[str, str], message: str) -> None:
    with pytest.raises(YarnError, match=message):
        choose_yarns(picture(1), WOOL, PaletteParams(**wrong))  # type: ignore[arg-type]


def test_a_share_that_leaves_one_yarn_is_refused() -> None:
    rgb = np.full((30, 30, 3), WOOL[0].srgb, dtype=np.uint8)
    rgb[0, :5] = WOOL[5].srgb
    with pytest.raises(YarnError, match="would leave a single yarn"):
        choose_yarns(distinct_colours(rgb), WOOL, PaletteParams(least_share=0.05))


def yarn(name: str, srgb: tuple[int, int, int]) -> Yarn:
    lightness, a, b = srgb_to_lab(np.array(srgb, dtype=np.uint8)).tolist()
    return Yarn(name, srgb, (lightness, a, b), 2.5, 2)


def test_twins_are_the_pairs_below_two() -> None:
    assert twin_yarns(WOOL) == ()
    found = twin_yarns([yarn("a", (150, 40, 40)), yarn("b", (20, 40, 90)), yarn("c", (151, 41, 40)), WOOL[5]])
    assert [one.names for one in found] == [("a", "c")]
    assert 0 < found[0].difference < 2


@pytest.mark.parametrize("seed", range(4))
def test_planted_shades_are_found_in_grain(seed: int) -> None:
    """Six colours far from each other, each with grain: found to CIEDE2000 1, with their shares."""
    rng = np.random.default_rng(seed)
    planted = srgb_to_lab(rng.integers(20, 236, (6, 3), dtype=np.uint8))
    while min(np.sort(delta_e_2000(planted, one))[1] for one in planted) < 20:
        planted = srgb_to_lab(rng.integers(20, 236, (6, 3), dtype=np.uint8))
    area = rng.dirichlet(np.full(6, 5.0))
    index = rng.choice(6, (120, 100), p=area)
    rgb = lab_to_srgb(planted[index] + rng.normal(0, 1.5, (120, 100, 3)))
    shades = propose_shades(distinct_colours(rgb), 6, drawn=False)
    assert len(shades) == 6
    found = srgb_to_lab(np.array([shade.srgb for shade in shades], dtype=np.uint8))
    for lab, counted in zip(planted, np.bincount(index.ravel()) / index.size, strict=True):
        difference = delta_e_2000(found, lab)
        assert difference.min() < 1
        assert shades[int(difference.argmin())].share == pytest.approx(counted, abs=0.01)


def test_shades_of_a_drawing_are_its_colours() -> None:
    codes = np.array([(200, 30, 30), (20, 30, 90), (230, 220, 190), (202, 34, 30)], dtype=np.uint8)
    distinct = distinct_colours(codes[np.repeat([0, 1, 2, 3], [400, 250, 200, 50]).reshape(30, 30)])
    assert [shade.srgb for shade in propose_shades(distinct, 9, drawn=True)] == [tuple(one) for one in codes.tolist()]
    three = propose_shades(distinct, 3, drawn=True)
    assert [shade.srgb for shade in three] == [tuple(one) for one in codes[:3].tolist()]
    assert [shade.share for shade in three] == pytest.approx([0.5, 0.25 / 0.9, 0.2 / 0.9], abs=1e-9)
    matched = match_shades(three, WOOL)
    assert len({one.shade.name for one in matched}) == 3
    assert matched[2].nearest == "ivory"
