"""`ilmek design MACHINE --workshop DIR`: what is written, whole or not at all, and what is refused."""

import importlib
import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from link_plates import link_plate

from ilmek.cli import main
from ilmek.errors import OutputError, ParameterError
from ilmek.io.cam_tables import FORMATS
from ilmek.jobs.workshop import Tolerance, read_tolerance, write_workshop
from ilmek.machines.component import Component, itself
from ilmek.params import Params, param
from ilmek.report import CamTable, Plate, Report
from ilmek.report.left_out import SWITCH

INDEX_PAGES = "index.html", "index.tr.html"


def table(name: str = "Slide, left", unit: str = "mm") -> CamTable:
    factor = {"mm": 0.02, "deg": 1.0}[unit]

    def course(angle: np.ndarray) -> np.ndarray:
        return factor * np.stack([1 - np.cos(angle), np.sin(angle), np.cos(angle)])

    return CamTable(name, "Slide", course, np.array([0.0, math.tau]), unit, 1.5)


def crank(name: str = "crank") -> Plate:
    pins = [("A", 0j), ("B", 0.06 + 0j)]
    return link_plate(name, "Crank", pins, hole_radius=0.005, width=0.024, thickness=0.008, material="S235JR")


def report(*, plates: tuple[Plate, ...] = (), tables: tuple[CamTable, ...] = ()) -> Report:
    return Report("made-up", "Made up", {"speed": 2.0}, (), (), plates=plates, cam_tables=tables)


def with_step() -> bool:
    try:
        return importlib.import_module("ilmek.io.step") is not None
    except ImportError:
        return False


def test_an_index_tells_of_every_file_how_exact_it_is(tmp_path: Path) -> None:
    made = write_workshop(report(plates=(crank(), crank()), tables=(table(), table())), tmp_path / "out")
    index = json.loads((tmp_path / "out" / "workshop.json").read_text())
    names = sorted(entry[name] for entry in index["files"] for name in ("file", "remarks") if name in entry)
    there = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert sorted([*names, "workshop.json", ".ilmek"]) == there
    assert sorted(Path(file).name for file in made.files) == sorted([*names, "workshop.json"])
    plates = ["crank", "crank-2"]
    expected = {f"{plate}.{kind}" for plate in plates for kind in ("dxf", "step") if kind == "dxf" or with_step()}
    slides = ["slide-left", "slide-left-2"]
    expected |= {f"{slide}.{kind.name}.{kind.suffix}" for slide in slides for kind in FORMATS.values()}
    expected |= {f"{slide}.kollmorgen.csv.txt" for slide in slides}
    expected |= {
        "drawings.pdf",
        "drawings.tr.pdf",
        *(f"{plate}.sheet{end}.dxf" for plate in plates for end in ("", ".tr")),
    }
    assert set(names) == expected | set(INDEX_PAGES)
    for entry in index["files"]:
        if entry["kind"] == "dxf":
            assert entry["area_error"] < 1e-9
            assert entry["area"] == pytest.approx(0.06 * 0.024 + math.pi * (0.012**2 - 2 * 0.005**2), rel=1e-9)
        elif entry["kind"] == "step":
            assert entry["volume_error"] < 1e-9
        elif entry["kind"] in FORMATS:
            assert entry["error"] <= entry["tolerance"] == pytest.approx(1e-6)
            assert entry["kept"]


def test_a_tolerance_is_a_length_an_angle_or_a_share_of_the_stroke() -> None:
    assert read_tolerance("2um").of(table()) == pytest.approx(2e-6)
    assert read_tolerance("2um").of(table(unit="deg")) == pytest.approx(2e-5)  # the usual share of 2 rad
    assert Tolerance().of(table(unit="deg")) == pytest.approx(2e-5)
    assert Tolerance().of(table()) == pytest.approx(1e-6)  # a share of 40 mm would be finer than anybody asks
    assert Tolerance(share=1e-5).of(table()) == pytest.approx(4e-7)
    assert read_tolerance("0.01deg").of(table(unit="deg")) == pytest.approx(math.radians(0.01))
    assert read_tolerance("0.1%").of(table()) == pytest.approx(4e-5)
    for wrong in ("3N", "-1um", "0", "200%", "fine"):
        with pytest.raises(ParameterError, match="a length, an angle, or a share of the stroke; write 1um"):
            read_tolerance(wrong)


def test_notes_tell_of_missed_tolerances_and_of_slaves_that_move_at_the_start(tmp_path: Path) -> None:
    wobble = CamTable(
        "wobble",
        "Wobble",
        lambda a: 0.01 * np.stack([np.sin(20 * a), 20 * np.cos(20 * a), -400 * np.sin(20 * a)]),
        np.array([0.0, math.tau]),
        "mm",
        1.0,
    )
    made = write_workshop(report(plates=(crank(),), tables=(wobble,)), tmp_path / "out", Tolerance(share=1e-6))
    said = "\n".join(made.notes)
    complete, *failed = made.checks
    assert (complete.name, complete.ok, complete.value) == ("parts without files", True, 0)
    assert not any(check.ok for check in failed)
    of_codesys = next(check for check in failed if check.name == "wobble.codesys.st: error of the motion")
    assert of_codesys.source == "tolerance; 128 points"
    assert of_codesys.value > of_codesys.limit == pytest.approx(1e-6 * 0.02, rel=1e-3)
    assert set(failed) <= set(made.judged(report()).failed)
    assert "wobble moves at master angle 0: couple it while the master stands still, or ramp in" in said
    assert ("pip install 'ilmek[step]'" in said) is not with_step()
    assert made.summary.startswith(f"{tmp_path / 'out'}: 1 DXF, ")


def test_a_plate_that_does_not_enclose_its_area_leaves_nothing(tmp_path: Path) -> None:
    loop = 0.05 * np.exp(2j * np.pi * np.arange(360) / 360)
    wrong = Plate("disc", "Disc", loop, 0.01, "steel", area=0.008)
    with pytest.raises(
        OutputError, match="plate disc cannot be drawn: its outline encloses 78.5. cm², the design requires"
    ):
        write_workshop(report(plates=(crank(), wrong)), tmp_path / "out")
    assert not list(tmp_path.iterdir())


def test_a_part_that_cannot_be_made_is_left_out_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(path: Path, plate: Plate) -> None:
        path.write_text("half", encoding="utf-8")
        raise ZeroDivisionError(f"of {plate.name}")

    monkeypatch.delenv(SWITCH)
    monkeypatch.setattr("ilmek.jobs.workshop.write_dxf", fail)
    made = write_workshop(report(plates=(crank(),), tables=(table(),)), tmp_path / "out")
    assert made.notes[0] == "part 'crank' is left out: of crank"
    assert {entry["of"] for entry in made.entries} == {"Slide, left", "made-up"}
    assert not list((tmp_path / "out").glob("crank*"))
    assert all(Path(file).is_file() for file in made.files)


def test_a_machine_without_parts_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="made-up has no plates and no cam tables; leave out --workshop"):
        write_workshop(report(), tmp_path / "out")
    assert not list(tmp_path.iterdir())


def run(*words: str) -> tuple[int, str, str]:
    result = CliRunner().invoke(main, list(words))
    return result.exit_code, result.stdout, result.stderr


@dataclass(frozen=True, slots=True)
class Made(Params):
    """Parameters of the made-up machine."""

    speed: float = param(2.0, unit="rad/s", above=0.0, doc="of the shaft")


@pytest.fixture
def made_up(monkeypatch: pytest.MonkeyPatch) -> None:
    made = report(plates=(crank(),), tables=(table(),))
    machine = Component(
        name="made-up",
        title="Made up",
        params=Made,
        design=lambda params: params,
        analysis=itself,
        results=lambda _: (),
        parameters=lambda params: params,
        plates=lambda _: made.plates,
        cam_tables=lambda _: made.cam_tables,
    )
    monkeypatch.setattr("ilmek.jobs.design.find_machine", lambda _: machine)


@pytest.mark.usefixtures("made_up")
def test_the_command_writes_replaces_and_refuses(tmp_path: Path) -> None:
    out = tmp_path / "parts"
    status, said, _ = run("design", "made-up", "--workshop", str(out), "--tolerance", "5um")
    assert status == 0
    assert f"workshop: {out}: 1 DXF, " in said.replace("\n", " ")
    index = json.loads((out / "workshop.json").read_text())
    assert {entry["kind"] for entry in index["files"]} >= {"dxf", *FORMATS}
    assert all(entry["area_error"] < 1e-4 for entry in index["files"] if entry["kind"] == "dxf")
    assert all(
        entry["error"] <= entry["tolerance"] == pytest.approx(5e-6) for entry in index["files"] if "tolerance" in entry
    )
    status, said, wrong = run("design", "made-up", "--workshop", str(out))
    assert (status, said) == (2, "")
    assert wrong == f"ilmek: output folder {out} exists; choose another, or replace it with --force\n"
    status, said, _ = run("design", "made-up", "--workshop", str(out), "--force", "--json", "-")
    assert status == 0
    data = json.loads(said)
    assert data["machine"] == "made-up"
    assert sorted(data["files"]) == sorted(str(path) for path in out.iterdir() if path.name != ".ilmek")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("cam", "--tolerance", "1um"), "--tolerance needs --workshop DIR; see 'ilmek design --help'"),
        (("cam", "--workshop", "{out}", "--tolerance", "1kg"), "tolerance '1kg'; a length, an angle, or a share"),
    ],
)
def test_a_mistake_is_one_line_and_leaves_nothing(words: tuple[str, ...], said: str, tmp_path: Path) -> None:
    status, shown, wrong = run("design", *(word.format(out=tmp_path / "out") for word in words))
    assert (status, shown) == (2, "")
    assert wrong.startswith(f"ilmek: {said}")
    assert wrong.count("\n") == 1
    assert not list(tmp_path.iterdir())
