"""What is new or half-filled in a project is unfinished, what is written wrongly is an error."""

from pathlib import Path

import pytest

from ilmek.jobs.studio.project.check import FileError, file_error
from ilmek.jobs.studio.synthesis.task import is_unfinished
from ilmek.jobs.studio.words import in_page

GROUND = "name = 'half'\ninputs = {}\n\n[bodies]\nground = { points = { A = [0, 0] } }\n"
LINK = "link1 = { points = { A = [0, 0], B = ['50mm', 0] } }\n"
JOINT = "\n[joints]\nA.pin = ['ground', 'link1']\n"


def error_of(folder: Path, path: str, text: str) -> FileError | None:
    (folder / path).parent.mkdir(exist_ok=True)
    (folder / path).write_text(text, encoding="utf-8")
    return file_error(folder, path, text)


@pytest.mark.parametrize("text", [GROUND + LINK + "\n[joints]\n", GROUND + LINK + JOINT])
def test_a_linkage_without_joints_or_drive_is_unfinished(tmp_path: Path, text: str) -> None:
    error = error_of(tmp_path, "linkages/half.toml", text)
    assert error is not None
    assert error.unfinished


@pytest.mark.parametrize(
    "text",
    [
        GROUND + LINK.replace("50mm", "50kg") + JOINT,
        GROUND + LINK + JOINT.replace("link1", "link2"),
        GROUND + "colour = 3\n" + JOINT,
        "name = \n",
    ],
)
def test_a_linkage_that_cannot_be_read_is_an_error(tmp_path: Path, text: str) -> None:
    error = error_of(tmp_path, "linkages/half.toml", text)
    assert error is not None
    assert not error.unfinished


@pytest.mark.parametrize(
    ("machine", "setting", "text", "unfinished"),
    [
        ("path", "points", "", True),
        ("path", "points", "(0,0) (1mm,0) (2mm,1mm)", True),
        ("path", "points", "(0,0) (1mm,0) (2mm,1mm) (3mm,0)", False),
        ("path", "points", "(0,0) (1mm,x)", False),
        ("motion", "poses", " ", True),
        ("motion", "poses", "(0,0,0) (1mm,0,9deg)", True),
        ("motion", "poses", "(0,0,0) (1mm,0,9deg) (2mm,1mm,3deg)", False),
        ("motion", "poses", "(0,0) (1mm,0,9deg)", False),
        ("function", "samples", "(1,0)", True),
        ("function", "samples", "(1,0) (2,1)", False),
        ("beat-up", "points", "", False),
    ],
)
def test_a_task_with_too_few_points_is_unfinished(machine: str, setting: str, text: str, unfinished: bool) -> None:
    assert is_unfinished({"machine": f"{machine}-four-bar", "settings": {setting: text}}) is unfinished


def test_three_points_to_be_met_exactly_are_enough() -> None:
    settings = {"points": "(0,0) (1mm,0) (2mm,1mm)", "exact": True}
    assert not is_unfinished({"machine": "path-four-bar", "settings": settings})
    assert not is_unfinished({"machine": "path-four-bar", "settings": None})
    assert not is_unfinished({"machine": "path-four-bar", "settings": {}})


@pytest.mark.parametrize(
    ("sentence", "shown"),
    [
        ("no yarn; --fit offers crop", "no yarn; Fit offers crop"),
        ("the range: --over FROM..TO", 'the range: the range in "Motion"'),
        ("leave --no-such-option out", "leave such option out"),
        ("a - b -- c, x--y", "a - b -- c, x--y"),
    ],
)
def test_a_page_names_no_option_of_the_command_line(sentence: str, shown: str) -> None:
    assert in_page(sentence) == shown
