"""Another carpet on a loom that exists: the file gives the same loom, and every need of the carpet is checked."""

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from default_machines import out_of_space
from PIL import Image

from ilmek.cli import main
from ilmek.errors import LoomError, ParameterError
from ilmek.io.programme_file import open_programme
from ilmek.jobs.chart import make_charted
from ilmek.jobs.existing_loom import ExistingLoom, carpet_checks, for_rows, heads_used, read_existing_loom
from ilmek.jobs.loom import LoomResult, make_loomed, read_loom_order
from ilmek.jobs.loom_setup import loom_digest
from ilmek.jobs.order import read_order
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design
from ilmek.machines.automated_loom.cyclogram import TAKE_UP, row_ends
from ilmek.report import Report

MEDALLION = str(Path(__file__).parents[2] / "examples" / "medallion.png")
SIZE, QUALITY = "60x90cm", "15x15/dm"
WOVEN_LONGER = (1 + 15 / 1346) / 0.99  # warps of cotton at the usual tension; shrinkage in washing
LOOM = ("width=0.6m", "length=0.9m", "knots_across=15/dm", "knots_along=15/dm", "colours=12", "heads=2", "beat=comb")

pytestmark = pytest.mark.usefixtures("nothing_near")

LOOMS = (
    (),
    ("aim=time",),
    ("beat=travelling",),
    ("beat=comb", "comb_acceleration=4m/s^2"),
    ("beat=guide-cams",),
    ("beat=comb", "knotting=hand"),
    ("width=2m", "length=3m", "knots_across=30/dm", "knots_along=25/dm", "deadline=200h"),
    ("beat=comb", "knots_across=12/dm", "shedding.law=modified-sine", "yarns.warp=wool", "prices=bearing each = 9"),
)


@pytest.fixture(scope="module", autouse=True)
def not_in_space() -> Iterator[None]:
    with out_of_space():
        yield


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, arguments)


def differences(one: Any, other: Any, path: str = "") -> list[str]:
    """Paths at which two trees differ by more than 1e-12, written without the code that is tested."""
    if isinstance(one, dict) and isinstance(other, dict):
        gone = [f"{path}.{name} is missing" for name in one.keys() ^ other.keys()]
        return gone + [
            text for name in one.keys() & other.keys() for text in differences(one[name], other[name], f"{path}.{name}")
        ]
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        return [
            text
            for number, (a, b) in enumerate(zip(one, other, strict=True))
            for text in differences(a, b, f"{path}[{number}]")
        ]
    if isinstance(one, float) and isinstance(other, int | float):
        return [] if math.isclose(one, other, rel_tol=1e-12, abs_tol=1e-300) else [f"{path}: {one!r} {other!r}"]
    return [] if one == other else [f"{path}: {one!r} {other!r}"]


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("settings", LOOMS, ids=lambda settings: " ".join(settings) or "default")
def test_a_loom_from_its_file_is_the_same_loom(tmp_path: Path, settings: tuple[str, ...]) -> None:
    file = tmp_path / "loom.json"
    assert run("design", "automated-loom", *settings, "--json", str(file)).exit_code in (0, 3)
    written = json.loads(file.read_text(encoding="utf-8"))
    found = read_existing_loom(file)
    assert found.differs == ()
    again = json.loads(json.dumps(found.report.as_json()))
    for data in (written, again):
        for judged in ("weaves", "reasons", "nearest", "choice_bound"):  # wishes and choice were the first carpet's
            data["results"].pop(judged, None)
    assert differences(written["results"], again["results"]) == []
    assert differences(written["machines"], again["machines"]) == []
    chosen = {name: value for name, value in written["parameters"].items() if name not in ("deadline", "price_limit")}
    assert differences(chosen, {name: again["parameters"][name] for name in chosen}) == []


def make_weaving(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the checks of every loom hold, so that a test is about the carpet's alone."""
    monkeypatch.setattr(Report, "all_checks", property(lambda _: ()))


@pytest.fixture(scope="module")
def loom_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("loom") / "loom.json"
    assert run("design", "automated-loom", *LOOM, "--json", str(file)).exit_code in (0, 3)
    return file


@pytest.fixture(scope="module")
def existing(loom_file: Path) -> ExistingLoom:
    return read_existing_loom(loom_file)


@pytest.fixture(scope="module")
def picture(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A picture of two colours."""
    path = tmp_path_factory.mktemp("picture") / "two.png"
    pixels = np.full((90, 60, 3), 240, np.uint8)
    pixels[20:60, 10:40] = (120, 20, 30)
    Image.fromarray(pixels).save(path)
    return path


def made(
    loom_file: Path, picture: Path, deadline: str | None = None, heads: int | None = None, **carpet: Any
) -> LoomResult:
    order = read_order(picture, **{"size": SIZE, "quality": QUALITY, **carpet})
    loom_order = read_loom_order(order, deadline=deadline, heads=heads, loom_file=loom_file)
    return make_loomed(loom_order, make_charted(order))


def failed(result: LoomResult) -> set[str]:
    return {check.name.removeprefix("carpet: ") for check in result.checks if not check.ok}


def test_the_loom_s_own_carpet_and_a_smaller_one_fit(loom_file: Path, picture: Path) -> None:
    for size in (SIZE, "40x50cm"):
        found = made(loom_file, picture, size=size)
        assert failed(found) == set()
        assert found.programme is not None
        assert found.design is not None
        assert found.programme.times == found.design.times
    assert found.programme.columns == 60


@pytest.mark.parametrize(
    ("carpet", "names"),
    [
        ({"size": "62x90cm"}, {"warps"}),
        ({"size": "60x92cm"}, {"length on the loom"}),
        ({"quality": "16x15/dm"}, {"knots across beside those of the loom", "warps"}),
        ({"quality": "14x15/dm"}, {"knots across beside those of the loom", "pile yarn of a knot"}),
        ({"quality": "15x14/dm"}, {"take-up of a row"}),
        ({"knot": "asymmetric"}, {"knot"}),
        ({"pile_height": "25mm"}, {"pile yarn of a knot"}),
    ],
)
def test_each_need_of_a_carpet_is_checked(
    loom_file: Path, picture: Path, carpet: dict[str, str], names: set[str]
) -> None:
    found = made(loom_file, picture, **carpet)
    assert failed(found) == names
    assert found.programme is None
    assert all(check.cure for check in found.checks)


def test_colours_and_yarns_are_checked(existing: ExistingLoom, tmp_path: Path, picture: Path) -> None:
    yarns = tmp_path / "thick.csv"
    yarns.write_text("name,srgb,nm,ply\nred,781418,0.5,2\nivory,f0f0f0,0.5,2\n")
    order = read_order(picture, size=SIZE, quality=QUALITY, yarn_file=yarns)
    found = make_loomed(read_loom_order(order, loom_file=existing.path), make_charted(order))
    assert failed(found) >= {"thickness of the pile in a gripper"}
    order = read_order(Path(MEDALLION), size=SIZE, quality=QUALITY, reading="photo")
    few = replace(existing, design=replace(existing.design, params=replace(existing.design.params, tubes=3)))
    charted = make_charted(order)
    loom_order = replace(read_loom_order(order, loom_file=existing.path), existing=few)
    assert failed(make_loomed(loom_order, charted)) == {"colours"}


@pytest.mark.parametrize(
    ("setting", "names"),
    [
        ({"yarns.warp_diameter": "3mm"}, {"diameter of a warp"}),
        ({"yarns.warp_stiffness": "90kN"}, {"stiffness of a warp"}),
        ({"yarns.warp_density": "0.2g/m"}, {"strength of a warp", "length on the loom", "take-up of a row"}),
    ],
)
def test_warps_of_the_carpet_are_those_of_the_loom(
    loom_file: Path, picture: Path, setting: dict[str, str], names: set[str]
) -> None:
    order = read_order(picture, size=SIZE, quality=QUALITY)
    loom_order = read_loom_order(order, loom=setting, loom_file=loom_file)
    assert failed(make_loomed(loom_order, make_charted(order))) == names


def test_a_deadline_is_a_check_and_fewer_heads_can_be_used(loom_file: Path, picture: Path) -> None:
    one, two = made(loom_file, picture, heads=1), made(loom_file, picture)
    assert one.programme is not None
    assert two.programme is not None
    assert (one.programme.heads, two.programme.heads) == (1, 2)
    assert one.programme.duration > 1.5 * two.programme.duration
    assert one.notes == ("1 of the loom's 2 heads are used; the others are parked",)
    late = made(loom_file, picture, deadline=f"{0.9 * two.programme.duration / 3600}h")
    assert failed(late) == {"weaving time"}


def test_weavers_weave_by_the_chart_with_no_programme(tmp_path: Path, picture: Path) -> None:
    """Their time by hand: 8 h of 8,000 knots a day are 3.6 s a knot; 90 knots of a row, one weaver."""
    order = read_order(picture, size=SIZE, quality=QUALITY)
    charted = make_charted(order)
    designed = make_loomed(read_loom_order(order, loom={"knotting": "hand"}), charted)
    assert designed.design is not None
    assert (designed.programme, designed.setup, designed.design.weavers, failed(designed)) == (None, None, 1, set())
    row = 90 * 3.6 + designed.design.row_cyclogram.period
    stops = sum((bobbin.changes(135)) * bobbin.time for bobbin in designed.design.bobbins)
    assert designed.weaving_time == pytest.approx(135 * row + stops)
    file = tmp_path / "hand.json"
    file.write_text(json.dumps(MACHINE.report(designed.design).as_json()))
    half = made(file, picture, size="60x45cm", deadline="6h")
    assert (half.programme, half.notes, failed(half)) == (None, designed.notes, {"weaving time"})
    assert half.weaving_time is not None
    assert designed.weaving_time == pytest.approx(2 * half.weaving_time, rel=0.01)


def test_a_narrow_carpet_parks_heads(existing: ExistingLoom, picture: Path) -> None:
    order = read_order(picture, size="20x30cm", quality=QUALITY)
    assert heads_used(existing, make_charted(order).chart) == 1 < existing.design.heads


def test_finer_rows_are_taken_up_by_less_and_cost_the_same_force(existing: ExistingLoom, picture: Path) -> None:
    order = read_order(picture, size=SIZE, quality="15x20/dm")
    chart = make_charted(order).chart
    checks = carpet_checks(existing, chart, 2, existing.design.params.yarns, 0.02)
    left = next(check for check in checks if check.name == "carpet: distance of the rows that the beat leaves")
    beat = existing.design.beat
    assert left.value == pytest.approx(beat.row_pitch_left * 15 / 20)
    assert left.ok is (beat.row_pitch_left <= beat.task.cloth.row_distance * 1.02)
    track = for_rows(existing, 5e-3).row_cyclogram.track(TAKE_UP)
    assert track.stroke == pytest.approx(5e-3)
    assert existing.design.row_cyclogram.track(TAKE_UP).stroke == pytest.approx(1 / 150 * WOVEN_LONGER, rel=1e-4)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (("--aim", "time"), "leave --aim out"),
        (("--warp-pitch", "3mm"), "leave --warp-pitch out"),
        (("--heads", "3"), "has 2"),
        (("--loom", "beat=comb"), "only yarns.* can be set"),
        (("--loom", "yarns.wrap=wool"), "unknown parameter 'yarns.wrap'"),
        (("--loom", "other.json"), "two looms"),
    ],
)
def test_nothing_of_a_loom_that_exists_can_be_set(
    loom_file: Path, tmp_path: Path, options: tuple[str, ...], text: str
) -> None:
    out = str(tmp_path / "out")
    result = run(
        "weave", MEDALLION, "--loom", str(loom_file), "--size", SIZE, "--quality", QUALITY, *options, "--out", out
    )
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert text in result.stderr


@pytest.mark.usefixtures("plain_page")
def test_weave_writes_a_programme_for_the_loom_of_a_folder(
    tmp_path: Path, picture: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_weaving(monkeypatch)
    first, second = tmp_path / "first", tmp_path / "second"
    carpet = ("--quality", QUALITY, "--no-pdf")
    comb = ("--loom", "beat=comb")
    assert run("weave", str(picture), "--size", SIZE, *carpet, *comb, "--out", str(first)).exit_code == 0
    loom = str(first / "machine.json")
    result = run("weave", str(picture), "--size", "40x50cm", *carpet, "--loom", loom, "--out", str(second))
    assert result.exit_code == 0, result.stdout + result.stderr
    with open_programme(second / "programme.ilmek") as programme:
        assert (programme.setup.rows, programme.setup.columns) == (75, 60)
    machines = [json.loads((folder / "machine.json").read_text())["results"] for folder in (first, second)]
    assert machines[0].pop("nearest") == []
    assert machines[0].pop("choice_bound")["aim"] == "cost"
    assert differences(*machines) == []
    assert json.loads((second / "report.json").read_text())["parameters"]["loom_file"] == loom
    over = run("weave", str(picture), *carpet, "--loom", loom, "--out", str(first), "--force")
    assert over.exit_code == 2


def changed(loom_file: Path, tmp_path: Path, **entries: Any) -> Path:
    data = json.loads(loom_file.read_text(encoding="utf-8"))
    path = tmp_path / "changed.json"
    path.write_text(json.dumps({**data, **entries}), encoding="utf-8")
    return path


def test_a_loom_that_differs_from_its_file_cannot_weave(loom_file: Path, tmp_path: Path, picture: Path) -> None:
    data = json.loads(loom_file.read_text(encoding="utf-8"))
    results, machines = data["results"], data["machines"]
    dearer = changed(loom_file, tmp_path, results={**results, "price": 1.001 * results["price"]})
    assert read_existing_loom(dearer).differs == ("price",)
    assert failed(made(dearer, picture)) == {"loom: as in its file"}
    cams = {**machines["shedding"]["parameters"], "lift": 0.07}
    other = changed(loom_file, tmp_path, machines={**machines, "shedding": {"parameters": cams}})
    assert read_existing_loom(other).differs == ("shedding.lift",)


def test_a_file_with_parameters_alone_is_a_loom(tmp_path: Path) -> None:
    path = tmp_path / "loom.toml"
    path.write_text('machine = "automated-loom"\n[parameters]\nwidth = "80cm"\nheads = 2\n')
    found = read_existing_loom(path)
    assert (found.design.params.width, found.design.heads, found.differs) == (0.8, 2, ())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("[]", "is not a table"),
        ("{}", "has no 'machine'"),
        ('{"machine": "automated-loom"}', "has no 'parameters'"),
        ('{"machine": "beat-up", "parameters": {}}', "'beat-up' is no loom; automated-loom"),
        ('{"machine": "automated-loom", "parameters": {}, "parameter": {}}', "did you mean 'parameters'?"),
        ('{"machine": "automated-loom", "parameters": []}', "line 1, parameters: [] is not a table"),
        ('{"machine": "automated-loom",\n"parameters": {"width": [1]}}', "line 2, parameters.width: [1] is no value"),
        ('{"machine": "automated-loom", "parameters": {"widht": 1}}', "did you mean width?"),
        ('{"machine": "automated-loom", "parameters": {"width": 1e9}}', "width=1e+09 m is out of bounds"),
        ('{"machine": "automated-loom", "parameters": {"width": NaN}}', "is not a finite number"),
        ('{"machine": "automated-loom", "parameters": {"width": 1, "width": 2}}', "is given twice"),
        ('{"machine": "automated-loom", "parameters": {"heads": true}}', "heads=True is not a number"),
        ('{"machine": "automated-loom", "parameters": {"heads": 900}}', "900 heads"),
        ('{"machine": "automated-loom", "parameters": {}, "machines": {"cam": 1}}', "machines.cam: 1 is not a table"),
        ('{"machine": "automated-loom", "parameters": {}, "machines": {"cam": {}}}', "has no 'parameters'"),
        ('{"machine": "automated-loom", "parameters": {"prices": "' + "x" * 30_000 + '"}}', "is too long"),
        ("[" * 30, "is nested too deeply"),
    ],
)
def test_a_file_that_is_no_loom_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "loom.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(LoomError) as refused:
        read_existing_loom(path)
    assert message in str(refused.value)
    assert str(path) in str(refused.value)


def test_a_missing_file_and_a_word_are_refused(tmp_path: Path) -> None:
    with pytest.raises(LoomError, match="does not exist"):
        read_existing_loom(tmp_path / "gone.json")
    result = run("weave", MEDALLION, "--loom", "comb")
    assert (result.exit_code, "neither a setting nor a loom file" in result.stderr) == (2, True)


def test_the_order_names_what_cannot_be_set(loom_file: Path) -> None:
    order = read_order(Path(MEDALLION), size=SIZE, quality=QUALITY)
    with pytest.raises(ParameterError, match="leave --aim out"):
        read_loom_order(order, aim="price", loom_file=loom_file)


def test_a_programme_s_loom_is_that_of_its_file(tmp_path: Path) -> None:
    settings = {"width": "60cm", "length": "90cm", "knots_across": "15/dm", "deadline": "30h", "tubes": "9"}
    settings |= {"beat": "comb", "aim": "price"}  # no choice is claimed
    file = tmp_path / "loom.json"
    pairs = [f"{name}={value}" for name, value in settings.items()]
    assert run("design", "automated-loom", *pairs, "--json", str(file)).exit_code in (0, 3)
    found, made = read_existing_loom(file).design, design(AutomatedLoomParams.read(settings))
    assert loom_digest(found.params) == loom_digest(made.params)
    assert loom_digest(replace(made.params, tubes=8)) != loom_digest(made.params)
    ends = row_ends(made.row_cyclogram)
    assert list(ends) == sorted(ends)
    assert ends[0] > 0
    assert ends[-1] == made.times.weft
    assert found.weaver.params.tubes == 9


def test_a_programme_states_its_loom_and_its_yarns(loom_file: Path, picture: Path) -> None:
    found = made(loom_file, picture)
    assert found.setup is not None
    assert found.design is not None
    setup, loom = found.setup, found.design
    assert setup.loom == loom_digest(loom.params)
    assert (setup.heads, setup.tubes) == (2, 12)
    assert (setup.spacing - 1) * loom.knot_pitch < loom.head_width <= setup.spacing * loom.knot_pitch * (1 + 1e-9)
    yarn = setup.yarns[0]
    assert setup.packages[0, 0] == pytest.approx(loom.params.package_mass / yarn.linear_density)
    assert max(setup.knot_yarn) == pytest.approx(loom.params.billed, rel=0.5)
    assert setup.times.row_ends == row_ends(loom.row_cyclogram)


def test_a_loom_with_fewer_tubes_than_colours_changes_packages(picture: Path) -> None:
    order = read_order(picture, size=SIZE, quality=QUALITY)
    charted = make_charted(order)
    given = {"beat": "comb", "knotting": "cams", "tubes": "1"}  # nothing is left open, and no choice is claimed
    few = make_loomed(read_loom_order(order, heads=1, aim="price", loom=given), charted)
    assert failed(few) == {"colours"}
    assert few.programme is None
    assert "take a loom with 2 tubes" in few.checks[0].cure
    knots = charted.chart.knots.copy()
    knots[:, :] = np.arange(len(knots))[:, None] // 10 % 2  # bands of one colour each
    banded = replace(charted, chart=replace(charted.chart, knots=knots))
    found = make_loomed(read_loom_order(order, heads=1, aim="price", loom=given), banded)
    assert failed(found) == set()
    assert found.programme is not None
    changes = len(found.programme.tubes.changes)
    assert changes == np.count_nonzero(np.diff(knots[:, 0].astype(int)))
    assert found.programme.stop_time >= 60.0 * changes
