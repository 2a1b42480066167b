"""Yarn lists: what is read, and what is refused with the yarn and the field named."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import ilmek
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.yarn import yarn_labs
from ilmek.errors import YarnError
from ilmek.io.yarn_file import yarns_from_records

RED = {"name": "madder", "srgb": "#9e2b25", "nm": 2.5, "ply": 2, "price": 24}
BLUE = {"name": "indigo", "srgb": "1b2442", "nm": "5", "ply": "", "price": None}


def test_numbers_texts_and_missing_fields() -> None:
    red, blue = yarns_from_records([RED, BLUE])
    assert (red.name, red.srgb, red.metric_count, red.ply, red.price) == ("madder", (158, 43, 37), 2.5, 2, 24.0)
    assert (blue.srgb, blue.metric_count, blue.ply, blue.price) == ((27, 36, 66), 5.0, 1, None)
    assert red.hex == "#9e2b25"
    assert red.linear_density == pytest.approx(0.8e-3)


@pytest.mark.parametrize("lab", [[35.2, 45.0, 29.5], "35.2 45 29.5", "35.2; 45; 29.5", "[35.2, 45.0, 29.5]"])
def test_lab_is_kept_and_shown(lab: object) -> None:
    yarn = yarns_from_records([{"name": "measured", "lab": lab, "nm": 3}, BLUE])[0]
    assert yarn.lab == (35.2, 45.0, 29.5)
    shown = srgb_to_lab(np.array(yarn.srgb, dtype=np.uint8))
    assert delta_e_2000(shown, np.array(yarn.lab)) < 0.5


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"name": ""}, "yarn 1 has no name"),
        ({"srgb": None}, "yarn 1 (madder) has no colour"),
        ({"lab": [1, 2, 3]}, "both srgb and lab"),
        ({"srgb": "red"}, "srgb 'red' is no colour"),
        ({"srgb": "#12345"}, "six hexadecimal digits"),
        ({"srgb": "#12345g"}, "is no colour"),
        ({"srgb": None, "lab": [50, 1]}, "lab [50, 1] is no colour"),
        ({"srgb": None, "lab": [150, 1, 2]}, "L 0 to 100"),
        ({"srgb": None, "lab": "50 x 3"}, "is no colour"),
        ({"srgb": None, "lab": {"l": 3}}, "is no colour"),
        ({"nm": None}, "yarn 1 (madder) has no nm"),
        ({"nm": 0}, "nm 0 cannot be used"),
        ({"nm": "thick"}, "nm 'thick' cannot be used"),
        ({"nm": float("nan")}, "nm nan cannot be used"),
        ({"nm": 10**400}, "cannot be used"),
        ({"nm": True}, "nm True cannot be used"),
        ({"ply": 2.5}, "ply 2.5 is not a whole number"),
        ({"ply": 0}, "ply 0 cannot be used"),
        ({"price": -1}, "price -1 cannot be used"),
        ({"sgrb": "#000000"}, "did you mean 'srgb'?"),
        ({"name": "Indigo "}, "yarns 1 and 2 are both named 'indigo'"),
    ],
)
def test_refused_in_words(change: dict[str, object], said: str) -> None:
    with pytest.raises(YarnError) as caught:
        yarns_from_records([RED | change, BLUE])
    assert said in str(caught.value)


@pytest.mark.parametrize(("count", "said"), [(0, "no yarn"), (1, "one yarn only"), (256, "256 yarns")])
def test_too_few_and_too_many(count: int, said: str) -> None:
    with pytest.raises(YarnError, match=said):
        yarns_from_records([RED | {"name": f"yarn {place}"} for place in range(count)])


def test_shipped_list_has_sixteen_colours_well_apart() -> None:
    text = (Path(ilmek.__file__).parent / "data" / "wool16.toml").read_text(encoding="utf-8")
    yarns = yarns_from_records(tomllib.loads(text)["yarn"])
    labs = yarn_labs(yarns)
    apart = delta_e_2000(labs[:, None], labs[None]) + 100 * np.eye(len(yarns))
    assert len(yarns) == 16
    assert apart.min() > 6
    assert all(yarn.price for yarn in yarns)
