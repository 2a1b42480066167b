"""The carpet's view: charts of unsaved recipes, what is kept between changes, rows, corners, pictures."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.errors import CarpetError, ParameterError, PictureError
from ilmek.io.chart.rows_text import row_bands
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import order_of_data, read_order
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.jobs.studio.carpet import stages
from ilmek.jobs.studio.carpet.answers import ChartRequest, PictureRequest, ProposalRequest, RowRequest, SpecksRequest
from ilmek.jobs.studio.carpet.tasks import chart, corners, picture, proposal, row, specks
from ilmek.jobs.studio.words import all_in_page

SMALL = {"picture": "pictures/photo.png", "size": "40x60cm", "quality": "20x20/dm"}


@pytest.fixture
def context(tmp_path: Path) -> Context:
    stages.forget()
    (tmp_path / "pictures").mkdir()
    across, down = np.meshgrid(np.arange(160), np.arange(240))
    waves = [127 + 100 * np.sin(across / 17 + down / 31 + turn) for turn in (0, 2, 4)]
    noise = np.random.default_rng(1).normal(0, 8, (240, 160, 3))
    rgb = (np.stack(waves, axis=-1) + noise).clip(0, 255).astype(np.uint8)
    Image.fromarray(rgb).save(tmp_path / "pictures/photo.png")
    return Context(str(tmp_path))


def _parts(answer: Binary) -> tuple[dict[str, Any], bytes]:
    length = int.from_bytes(answer.body[:4], "little")
    about = json.loads(answer.body[4 : 4 + length])
    knots = about["rows"] * about["columns"] if "rows" in about else 0
    return about, answer.body[4 + length : 4 + length + knots] if knots else answer.body[4 + length :]


def _chart(context: Context, *, draft: bool = False, **more: Any) -> tuple[dict[str, Any], bytes]:
    return _parts(chart(ChartRequest({**SMALL, **more}, draft=draft), context))


def _lines(recipe: dict[str, Any]) -> str:
    """The text of a recipe."""
    return "\n".join(f"{key} = {json.dumps(value)}" for key, value in recipe.items())


def _as_file(context: Context, text: str) -> Any:
    (context.folder / "carpet.toml").write_text(text, encoding="utf-8")
    return make_charted(read_order(context.folder / "carpet.toml"))


def test_an_unsaved_recipe_has_the_chart_of_its_file(context: Context) -> None:
    edits = ["border 2 ivory", "set 5,5 madder red"]
    about, knots = _chart(context, colours=6, brightness="10%", edits=edits)
    made = _as_file(context, _lines({**SMALL, "colours": 6, "brightness": "10%", "edits": edits}))
    assert knots == made.chart.knots.tobytes()
    assert [yarn["name"] for yarn in about["yarns"]] == [yarn.name for yarn in made.chart.yarns]
    assert sum(yarn["mass"] for yarn in about["yarns"]) == pytest.approx(made.bill.pile_mass, rel=1e-12)
    assert about["price"] == made.bill.price
    assert about["edited"] == made.chart.reading.edited > 0
    assert about["reason"].endswith("(picture of carpet.toml)")


def test_what_is_kept_does_not_change(context: Context) -> None:
    about, first = _chart(context)
    used = about["yarns"][0]["name"]
    assert _chart(context, edits=[f"replace {used} by madder red", "mirror both"])[1] != first
    assert _chart(context, saturation=0.5)[1] != first
    assert _chart(context)[1] == first
    Image.new("RGB", (80, 120), "#9e2b25").save(context.folder / "pictures/photo.png")
    assert len(set(_chart(context)[1])) == 1


def test_a_composed_recipe_is_kept_too(context: Context) -> None:
    border = [{"yarn": "ivory", "width": 3}]
    first = _chart(context, border=border)
    again = _chart(context, border=border, edits=["set 9,9 dark red"])
    assert _chart(context, border=border)[1] == first[1]
    assert again[0]["edited"] == 1
    assert first[0]["reason"].startswith("composed by carpet.toml")


def _shown(answer: tuple[dict[str, Any], bytes]) -> np.ndarray:
    """CIELAB of each knot."""
    codes = np.array([list(bytes.fromhex(yarn["srgb"][1:])) for yarn in answer[0]["yarns"]], dtype=np.uint8)
    return srgb_to_lab(codes)[list(answer[1])]


def _jumped(before: tuple[dict[str, Any], bytes], after: tuple[dict[str, Any], bytes]) -> float:
    """Share of the knots whose colour is another to the eye."""
    return float((delta_e_2000(_shown(before), _shown(after)) > 4).mean())


def _photo(kind: str) -> np.ndarray:
    """A landscape of soft tones, coloured grain, or a portrait of round shades."""
    across, down = np.meshgrid(np.linspace(-1, 1, 160), np.linspace(-1, 1, 240))
    noise = np.random.default_rng(3).normal(0, 20 if kind == "grain" else 6, (240, 160, 3))
    ramps = {
        "landscape": (140 + 90 * down, 150 - 60 * down * across, 170 - 110 * down),
        "grain": (128 + 60 * np.sin(5 * across), 128 + 60 * np.cos(4 * down), 128 + 60 * np.sin(3 * across + 2 * down)),
        "portrait": tuple(top * np.exp(-(across**2) - 2 * down**2) + 40 for top in (190, 140, 110)),
    }
    return (np.stack(ramps[kind], axis=-1) + noise).clip(0, 255).astype(np.uint8)


@pytest.mark.parametrize("kind", ["landscape", "grain", "portrait"])
def test_nothing_jumps_while_a_slider_moves(kind: str, context: Context) -> None:
    Image.fromarray(_photo(kind)).save(context.folder / f"{kind}.png")
    stages.forget()
    before = None
    for least in range(3, 8):
        draft = _chart(context, draft=True, picture=f"{kind}.png", least_patch=least)
        assert draft[0]["reading"] == "photo"
        assert before is None or _jumped(before, draft) <= 0.03
        assert before is None or {yarn["srgb"] for yarn in before[0]["yarns"]} == {
            yarn["srgb"] for yarn in draft[0]["yarns"]
        }
        before = draft
    changes: tuple[dict[str, Any], ...] = ({"brightness": 0.1}, {"brightness": 0.12}, {"colours": 7}, {"halftone": 0.5})
    for change in changes:
        draft = _chart(context, draft=True, picture=f"{kind}.png", **change)
        stages.forget()
        assert _jumped(draft, _chart(context, picture=f"{kind}.png", **change)) <= 0.03
        assert not draft[0]["draft"]


def test_a_draft_of_a_large_photo_is_nearly_the_chart(context: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stages, "LARGE", 1000)
    stages.forget()
    draft, full = _chart(context, draft=True), _chart(context)
    # Shades that are dyed to order follow the rounded colours of a draft.
    assert delta_e_2000(_shown(full), _shown(draft)).mean() < 5
    assert draft[0]["mean_delta_e"] < full[0]["mean_delta_e"] + 1
    assert draft[0]["draft"]
    assert not full[0]["draft"]
    assert _chart(context, draft=True)[1] == full[1]
    # Where the slider touches no colour, the draft has the shades of the last chart.
    moved = _chart(context, draft=True, least_patch=6)
    assert moved[0]["draft"]
    assert _jumped(full, moved) <= 0.03
    assert _jumped(moved, _chart(context, least_patch=6)) <= 0.03
    # Yarns in stock that only an edit or a border names are there too.
    assert _chart(context, draft=True, brightness=0.1, edits=["set 3,9 ivory"])[0]["edited"] == 1
    assert "ivory" in str(_chart(context, draft=True, border=[{"yarn": "ivory", "width": 3}])[0]["yarns"])


def _afar(answer: tuple[dict[str, Any], bytes]) -> np.ndarray:
    """CIELAB of areas of 8 x 8 knots, whose dots mix."""
    rows, columns = answer[0]["rows"] // 8, answer[0]["columns"] // 8
    labs = _shown(answer).reshape(answer[0]["rows"], answer[0]["columns"], 3)[: 8 * rows, : 8 * columns]
    return labs.reshape(rows, 8, columns, 8, 3).mean(axis=(1, 3))


@pytest.mark.parametrize("kind", ["landscape", "grain", "portrait"])
@pytest.mark.parametrize("change", [{"crop": "5%,0% 100%,100%"}, {"turn": "3deg"}])
def test_a_draft_of_a_part_keeps_shades_and_reading(
    kind: str, change: dict[str, str], context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stages, "LARGE", 1000)
    Image.fromarray(_photo(kind)).save(context.folder / f"{kind}.png")
    full = _chart(context, picture=f"{kind}.png")
    draft = _chart(context, draft=True, picture=f"{kind}.png", **change)
    whole = _chart(context, picture=f"{kind}.png", **change)
    assert draft[0]["draft"]
    assert draft[0]["reason"].split(";")[0] == full[0]["reason"].split(";")[0]
    assert {yarn["srgb"] for yarn in draft[0]["yarns"]} <= {yarn["srgb"] for yarn in full[0]["yarns"]}
    assert delta_e_2000(_afar(draft), _afar(whole)).mean() < 3
    stages.forget()
    assert _chart(context, picture=f"{kind}.png", **change)[1] == whole[1]  # it takes nothing of the draft


def test_a_part_that_is_a_drawing_is_charted_as_one(context: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stages, "LARGE", 1000)
    drawn = np.repeat(np.repeat(np.random.default_rng(2).integers(0, 3, (30, 40)), 4, axis=0), 4, axis=1)
    flags = np.array([[150, 20, 30], [240, 230, 200], [20, 30, 90]], dtype=np.uint8)[drawn]
    Image.fromarray(np.concatenate([_photo("grain"), flags])).save(context.folder / "half.png")
    recipe = {"picture": "half.png", "crop": "0%,67% 100%,100%", "size": "40x30cm"}
    assert _chart(context, **{**recipe, "crop": "0%,0% 100%,70%"})[0]["reading"] == "photo"
    assert _chart(context, draft=True, **recipe)[0]["draft"]
    assert _chart(context, **recipe)[0]["reading"] == "flat"
    assert not _chart(context, draft=True, **recipe)[0]["draft"]


def test_the_fitted_picture_is_sent_once(context: Context) -> None:
    answer = chart(ChartRequest(dict(SMALL)), context)
    source = _parts(answer)[0]["source"]
    assert source["sent"]
    assert (source["width"], source["height"]) == (160, 240)
    again = chart(ChartRequest({**SMALL, "colours": 5}, source=source["key"]), context)
    assert not _parts(again)[0]["source"]["sent"]
    assert len(answer.body) - len(again.body) > 160 * 240


def test_a_row_is_that_of_rows_txt(context: Context) -> None:
    recipe = {**SMALL, "edits": ["jufti 1,1 9,80", "half 10,4 near-black"]}
    made = _as_file(context, _lines(recipe)).chart
    lines = b"".join(part for _, part in row_bands(made, "runs", "both")).decode().splitlines()
    for number in (1, 10, 120):
        answer = row(RowRequest(recipe, number), context)
        assert [answer.rightward, answer.leftward] == [line for line in lines if line.startswith(f"{number} ")]
        assert sum(run.cells for run in answer.runs) == made.columns
    with pytest.raises(ParameterError, match="row 121"):
        row(RowRequest(recipe, 121), context)


def test_shades_are_proposed_by_share(context: Context) -> None:
    shades = proposal(ProposalRequest(dict(SMALL), 5), context).shades
    assert len(shades) == 5
    assert sum(shade.share for shade in shades) == pytest.approx(1.0)
    assert [shade.share for shade in shades] == sorted((shade.share for shade in shades), reverse=True)


def test_corners_are_found_or_refused(context: Context) -> None:
    rgb = np.full((300, 260, 3), (190, 170, 140), dtype=np.uint8)
    rgb[50:250, 60:200] = (120, 20, 30)
    Image.fromarray(rgb).save(context.folder / "pictures/floor.png")
    found = corners(PictureRequest("pictures/floor.png"), context)
    assert np.allclose(found.corners, [(60, 50), (200, 50), (200, 250), (60, 250)], atol=1.0)
    with pytest.raises(PictureError, match="not clear"):
        corners(PictureRequest("pictures/photo.png"), context)


def test_a_picture_is_sent_small(context: Context) -> None:
    about, pixels = _parts(picture(PictureRequest("pictures/photo.png", 100), context))
    assert (about["width"], about["height"]) == (160, 240)
    assert (about["shown_width"], about["shown_height"]) == (67, 100)
    assert len(pixels) >= 67 * 100 * 3
    turned, _ = _parts(picture(PictureRequest("pictures/photo.png", turn="90deg"), context))
    assert (turned["width"], turned["height"]) == (240, 160)


@pytest.mark.parametrize("path", ["../carpet.toml", "/etc/passwd", "pictures/../../x.png"])
def test_no_path_leaves_the_project(path: str, context: Context) -> None:
    with pytest.raises(ParameterError):
        picture(PictureRequest(path), context)
    with pytest.raises(CarpetError):
        chart(ChartRequest({**SMALL, "picture": path}), context)


def test_an_error_names_the_key_and_no_folder(context: Context) -> None:
    with pytest.raises(CarpetError) as refused:
        _chart(context, border=[{"yarn": "ivory"}])
    assert refused.value.given.startswith("carpet.toml, border.0: ")
    with pytest.raises(CarpetError, match=r"^carpet\.toml, edits\.1: unknown yarn 'mauve'"):
        _chart(context, edits=["set 1,1 ivory", "set 1,1 mauve"])


@pytest.mark.parametrize("mode", ["CMYK", "I;16", "P", "RGBA"])
def test_pictures_of_all_kinds_are_read_as_on_the_command_line(mode: str, context: Context) -> None:
    photo = Image.open(context.folder / "pictures/photo.png")
    grey = Image.fromarray(np.asarray(photo.convert("L"), np.uint16) * 257)
    made = grey if mode == "I;16" else photo.convert(mode)
    if mode == "RGBA":
        made.putalpha(128)
    made.save(context.folder / "pictures/kind.tiff")
    about, knots = _chart(context, picture="pictures/kind.tiff")
    file = _as_file(context, _lines({**SMALL, "picture": "pictures/kind.tiff"}))
    assert knots == file.chart.knots.tobytes()
    assert about["notes"] == list(all_in_page(file.notes))


@pytest.mark.parametrize("content", [b"", b"no picture", b"\x89PNG\r\n\x1a\n broken"], ids=["empty", "text", "broken"])
def test_what_is_no_picture_is_refused_as_on_the_command_line(content: bytes, context: Context) -> None:
    (context.folder / "pictures/bad.png").write_bytes(content)
    with pytest.raises(CarpetError) as of_file:
        _as_file(context, _lines({**SMALL, "picture": "pictures/bad.png"}))
    with pytest.raises(CarpetError) as refused:
        _chart(context, picture="pictures/bad.png")
    reason = of_file.value.given.rpartition("/pictures/")[2]
    assert refused.value.given == f"carpet.toml, picture: pictures/{reason}"
    assert refused.value.do == of_file.value.do
    with pytest.raises(PictureError):
        picture(PictureRequest("pictures/bad.png"), context)
    assert _chart(context)[0]["rows"] == 120


def test_a_missing_picture_is_named_as_in_the_project(context: Context) -> None:
    with pytest.raises(CarpetError, match=r"^carpet\.toml, picture: 'pictures/no\.png' is not there") as refused:
        _chart(context, picture="pictures/no.png")
    assert str(context.folder) not in str(refused.value)


def _dots(context: Context) -> dict[str, Any]:
    """A recipe of a drawing knot by knot: ivory, five lone knots, a pair on a diagonal, and a block of nine."""
    srgb = {yarn.name: yarn.srgb for yarn in default_yarns()}
    drawn = np.full((40, 30, 3), srgb["ivory"], dtype=np.uint8)
    for line, column in ((2, 3), (2, 20), (9, 9), (30, 3), (39, 29), (20, 20), (21, 21)):
        drawn[line, column] = srgb["indigo navy"]
    drawn[14:17, 4:7] = srgb["madder red"]
    Image.fromarray(drawn).save(context.folder / "pictures/dots.png")
    yarn = [{"name": name, "srgb": f"#{bytes(codes).hex()}"} for name, codes in srgb.items()]
    return {"picture": "pictures/dots.png", "size": "12x16cm", "quality": "25x25/dm", "read": "exact", "yarn": yarn}


def test_the_yarn_of_each_colour_of_a_drawing_is_listed(context: Context) -> None:
    about, _ = _parts(chart(ChartRequest(_dots(context)), context))
    made = make_charted(order_of_data(context.folder / "carpet.toml", _dots(context))).chart
    found = {(one["colour"], one["yarn"], one["knots"]) for one in about["assignment"]}
    assert found == {(m.hex, made.yarns[m.yarn].name, m.knots) for m in made.reading.matches}
    assert [one["knots"] for one in about["assignment"]] == [1184, 9, 7]
    assert all(one["merged_with"] == [] and one["delta_e"] < 1 for one in about["assignment"])


def test_colours_of_one_yarn_name_each_other(context: Context) -> None:
    """Of three colours two have one yarn where the list has two: red and navy, or one of them and ivory."""
    recipe = _dots(context)
    recipe["yarn"] = [yarn for yarn in recipe["yarn"] if yarn["name"] in ("ivory", "madder red")]
    about, _ = _parts(chart(ChartRequest(recipe), context))
    yarn_of = {one["colour"]: one["yarn"] for one in about["assignment"]}
    assert sorted(yarn_of.values()) in (["ivory", "ivory", "madder red"], ["ivory", "madder red", "madder red"])
    for one in about["assignment"]:
        others = [colour for colour, yarn in yarn_of.items() if yarn == one["yarn"] and colour != one["colour"]]
        assert one["merged_with"] == others


def test_specks_are_found_with_the_yarn_around_them(context: Context) -> None:
    answer = specks(SpecksRequest(_dots(context), 3), context)
    about, data = _parts(answer)
    assert about["sizes"] == [5, 1, 0]
    places = np.frombuffer(data, dtype="<u4", count=about["knots"])
    around = data[4 * about["knots"] + (-4 * about["knots"]) % 8 :][: about["knots"]]
    assert sorted(divmod(int(place), 30) for place in places) == [
        (2, 3), (2, 20), (9, 9), (20, 20), (21, 21), (30, 3), (39, 29)
    ]  # fmt: skip
    assert {about["yarns"][yarn] for yarn in around} == {"ivory"}
    assert _parts(specks(SpecksRequest(_dots(context), 9), context))[0]["sizes"][-1] == 1
    with pytest.raises(ParameterError, match="100 knots"):
        specks(SpecksRequest(_dots(context), 100), context)
