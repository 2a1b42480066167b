"""Orders, places and progress of the jobs."""

import threading
from dataclasses import replace
from pathlib import Path

import pytest
from default_machines import SETTLED

from ilmek.errors import CarpetError, LoomError, ParameterError, YarnError
from ilmek.io.chart.formats import FORMATS
from ilmek.jobs.chart import make_charted
from ilmek.jobs.design import design_machine
from ilmek.jobs.inspect import inspect_programme
from ilmek.jobs.loom import make_loomed, params_for, read_loom_order
from ilmek.jobs.machines import machine_form, machine_list
from ilmek.jobs.order import read_order
from ilmek.jobs.output_folder import free_folder
from ilmek.jobs.reproduce import reproduce_papers
from ilmek.jobs.warm import warm
from ilmek.jobs.weave import weave, weave_json
from ilmek.jobs.workshop_order import WorkshopOrder
from ilmek.machines.catalogue import MACHINES
from ilmek.progress import Cancelled, Progress
from ilmek.report import Report
from ilmek.report.left_out import SWITCH

MEDALLION = Path(__file__).parents[2] / "examples" / "medallion.png"
COMB = {**SETTLED, "beat": "comb"}
"""Of looms in whose tests no choice of a beat is claimed."""


def test_order_reads_texts() -> None:
    order = read_order(MEDALLION, size="kelle", quality="40 raj", knot="Senneh", pile_height="6mm", colours=5)
    assert (order.size.width, order.size.length, order.knot) == (2.0, 3.0, "asymmetric")
    assert order.quality.across == pytest.approx(40 / 0.07)
    assert order.plan.pile_height == 0.006
    assert order.resolved().as_dict()["colours"] == 5


def test_order_is_judged_before_the_picture_is_opened() -> None:
    with pytest.raises(YarnError):
        read_order(Path("nowhere.png"), yarn_file=MEDALLION.with_name("wool.toml"), colours=200)
    with pytest.raises(LoomError, match=r"1\.25 mm"):
        read_loom_order(read_order(Path("nowhere.png"), quality="40x40/dm"), warp_pitch="2mm")
    with pytest.raises(ParameterError, match="set it by --deadline"):
        read_loom_order(read_order(Path("nowhere.png")), loom={"deadline": "3h"})


@pytest.mark.usefixtures("not_in_space", "nothing_near")
def test_loom_follows_the_chart() -> None:
    order = read_order(MEDALLION, size="20x30cm", quality="20x20/dm", colours=6, pile_height="8mm")
    charted = make_charted(order)
    loomed = make_loomed(read_loom_order(order, loom=COMB), charted, illustrated=False)
    params = loomed.design.params
    assert params.colours == charted.chart.colours <= 6
    assert params.cloth.warp_pitch == 0.0025
    # A longer pile takes more yarn a knot, which the handler must draw.
    deep = read_order(MEDALLION, size="20x30cm", quality="20x20/dm", colours=6, pile_height="20mm")
    assert params_for(read_loom_order(deep), make_charted(deep)).knot_yarn > params.knot_yarn + 0.02


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("knot", ["symmetric", "asymmetric"])
@pytest.mark.parametrize("quality", ["12x10/dm", "25x25/dm", "40 raj", "100x90/dm"])
def test_a_loom_without_a_carpet_has_the_pile_of_the_default_one(quality: str, knot: str) -> None:
    order = read_order(MEDALLION, size="10x12cm", quality=quality, knot=knot)
    alone = read_loom_order(order)
    assert (alone.params.yarns.pile_density, alone.params.pile_height, alone.params.knot_yarn) == (None, None, None)
    woven = params_for(alone, make_charted(order))
    own, given = alone.params.cloth.carpet_yarns, woven.cloth.carpet_yarns
    assert (own.pile.linear_density, own.pressed) == (given.pile.linear_density, given.pressed)
    assert (alone.params.pile, alone.params.billed) == (woven.pile, woven.billed)


@pytest.mark.usefixtures("not_in_space", "nothing_near")
def test_heads_are_as_many_as_fit_where_few_fit() -> None:
    order = read_order(MEDALLION, size="20x30cm", quality="20x20/dm")
    loomed = make_loomed(read_loom_order(order, loom=COMB), make_charted(order), illustrated=False)
    assert loomed.programme.heads == loomed.design.heads_max < 4


def test_free_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert free_folder(Path("deep/my photo (1).jpg"), "carpet") == Path("my-photo-1-carpet")
    (tmp_path / "a-carpet").mkdir()
    assert free_folder(Path("a.png"), "carpet") == Path("a-carpet-2")
    assert free_folder(Path("..."), "chart") == Path("picture-chart")


@pytest.mark.usefixtures("not_in_space", "nothing_near")
def test_progress_ascends_to_the_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ilmek.jobs.weave.carpet_page", lambda page, *_: page.title)
    monkeypatch.setattr("ilmek.jobs.weave.loom_page", lambda page, *_: page.title)
    order = read_order(MEDALLION, size="20x30cm", quality="10x10/dm")
    told: list[tuple[str, float]] = []
    progress = Progress(lambda stage, share: told.append((stage, share)))
    weave(order, read_loom_order(order, loom=COMB), tmp_path / "out", progress=progress)
    shares = [share for _, share in told]
    assert shares == sorted(shares)
    assert 0 <= shares[0] < shares[-1] <= 1
    assert {"picture", "chart", "loom", "programme", "report"} <= {doing for doing, _ in told}


def test_a_cancelled_carpet_leaves_nothing(tmp_path: Path) -> None:
    order = read_order(MEDALLION, size="20x30cm", quality="10x10/dm")
    cancel = threading.Event()
    progress = Progress(lambda stage, _: cancel.set() if stage == "programme" else None, cancel.is_set)
    with pytest.raises(Cancelled, match="programme"):
        weave(order, read_loom_order(order, loom=COMB), tmp_path / "out", progress=progress)
    assert list(tmp_path.iterdir()) == []


def test_a_design_reports_its_stages_and_can_be_cancelled(tmp_path: Path) -> None:
    stages: list[str] = []
    made = design_machine(
        "warp-tension", {"cloth.warps": "300"}, progress=Progress(lambda stage, _: stages.append(stage))
    )
    assert made.as_json()["parameters"]["cloth.warps"] == 300
    assert list(dict.fromkeys(stages)) == ["design", "report", "files", ""]
    order = WorkshopOrder(tmp_path / "parts")
    with pytest.raises(Cancelled):
        design_machine("shedding", {}, order, progress=Progress(cancelled=lambda: True))
    assert list(tmp_path.iterdir()) == []


def test_papers_are_reproduced_one_by_one() -> None:
    stages: list[str] = []
    found = reproduce_papers(["beat-up"], progress=Progress(lambda stage, _: stages.append(stage)))
    assert list(found.verdicts) == ["beat-up"]
    assert stages[0] == "beat-up"
    assert len(found.as_json()) == len(found.verdicts["beat-up"])
    with pytest.raises(ParameterError, match="papers: beat-up"):
        reproduce_papers(["beatup"])


@pytest.mark.usefixtures("plain_page")
def test_a_programme_is_inspected_by_its_row(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Report, "all_checks", property(lambda _: ()))  # a loom that weaves, whatever its size
    order = read_order(MEDALLION, size="20x30cm", quality="10x10/dm", least_detail="0%")  # 20 × 30 knots keep 38 %
    woven = weave(order, read_loom_order(order, loom=COMB), tmp_path / "out")
    found = inspect_programme(woven.folder / "programme.ilmek", 3)
    assert found.as_json()["row"]["number"] == 3
    with pytest.raises(LoomError, match="no row 31"):
        inspect_programme(woven.folder / "programme.ilmek", 31)


def test_machines_are_listed_and_described() -> None:
    assert list(machine_list()) == list(MACHINES)
    form = machine_form("warp-tension").as_json()
    assert {"name", "default", "unit", "doc"} <= form["parameters"][0].keys()


@pytest.mark.usefixtures("plain_page")  # with pages and in space `make venv` does it
def test_a_first_carpet_warms_everything() -> None:
    # 256 knots of 2 s by one head, and 16 rows of wefts.
    assert warm() > 512


@pytest.mark.usefixtures("plain_loom_page", "nothing_near")
def test_a_job_goes_on_without_what_cannot_be_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*_: object, **__: object) -> None:
        raise ZeroDivisionError("no picture")

    monkeypatch.delenv(SWITCH)
    monkeypatch.setattr("ilmek.jobs.weave.carpet_page", failing)
    monkeypatch.setitem(FORMATS, "pdf", replace(FORMATS["pdf"], write=failing))
    order = read_order(MEDALLION, size="20x30cm", quality="10x10/dm")
    woven = weave(order, read_loom_order(order, loom=COMB), tmp_path / "out")
    warnings = ("chart.pdf is left out: no picture", "report.html is left out: no picture")
    assert woven.left_out == warnings
    assert set(warnings) <= set(weave_json(woven)["warnings"])
    there = {path.name for path in (tmp_path / "out").iterdir()}
    assert there == {Path(file).name for file in woven.files} | {".ilmek"}
    assert not there & {"chart.pdf", "report.html"}


def test_too_many_sheets_are_refused_before_any_work() -> None:
    with pytest.raises(CarpetError, match="13,552 sheets; at most 2,000"):
        read_order(Path("gone.png"), size="290x400cm", quality="250x250/dm", pdf=True)
    assert read_order(Path("gone.png"), size="290x400cm", quality="250x250/dm").pdf is None
