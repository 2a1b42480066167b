"""The loom's scene in the studio's API: packed numbers, the drawing of a plate, what is refused."""

import base64
import gzip
import json
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.path import make_path

from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import IlmekError
from ilmek.io.dxf import write_dxf
from ilmek.jobs import loom_space
from ilmek.jobs.loom_space import loom_in_space, scene_answer
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.jobs.studio.loom.scene import LoomRequest, PlateRequest, glb, in_space, plate, project_loom, scene
from ilmek.plane.contours import area
from ilmek.plane.solids import bounds
from ilmek.report import Contour
from ilmek.units import mm, turn
from ilmek.viz.embedded import compressed
from ilmek.viz.loom_page import LoomPage, loom_page
from ilmek.viz.scene_data import needed_samples


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("project")
    (folder / "machines").mkdir()
    text = 'machine = "automated-loom"\n\n[settings]\nwidth = "0.3 m"\nlength = "0.4 m"\nbeat = "travelling"\n'
    (folder / "machines" / "loom.toml").write_text(text)
    (folder / "machines" / "cam.toml").write_text('machine = "cam"\n\n[settings]\n')
    return folder


def _read(answer: Binary) -> tuple[dict, list[np.ndarray]]:
    size = int.from_bytes(answer.body[:4], "little")
    about, begin, parts = json.loads(answer.body[4 : 4 + size]), 4 + size, []
    for length in about.get("lengths", ()):
        parts.append(np.frombuffer(answer.body[begin : begin + length], np.uint8))
        begin += -(-length // 8) * 8
    assert begin == len(answer.body)
    return about, parts


def test_the_numbers_of_a_scene_are_those_of_its_parts(project: Path) -> None:
    about, (floats, integers, knots) = _read(scene(LoomRequest("machines/loom.toml"), Context(str(project))))
    made = project_loom(project, "machines/loom.toml").scene
    reals, wholes = floats.view("<f4"), integers.view("<u4")
    assert about["chart"] is None
    assert len(knots) == 0
    for part, solid in zip(about["parts"], made.parts, strict=True):
        (first, count), (begin, number) = part["solids"][0]["points"], part["solids"][0]["triangles"]
        assert np.allclose(reals[first : first + count].reshape(-1, 3), solid.solids[0].points, atol=1e-6)
        assert np.array_equal(wholes[begin : begin + number].reshape(-1, 3), solid.solids[0].triangles)
    assert [sheet["across"][1] for sheet in about["warps"]] == [sheet.across.size for sheet in made.warps]


def test_samples_that_are_left_out_lie_on_a_line(project: Path) -> None:
    made = project_loom(project, "machines/loom.toml").scene
    for frame in made.frames:
        if frame.motion is None:
            continue
        kept = needed_samples(frame.motion)
        angle = frame.motion.angle
        assert angle[kept][0] == 0
        assert angle[kept][-1] == pytest.approx(turn)
        for values, error in ((frame.motion.shift, 2e-5), (frame.motion.rotation[:, None], 2e-4)):
            for column in values.T:
                assert np.abs(np.interp(angle, angle[kept], column[kept]) - column).max() <= error * 1.001


def test_a_plates_drawing_encloses_its_area(project: Path) -> None:
    context = Context(str(project))
    drawn = plate(PlateRequest("beat-up-crank", "machines/loom.toml"), context)
    known = {one.name: one for one in project_loom(project, "machines/loom.toml").report.all_plates}["beat-up-crank"]
    points = np.array(drawn.lines[0]).reshape(-1, 2) @ np.array([1, 1j])
    assert isinstance(known.outline, Contour)
    assert area(Contour(points, np.zeros(len(points)))) == pytest.approx(area(known.outline), rel=1e-3)
    assert len(drawn.holes) == len(known.holes)
    with pytest.raises(IlmekError, match="no plate"):
        plate(PlateRequest("wheel", "machines/loom.toml"), context)


@pytest.mark.parametrize(
    "name", ["beat-up-crank", "beat-up-rocker", "shedding-shedding-cam", "weaver-pile-handler-cam"]
)
def test_a_part_of_the_scene_is_as_large_as_its_workshop_file(project: Path, tmp_path: Path, name: str) -> None:
    loom = project_loom(project, "machines/loom.toml")
    part = next(one for one in loom.scene.parts if one.plate == name)
    made = next(one for one in loom.report.all_plates if one.name == name)
    write_dxf(tmp_path / "part.dxf", made)
    drawn = ezdxf.readfile(tmp_path / "part.dxf").modelspace().query('LWPOLYLINE[layer=="PROFILE"]')
    low, high = bounds(part.solids[0])
    assert high[0] - low[0] == pytest.approx(made.thickness, abs=1e-9)
    # a plate lies in the side view, in any direction: its corners have the distances that they have in the file
    file = [corner for line in drawn for corner in make_path(line).flattening(part.deviations[0] / mm)]
    corners = np.array([complex(corner.x, corner.y) for corner in file]) * mm
    solid = part.solids[0].points[:, 2] + 1j * part.solids[0].points[:, 1]
    assert _spread(solid) == pytest.approx(_spread(corners), abs=2 * part.deviations[0])


def _spread(points: np.ndarray) -> tuple[float, float]:
    """The greatest distance of two points, and their least width in any direction [m]."""
    across = np.exp(1j * np.linspace(0.0, turn / 2, 721))
    widths = np.ptp((points[:, None] * across).real, axis=0)
    return float(widths.max()), float(widths.min())


def test_a_file_that_is_no_loom_is_refused(project: Path) -> None:
    with pytest.raises(IlmekError, match="file of a cam"):
        scene(LoomRequest("machines/cam.toml"), Context(str(project)))
    with pytest.raises(IlmekError, match="no file of the project"):
        scene(LoomRequest("../secret.toml"), Context(str(project)))


def test_the_loom_as_glb(project: Path) -> None:
    answer = glb(LoomRequest("machines/loom.toml"), Context(str(project)))
    assert answer.kind == "model/gltf-binary"
    assert answer.body[:4] == b"glTF"


def compressed_name(name: str) -> str:
    return compressed(name.encode())


def test_the_page_of_a_loom_has_its_scene_and_the_client(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    loom = project_loom(project, "machines/loom.toml")
    monkeypatch.setattr(loom_space, "client", lambda _: "")
    assert loom_in_space(loom.design, loom.report, None) is None
    monkeypatch.setattr(loom_space, "client", compressed_name)
    found = loom_in_space(loom.design, loom.report, None)
    assert found is not None
    data = gzip.decompress(base64.b64decode(found.data))
    assert data == scene(LoomRequest("machines/loom.toml"), Context(str(project))).body
    page = loom_page(LoomPage("Loom", "1 m", "report.html", space=found))
    assert all(text in page for text in (found.client, found.data, 'id="loom-in-space"'))
    assert "loom-in-space" not in loom_page(LoomPage("Loom", "1 m", "report.html"))


def test_a_hand_loom_is_shown_with_the_change_of_its_shed(project: Path) -> None:
    text = 'machine = "automated-loom"\n\n[settings]\nknotting = "hand"\nshed = "hand"\nbeat = "hand"\n'
    (project / "machines" / "hand.toml").write_text(text)
    about, _ = _read(scene(LoomRequest("machines/hand.toml"), Context(str(project))))
    assert list(about["periods"]) == ["shed"]
    assert {phase["drive"] for phase in about["phases"]} == {"shed"}
    assert (about["nearest"], about["heads"], about["guards"]) == (None, "", [])
    held = about["bodies"]["hand-shed/heddles"]
    assert (held["drive"], held["motor"]) == ("shed", "hand lever of the heddles")
    compared, _ = _read(in_space(LoomRequest("machines/hand.toml"), Context(str(project))))
    assert compared["failures"] == []
    parts = {tuple(part["ids"]) for part in about["parts"]}
    assert len({str(pair["parts"] + pair["bodies"]) for pair in compared["nearest"]}) == len(compared["nearest"]) > 0
    assert all({*zip(pair["parts"], pair["bodies"], strict=True)} <= parts for pair in compared["nearest"])


def test_a_large_chart_is_shown_by_fewer_knots(project: Path) -> None:
    made = project_loom(project, "machines/loom.toml").scene
    yarn = Yarn("red", (200, 0, 0), (40.0, 60.0, 50.0))
    knots = np.zeros((300, 500), np.uint8)
    chart = Chart(knots, (yarn,), CarpetSize(0.5, 0.3), Quality(1000.0, 1000.0), "symmetric")
    about, parts = _read(scene_answer(made, chart, most=40_000))
    assert (about["chart"]["rows"], about["chart"]["columns"]) == (150, 250)
    assert len(parts[2]) == 150 * 250
