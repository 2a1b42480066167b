"""Sentences in two languages: the catalogues agree, and what the studio says of a chart is in the page's language."""

import ast
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest
from click.testing import CliRunner
from english_words import ENGLISH_ALONE, words
from PIL import Image

import ilmek
from ilmek.cli import main
from ilmek.cli.terminal import show_checks
from ilmek.cli.verdict import WEAVES, show_verdict
from ilmek.errors import IlmekError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.carpet import stages
from ilmek.jobs.studio.carpet.answers import ChartRequest, PictureRequest
from ilmek.jobs.studio.carpet.tasks import chart, corners
from ilmek.jobs.studio.words import in_page
from ilmek.report import at_least, at_most, must
from ilmek.sentences import LANGUAGES, Sentence, catalogue_of, in_language, worded_error
from ilmek.sentences.english import ENGLISH
from ilmek.sentences.nouns_turkish import named

SOURCES = Path(ilmek.__file__).parent
FAMILIES = ("place.", "check.paper-", "yarn.count-allowed", "sheet.kind-", "sheet.duty-", "sheet.process-")
FAMILIES += ("setting.", "instrument.", "sheet.bend", "sheet.twist-")
FAMILIES += (
    "knot.",
    "standard.",
    "colour.",
    "count.",
    "mounting.",
    "rows.",
    "chart.left",
    "chart.right",
    "chart.below",
)
FAMILIES += ("chart.above", "order.approved", "order.changes", "order.signed", "order.warp-beam", "order.cloth-beam")
FAMILIES += ("order.fibre-", "order.shape-", "order.binding-", "order.sample")
"""Begins of keys that are put together."""


def places(template: str) -> set[str]:
    return set(re.findall(r"\{(\w+)[^}]*\}", template))


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_language_has_every_sentence(language: str) -> None:
    catalogue = catalogue_of(language)
    assert catalogue.keys() == ENGLISH.keys()
    assert [key for key in ENGLISH if not places(catalogue[key]) <= places(ENGLISH[key])] == []


def test_every_sentence_is_said_somewhere() -> None:
    used = {
        key
        for file in (*SOURCES.rglob("*.py"), *SOURCES.rglob("*.j2"))
        if file.parent.name != "sentences" or file.name == "__init__.py"
        for key in re.findall(r'"([a-z]+\.[a-z-]+|at|joined)"', file.read_text(encoding="utf-8"))
    }
    of_knots = {key: key.removeprefix("kilim.") for key in ENGLISH}  # a kilim has its own nouns for the same key
    unsaid = {key for key in ENGLISH if key not in used and of_knots[key] not in used}
    assert [key for key in unsaid if not of_knots[key].startswith(FAMILIES)] == []


@pytest.fixture
def context(tmp_path: Path) -> Iterator[Context]:
    stages.forget()
    drawn = np.repeat(np.repeat(np.arange(24).reshape(6, 4) % 3, 40, axis=0), 40, axis=1)
    rgb = np.array([[150, 20, 30], [240, 230, 200], [20, 30, 90]], dtype=np.uint8)[drawn]
    Image.fromarray(rgb).save(tmp_path / "drawing.png")
    (tmp_path / "broken.png").write_bytes(b"no picture at all")
    with in_language("tr"):
        yield Context(str(tmp_path))


GOOD = {"picture": "drawing.png", "size": "40x60cm", "quality": "20x20/dm", "yarns": "wool"}


def _refusal(recipe: dict[str, Any], context: Context) -> tuple[str, str, str]:
    """What the page shows: given, allowed, and what to do."""
    with pytest.raises(IlmekError) as caught:
        chart(ChartRequest({**GOOD, **recipe}), context)
    error = caught.value
    return in_page(error.given), in_page(error.allowed), in_page(error.do)


@pytest.mark.parametrize(
    ("recipe", "given", "rest"),
    [
        ({"size": "120cm"}, "carpet.toml, size: '120cm' boyutunun tek kenarı var", "en x boy"),
        ({"size": "sedcade"}, "carpet.toml, size: bilinmeyen boyut 'sedcade'", "'seccade' mi demek istediniz?"),
        ({"size": "40x60"}, "carpet.toml, size: '40x60' boyutunun birimi yok", "mm, cm, dm, m, in ya da ft"),
        ({"quality": "fine"}, "carpet.toml, quality: bilinmeyen kalite 'fine'", "dm, cm ya da inç"),
        ({"quality": "9000x9000/dm"}, "dm başına 9000 ilmekli kalite", "en çok"),
        ({"size": "2x3cm", "quality": "2x2/dm"}, "0 × 1 ilmektir", "en az 2 × 2"),
        ({"brightness": 3}, "brightness=300% sınırların dışında", "en az -90%, en çok 90%"),
        ({"read": "drawn"}, "'drawn' bilinmiyor", "şunlardan biri: auto, exact, flat, photo"),
        ({"crop": "5000,0 9000,60"}, "crop='5000,0 9000,60' resmin dışına taşıyor", "resim 160 x 240 piksel"),
        ({"crop": "5,5 5,60"}, "hiç piksel bırakmıyor", "iki karşı köşeyi yazın"),
        ({"crop": "here"}, "bir nokta listesi değil", "iki karşı köşeyi yazın"),
        ({"corners": "10,10 100,100 100,10 10,100"}, "kenarlar kesişiyor", "halının sol üst"),
        (
            {"halftone": 0.5, "read": "flat"},
            "halftone=50%, ama resim flat olarak okundu",
            "yarım ton bir fotoğraf ister",
        ),
        ({"picture": "broken.png"}, "broken.png okunabilen bir resim değil", "SVG ya da PDF dosyası kullanın"),
        ({"picture": "gone.png"}, "'gone.png' yok", "onu reçetenin klasörüne koyun"),
        ({"picture": "../up.png"}, "reçetenin klasörünün dışına çıkıyor", "dosyayı reçetenin klasörüne kopyalayın"),
        ({"keep": "ivry"}, "keep: listede 'ivry' ipliği yok", "'ivory' mi demek istediniz?"),
        ({"map": {"#6c9136": "silk"}}, "map #6c9136: listede 'silk' ipliği yok", "listedekiler: madder red"),
        ({"colours": 200}, "iplik sayısı 200", "2 ile 16 arası, listedeki iplikler"),
        (
            {"edits": [{"on": "knots", "lines": ["set 1,1 ivory"]}]},
            "carpet.toml, edits.0: knots üzerindeki düzenlemeler bir ızgara belirtmiyor",
            "sütun x satır verin",
        ),
        ({"edits": ["paint 1,1 ivory"]}, "bilinmeyen düzenleme 'paint'", ""),
        ({"edits": ["set 1,1 silk"]}, "bilinmeyen iplik 'silk'", ""),
    ],
)
def test_a_refusal_is_in_the_language_of_the_page(
    recipe: dict[str, Any], given: str, rest: str, context: Context
) -> None:
    said, allowed, do = _refusal(recipe, context)
    assert given in said
    assert rest in f"{allowed} {do}"
    assert str(context.folder) not in said
    with in_language("en"):
        english = _refusal(recipe, context)
    assert english[0] != said


def test_an_unclear_outline_is_in_turkish(context: Context) -> None:
    with pytest.raises(IlmekError) as caught:
        corners(PictureRequest("drawing.png"), context)
    assert in_page(caught.value.given).startswith("halının çevresi açık değil (")
    assert re.fullmatch(r"köşeleri bunlarsa, verin:( \d+\.\d,\d+\.\d){4}", in_page(caught.value.do))


def test_a_picture_without_an_outline_is_in_turkish(context: Context) -> None:
    Image.new("RGB", (160, 240), (150, 20, 30)).save(Path(context.folder) / "plain.png")
    with pytest.raises(IlmekError) as caught:
        corners(PictureRequest("plain.png"), context)
    assert in_page(caught.value.given) == "halının çevresi açık değil (resmin kenarından farklı bir şey yok)"
    assert in_page(caught.value.do) == "köşeleri kendiniz verin: x,y x,y x,y x,y"


def test_the_checks_of_a_chart_are_in_the_language_of_the_page(context: Context) -> None:
    def checks(**more: Any) -> dict[str, dict[str, Any]]:
        body = chart(ChartRequest({**GOOD, **more}), context).body
        about = json.loads(body[4 : 4 + int.from_bytes(body[:4], "little")])
        return {check["name"]: check for check in about["checks"]}

    turkish = checks(map={"#961e1e": "ivory"} | {"#f0e6c8": "ivory", "#961420": "ivory"}, least_edges=1.0)
    assert list(turkish) == ["hav: doldurulan zemin payı", "resmin korunan kenarları", "çizimin kaybolan renkleri"]
    lost = turkish["çizimin kaybolan renkleri"]
    assert not lost["ok"]
    assert "listeden '" in lost["cure"] or "listeye " in lost["cure"]
    assert lost["source"].startswith("bu proje")
    with in_language("en"):
        assert "edges of the picture kept" in checks()


def test_a_sentence_is_its_english_text_until_it_is_said() -> None:
    sentence = Sentence("yarn.listed", names=Sentence("size.units"))
    assert sentence == "the list has mm, cm, dm, m, in or ft"
    with in_language("tr"):
        assert in_page(sentence) == "listedekiler: mm, cm, dm, m, in ya da ft"
    with in_language("xx"):
        assert in_page(sentence) == sentence


CHECKS = ("at_most", "at_least", "must", "Check")
"""What makes checks; the name comes first."""


def test_every_name_of_a_check_is_there_in_turkish() -> None:
    """Those that stand in the sources as a text; names that are put together are not seen here."""
    calls = (
        node
        for file in SOURCES.rglob("*.py")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in CHECKS and node.args
    )
    names = {call.args[0].value for call in calls if isinstance(call.args[0], ast.Constant)}
    assert len(names) > 300
    assert [name for name in sorted(names) if named(name) == name and "_" not in name] == []


def declared_texts() -> Iterator[str]:
    """The meanings of results, parameters and options as they stand in the sources."""
    for file in SOURCES.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call):
                continue
            texts = [word.value for word in node.keywords if word.arg in {"doc", "help"}]
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            if name in {"result", "file_option", "text_option"}:
                texts += node.args[1 + (name != "result") :][:1]
            yield from (text.value for text in texts if isinstance(text, ast.Constant) and isinstance(text.value, str))


def test_every_meaning_is_there_in_turkish() -> None:
    texts = {text for text in declared_texts() if " " in text}
    assert len(texts) > 1000
    assert [text for text in sorted(texts) if words(re.sub(r"`.*?`|--[\w-]+", "", named(text))) & ENGLISH_ALONE] == []


TEXTS_OF_ERRORS = """
unknown machine 'nothing' | none.toml is empty | line 3: the heading 'x' | give another --journal, or --new
row 7 with 3 phases | a bore of 0.1 m in a bar of 0.05 m | at most 12 heads: each ties two halves of at least one knot
joint C of four-bar has a gap of 0.2 m at the start | did you mean 30deg? | no table 'x' in the report of cam
"""


def test_an_error_of_the_engine_is_said_in_turkish() -> None:
    errors = [text for line in TEXTS_OF_ERRORS.strip().split("\n") for text in line.split(" | ")]
    with in_language("tr"):
        assert [
            text for text in errors if worded_error(text) == text or words(worded_error(text)) & ENGLISH_ALONE
        ] == []
        assert worded_error("law, motion, lift") == "law, motion, lift"


@pytest.mark.parametrize("name", ["", *main.modules])
def test_the_help_of_every_command_says_no_english(name: str) -> None:
    shown = CliRunner().invoke(main, ["--lang", "tr", *name.split(), "--help"]).output
    told = re.sub(r"--[\w-]+|\b[A-Z.]{2,}\b|`.*?`", "", shown.partition("Örnekler:")[0])
    assert words(told) & ENGLISH_ALONE == set()


@click.command()
def report() -> None:
    checks = (
        at_most(
            "deflection of the needle bar", 0.003, 0.002, "mm", "span over 2000, assumed by this project"
        ).with_cure(Sentence("check.pile-cure")),
        at_least("clearance: heads and warps", 0.002, 0.001, "mm", "parameter clearance"),
        must("a servo turns the shafts", True, "motor table, margin 1.25"),
    )
    show_verdict(checks, WEAVES)
    show_verdict(checks)
    show_checks(checks)


COMMANDS = (
    ["chart", "none.png", "--size", "40x60", "--quality", "20x20/dm"],
    ["chart", "none.png", "--size", "40x60cm", "--quality", "xyz"],
    ["design", "cam", "--set", "lift=9km"],
    ["report"],
)


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
@pytest.mark.parametrize("first", [True, False])
def test_a_terminal_in_turkish_says_no_english(
    command: list[str], first: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The judge: the words of the English sentences that no Turkish one has. Parameters keep their names."""
    monkeypatch.setitem(main.modules, "report", (__name__, ""))
    monkeypatch.setattr(sys.modules[__name__], "command", report, raising=False)
    english, turkish = (words(" ".join(catalogue_of(language).values())) for language in ("en", "tr"))
    foreign = english - turkish - {"cm", "lift", "clearance"}
    told = ["--lang", "tr", *command] if first else [*command, "--lang", "tr"]
    shown = CliRunner().invoke(main, told).output
    assert shown != CliRunner().invoke(main, command).output
    assert words(shown.replace("none.png", "")) & foreign == set()
