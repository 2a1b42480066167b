"""A picture on a tufting machine: its programme tufted by a reader and a simulation of their own, yarn by hand."""

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.cli import main
from ilmek.errors import ParameterError
from ilmek.io.tufting_file import read_tufting, write_tufting
from ilmek.machines.tufting_machine import TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.units import inch, rpm
from ilmek.weaving.tufting.programme import BARE, UNIT, TuftGrid, tuft_programme
from ilmek.weaving.tufting.twin import tufted_face

GRID = TuftGrid(gauge=4e-3, stitch=3e-3, height=8e-3, low=8e-3, hidden=0.5e-3, backing=0.5e-3, back=1.0)


def labels_of(rows: int, columns: int, colours: int) -> np.ndarray:
    return np.random.default_rng(rows).integers(0, colours, (rows, columns)).astype(np.uint8)


def head_of(text: str) -> tuple[dict[str, float], dict[str, float], int]:
    """Values, feeds [mm] and number of threads of the head."""
    lines = [line.split() for line in text.split("\nstrokes\n", maxsplit=1)[0].splitlines()[1:]]
    feeds = {line[1]: float(line[2]) for line in lines if line[0] == "feed"}
    threads = sum(line[0] == "thread" for line in lines)
    return {line[0]: float(line[1]) for line in lines if line[0] not in {"feed", "thread"}}, feeds, threads


def stitches_of(text: str) -> list[tuple[int, int, int, str]]:
    """Stroke, shift, needle and feed of every stitch."""
    stitches = []
    for stroke, line in enumerate(text.split("\nstrokes\n")[1].splitlines()):
        shift, *runs = line.split()
        counted = (re.fullmatch(r"(\d+)([A-Z]+|-)", run) for run in runs)
        names = [name for found in counted if found for name in [found[2]] * int(found[1])]
        stitches += [(stroke, int(shift), needle, name) for needle, name in enumerate(names) if name != "-"]
    return stitches


def tufted(text: str) -> tuple[dict[tuple[int, int], list[tuple[int, float]]], dict[int, float]]:
    """Loops over half of the pile by place (row from below, column), and yarn by thread [mm], loop by loop."""
    values, feeds, threads = head_of(text)
    pile = values["height"]
    loops: dict[int, list[list[float]]] = {}
    yarn = dict.fromkeys(range(threads), 0.0)
    for stroke, shift, needle, name in stitches_of(text):
        own = loops.setdefault(needle, [])
        x, y = (values["first"] + needle + shift) * values["gauge"], stroke * values["advance"]
        need = 2 * (pile + values["backing"])
        if own:
            need += values["back"] * math.dist((x, y), own[-1][:2])
            own[-1][2] -= (need - feeds[name]) / 2
        own.append([x, y, pile])
        yarn[needle % threads] += feeds[name]
    seen: dict[tuple[int, int], list[tuple[int, float]]] = {}
    for needle, own in loops.items():
        for x, y, height in own[:-1]:
            if height > values["low"] / 2:
                place = math.floor(y / values["stitch"] + 1e-9), round(x / values["gauge"])
                seen.setdefault(place, []).append((needle % threads, height))
    return seen, yarn


@pytest.mark.parametrize("by_needle", [False, True])
@pytest.mark.parametrize("colours", [1, 2, 5])
def test_another_reader_tufts_every_place_in_its_colour(tmp_path: Path, colours: int, *, by_needle: bool) -> None:
    labels = labels_of(13, 17, colours)
    programme = tuft_programme(labels, colours, GRID, by_needle=by_needle)
    path = tmp_path / "tufting.txt"
    write_tufting(path, programme, [(f"yarn {number}", "#123456") for number in range(colours)])
    seen, yarn = tufted(path.read_text())
    assert sorted(seen) == [(row, column) for row in range(13) for column in range(17)]
    for (row, column), loops in seen.items():
        ((colour, height),) = loops
        assert colour == labels[12 - row, column]
        assert height == pytest.approx(8.0, abs=0.006)
    read = read_tufting(path)
    face = tufted_face(read)
    assert (read.feeds == programme.feeds).all()
    assert (face.colours == labels).all()
    assert (face.number == 1).all()
    assert face.yarn * 1e3 == pytest.approx([yarn[number] for number in range(colours)], abs=1e-6)
    assert face.hidden == pytest.approx(GRID.hidden if colours > 1 and not by_needle else 0, abs=1e-5)


@pytest.mark.parametrize("by_needle", [False, True])
def test_another_reader_finds_the_heights_of_a_map_and_nothing_seen_outside_of_a_shape(
    tmp_path: Path, *, by_needle: bool
) -> None:
    labels = labels_of(13, 17, 3)
    y, x = np.mgrid[0:13, 0:17]
    labels[np.hypot((y - 6) / 6.5, (x - 8) / 8.5) > 1] = BARE
    heights = np.random.default_rng(4).choice([5e-3, 6.5e-3, 8e-3], labels.shape)
    programme = tuft_programme(labels, 3, replace(GRID, low=5e-3), heights=heights, by_needle=by_needle)
    write_tufting(tmp_path / "tufting.txt", programme, [(f"yarn {number}", "#123456") for number in range(3)])
    seen, _ = tufted((tmp_path / "tufting.txt").read_text())
    assert {(12 - row, column) for row, column in seen} == set(map(tuple, np.argwhere(labels != BARE).tolist()))
    for (row, column), loops in seen.items():
        ((colour, height),) = loops
        assert colour == labels[12 - row, column]
        assert height == pytest.approx(1e3 * heights[12 - row, column], abs=0.006)
    face = tufted_face(read_tufting(tmp_path / "tufting.txt"))
    assert (face.colours == labels).all()
    assert np.nanmax(abs(face.heights - heights)) < 1e-5
    assert (np.isnan(face.heights) == (labels == BARE)).all()


def test_a_feed_that_is_a_stroke_late_tufts_another_picture() -> None:
    programme = tuft_programme(labels_of(13, 17, 3), 3, GRID)
    late = np.roll(programme.feeds, 1, axis=0)
    face = tufted_face(type(programme)(**{**{n: getattr(programme, n) for n in programme.__slots__}, "feeds": late}))
    assert (face.number != 1).mean() > 0.3


@pytest.mark.parametrize("selection", ["yarn", "needles"])
def test_the_yarn_of_a_picture_is_that_of_the_product_formula(selection: str) -> None:
    """Large, of four colours at random: by yarn to the edges' needles; by needles the formula is an estimate."""
    labels = labels_of(120, 100, 4)
    settings = {"width": "412mm", "drives": "2", "pattern.colours": "4", "pattern.selection": selection}
    params = TuftingMachineParams.read(settings)
    programme = tuft_programme(labels, 4, params.grid, by_needle=selection == "needles")
    found = float(tufted_face(programme).yarn.sum()) / labels.size
    expected = TuftedCarpet(params, 160 * rpm).yarn_per_stitch
    assert found == pytest.approx(expected, rel=0.05 if selection == "yarn" else 0.12)


def test_an_overtufted_place_by_hand() -> None:
    """3 colours: one loop of 10 mm, two at the backing, two slanted backs of a gauge and a straight one."""
    params = TuftingMachineParams.read({"pattern.colours": "3"})
    third, gauge = 3.125 / 3, inch / 8 * 1e3
    by_hand = 2 * 10.5 + 2 * 2 * 0.5 + 2 * math.hypot(third, gauge) + third
    carpet = TuftedCarpet(params, 160 * rpm)
    assert carpet.yarn_per_stitch * 1e3 == pytest.approx(by_hand, rel=1e-12)
    plain = TuftedCarpet(TuftingMachineParams(), 160 * rpm)
    assert carpet.production == pytest.approx(plain.production / 3, rel=1e-12)


@pytest.mark.parametrize(
    ("line", "words"),
    [("0 5A", "5 needles"), ("0 17Q", "'Q'")],
)
def test_a_programme_that_is_none_is_named_with_its_line(tmp_path: Path, line: str, words: str) -> None:
    path = tmp_path / "tufting.txt"
    write_tufting(path, tuft_programme(labels_of(3, 17, 1), 1, GRID), [("yarn", "#123456")])
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:-1], line]))
    with pytest.raises(ParameterError, match=rf"line {len(lines)}.*{words}"):
        read_tufting(path)
    assert math.isclose(UNIT, 1e-5)


def run(tmp_path: Path, *more: str) -> tuple[int, dict, str]:
    y, x = np.mgrid[0:90, 0:60]
    Image.fromarray(((x // 20 + y // 30) % 3 * 100).astype(np.uint8)).save(tmp_path / "blocks.png")
    common = ("weave", str(tmp_path / "blocks.png"), "--technique", "tufting", "--out", str(tmp_path / "out"))
    result = CliRunner().invoke(main, [*common, *more, "--force", "--json", str(tmp_path / "made.json")])
    data = json.loads((tmp_path / "made.json").read_text()) if result.exit_code in {0, 3} else {}
    return result.exit_code, data, result.output


def test_the_command_writes_programme_page_picture_and_report(tmp_path: Path) -> None:
    code, data, _ = run(tmp_path, "--size", "60x90cm")
    assert code == 0
    assert data["tufts"] is True
    assert data["misplaced"] == 0
    assert data["needle_strokes"] == 288 * 3 + 1
    assert data["tufting_time"] == pytest.approx(865 * 60 / 160 / 0.8)
    cost = data["tufting_cost"]
    assert 0 < cost["sum"] < cost["knotted"]
    assert cost["sum"] == pytest.approx(sum(cost[name] for name in cost if name not in {"sum", "knotted"}))
    assert {Path(file).name for file in data["files"]} == {"report.html", "carpet.png", "tufting.txt", "report.json"}
    seen, yarn = tufted((tmp_path / "out/tufting.txt").read_text())
    assert len(seen) == 189 * 288
    assert sum(own["tufts"] for own in data["tufting_colours"]) == 189 * 288
    assert sum(yarn.values()) / 1e3 == pytest.approx(data["tufted_yarn"], rel=1e-9)


@pytest.mark.parametrize(
    ("settings", "check"),
    [
        (("--tufting", "pattern.creel=2", "--colours", "3"), "colours on the creel"),
        (("--tufting", "pattern.attachment=groups"), "each yarn is fed as its loops need"),
        (("--tufting", "pattern.hidden=9mm"), "tufts off their colour"),
        (("--deadline", "1min"), "tufting time"),
    ],
)
def test_what_the_machine_cannot_do_is_a_failed_check(tmp_path: Path, settings: tuple[str, ...], check: str) -> None:
    code, data, _ = run(tmp_path, "--size", "60x90cm", *settings)
    assert code == 3
    assert check in {one["name"] for one in data["reasons"]}
    assert not (tmp_path / "out/tufting.txt").exists()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("--quality", "20x20/dm"), "gauge"),
        (("--tufting", "width=3m"), "--size"),
        (("--tufting", "pattern.colours=3"), "--colours"),
        (("--gun", "cones=3"), "--technique gun"),
        (("--heads", "2"), "--heads"),
        (("--tufting", "shift=0.3"), "half gauges"),
        (("--size", "10x20cm"), "0.2 m"),
    ],
)
def test_bad_input_is_one_clear_error(tmp_path: Path, settings: tuple[str, ...], words: str) -> None:
    code, _, output = run(tmp_path, *settings)
    assert code == 2
    assert words in output
    assert "Traceback" not in output
    assert not (tmp_path / "out").exists()
