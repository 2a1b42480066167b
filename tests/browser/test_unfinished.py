"""Every empty and half-filled state of every view: no error in red, no option of a command line, no false sentence.

One studio and one page show all states of a project; a second studio shows a project of one empty recipe.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Browser, Page, expect
from studio_browser import VIEWS, Seen, context_of, settled, studio

OPTION = re.compile(r"(?<![\w-])--[a-z]\S*")
RED = ".ui-callout.bad:visible, [role=alert]:visible:not(:empty), .ui-badge.bad:visible, .ui-toast.bad:visible"

BARS = """
[bodies]
ground = { points = { A = [0, 0], D = ["100mm", 0] } }
link1 = { points = { A = [0, 0], B = ["30mm", 0] } }
link2 = { points = { B = [0, 0], C = ["90mm", 0] }MASS }
link3 = { points = { D = [0, 0], C = ["60mm", 0] } }

[joints]
A.pin = ["ground", "link1"]
B.pin = ["link1", "link2"]
C.pin = ["link2", "link3"]
D.pin = ["ground", "link3"]
"""
LOAD = '\n[loads]\nforce1 = { force = "100N", direction = "-90deg", on = "link3.C" }\n'
FREE = '\n[bodies]\nground = {}\nlink1 = { points = { A = [0, 0], B = ["50mm", "20mm"] } }\n\n[joints]\n'
PIVOTED = '\n[bodies]\nground = { points = { A = [0, 0] } }\nlink1 = { points = { A = [0, 0], B = ["50mm", 0] } }\n'


def linkage(bodies: str, *, mass: str = "", drive: str = "") -> str:
    return f'name = "half"\ninputs = {{{drive}}}\nbranches = {{ C = 1 }}\n{bodies.replace("MASS", mass)}'


def task(machine: str, name: str, points: str) -> str:
    return f'machine = "{machine}-four-bar"\n\n[settings]\n{name} = "{points}"\n'


DRIVEN, MASS = ' A = "link1" ', ', mass = "1kg"'


@dataclass(frozen=True)
class State:
    """A file and what its view says of it.

    view    the address      says, never  texts that the view has, and has not
    tab     a panel that is opened first
    """

    text: str
    view: str
    says: tuple[str, ...] = ()
    never: tuple[str, ...] = ()
    tab: str = ""


STARTED_YARNS = '[[yarn]]\nname = "ivory"\nsrgb = "#efe6d2"\n\n[[yarn]]\nname = "dark red"\nsrgb = "#7a1f24"\n'
NO_CHECKS = "No checks: nothing has a mass"
NO_LIMITS = "No checks: the forces are known"
MOTION_ONLY, SPEED = "motion only: for forces give", 'give the speed in "Motion"'
STATES = {
    "linkages/empty.toml": State(
        'name = "empty"\ninputs = {}\n\n[bodies]\nground = {}\n\n[joints]\n', "linkage/empty", ("Draw the first link",)
    ),
    "linkages/free.toml": State(
        linkage(FREE).replace("branches = { C = 1 }\n", ""), "linkage/free", ("Attach a link to the ground",)
    ),
    "linkages/pivoted.toml": State(
        linkage(PIVOTED + '\n[joints]\nA.pin = ["ground", "link1"]\n').replace("branches = { C = 1 }\n", ""),
        "linkage/pivoted",
        ("Choose Drive",),
    ),
    "linkages/undriven.toml": State(linkage(BARS), "linkage/undriven", ("Choose Drive",), (NO_CHECKS,), "Checks"),
    "linkages/driven.toml": State(
        linkage(BARS, drive=DRIVEN), "linkage/driven", (MOTION_ONLY,), (NO_LIMITS,), "Checks"
    ),
    "linkages/mass.toml": State(
        linkage(BARS, drive=DRIVEN, mass=MASS), "linkage/mass", (SPEED,), (NO_CHECKS, MOTION_ONLY), "Checks"
    ),
    "linkages/load.toml": State(
        linkage(BARS + LOAD, drive=DRIVEN), "linkage/load", (SPEED,), (NO_CHECKS, MOTION_ONLY), "Checks"
    ),
    "linkages/both.toml": State(
        linkage(BARS + LOAD, drive=DRIVEN, mass=MASS), "linkage/both", (SPEED,), (NO_CHECKS, MOTION_ONLY), "Checks"
    ),
    "linkages/named.toml": State(
        linkage(BARS + LOAD, drive=DRIVEN),
        "linkage/named",
        ("force1 on",),
        ("force1 on body", "force1 on x"),
        "Parts",
    ),
    "synthesis/path.toml": State(task("path", "points", ""), "synthesis/path", ("4 more points are needed",)),
    "synthesis/path-3.toml": State(
        task("path", "points", "(0mm,0mm) (20mm,9mm) (40mm,0mm)"), "synthesis/path-3", ("1 more point is needed",)
    ),
    "synthesis/motion.toml": State(task("motion", "poses", ""), "synthesis/motion", ("3 more poses are needed",)),
    "synthesis/motion-1.toml": State(
        task("motion", "poses", "(0mm,0mm,0deg)"), "synthesis/motion-1", ("2 more poses are needed",)
    ),
    "synthesis/function.toml": State(
        'machine = "function-four-bar"\n\n[settings]\nfunction = "x^2"\n', "synthesis/function", ("within all limits",)
    ),
    "synthesis/one-angle.toml": State(
        task("motion", "poses", "(-29mm,-9.5mm,0deg) (0mm,14.5mm,0deg) (29mm,-5mm,0deg)"),
        "synthesis/one-angle",
        ("Left out:", "whose least transmission angle is below 1°"),
    ),
    "cyclograms/track.toml": State(
        'name = "machine"\nperiod = "1s"\n\n[tracks.slide]\nunit = "mm"\n', "cyclogram/track"
    ),
    "machines/new.toml": State('machine = "beat-up"\n\n[settings]\n', "machine/new"),
    "yarns/new.toml": State(STARTED_YARNS, "files/yarns/new.toml"),
    "carpet.toml": State('plain = "ivory"\nsize = "20x30cm"\nquality = "20x20/dm"\n', "carpet", tab="Result"),
    "small.toml": State(
        'picture = "wide.png"\nsize = "20x30cm"\nquality = "20x20/dm"\n',
        "carpet/small",
        ("Fit offers crop",),
        tab="Result",
    ),
}


@pytest.fixture(scope="module")
def half(tmp_path_factory: pytest.TempPathFactory, browser: Browser) -> Iterator[tuple[Page, Seen]]:
    """A page on a project in which every file is new, empty or half of what it is to be."""
    folder = Path(tmp_path_factory.mktemp("half")) / "project"
    for path, state in STATES.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(state.text, encoding="utf-8")
    Image.new("RGB", (90, 30), "#7a1f24").save(folder / "wide.png")
    with studio(folder) as running, context_of(browser) as context:
        page, seen = context.new_page(), Seen()
        seen.watch(page, running.base)
        page.goto(running.address)
        yield page, seen


def shown(page: Page) -> str:
    """The text of the page without commands, which are shown as such."""
    return str(
        page.evaluate(
            """() => {
              const copy = document.body.cloneNode(true);
              for (const part of copy.querySelectorAll("pre, code, script")) part.remove();
              document.body.append(copy);
              const text = copy.innerText;
              copy.remove();
              return text;
            }"""
        )
    )


def nothing_wrong(page: Page, seen: Seen) -> str:
    """The text shown, once it is known that nothing in it is red or from a command line."""
    assert page.locator(RED).all_inner_texts() == []
    text = shown(page)
    assert OPTION.findall(text) == []
    assert seen.faults == []
    return text


@pytest.mark.matrix(light=8)
@pytest.mark.parametrize("path", STATES)
def test_a_new_or_half_filled_file_is_shown_as_what_it_is(half: tuple[Page, Seen], path: str) -> None:
    page, seen = half
    state = STATES[path]
    page.evaluate(f"location.hash = '#{state.view}'")
    page.wait_for_selector(f"main[data-view='{state.view.split('/')[0]}'][data-ready='true']")
    if state.tab:
        page.get_by_role("tab", name=state.tab).click()
    for words in state.says:
        expect(page.locator("body")).to_contain_text(words)
    settled(page)
    text = nothing_wrong(page, seen)
    for words in state.never:
        assert words not in text


@pytest.mark.parametrize("kind", ["A path: points", "A motion: poses", "A function"])
def test_a_new_task_begins_without_an_error(half: tuple[Page, Seen], kind: str) -> None:
    page, seen = half
    page.evaluate("location.hash = '#synthesis'")
    page.get_by_role("button", name="New task").click()
    page.get_by_role("radio", name=kind).check(force=True)
    page.get_by_role("button", name="Create").click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    settled(page)
    nothing_wrong(page, seen)


def test_the_list_of_files_marks_what_is_not_finished(half: tuple[Page, Seen]) -> None:
    page, seen = half
    page.evaluate("location.hash = '#files'")
    unfinished = page.get_by_role("button", name="not finished")
    expect(unfinished.first).to_be_visible()
    settled(page)
    nothing_wrong(page, seen)
    named = {text.split("\n")[0] for text in unfinished.all_inner_texts()}
    assert named >= {"free", "pivoted", "undriven", "path", "path-3", "motion", "motion-1"}
    assert not named & {"empty", "driven", "mass", "function", "one-angle"}


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory, browser: Browser) -> Iterator[tuple[Page, Seen, Path]]:
    """A page on a project of one recipe, whose picture is missing."""
    folder = Path(tmp_path_factory.mktemp("bare")) / "project"
    folder.mkdir()
    (folder / "carpet.toml").write_text('picture = "gone.png"\nsize = "20x30cm"\nquality = "20x20/dm"\n')
    with studio(folder) as running, context_of(browser) as context:
        page, seen = context.new_page(), Seen()
        seen.watch(page, running.base)
        page.goto(running.address)
        yield page, seen, folder


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("view", VIEWS)
def test_a_missing_picture_is_named_and_nothing_else_is_wrong(bare: tuple[Page, Seen, Path], view: str) -> None:
    page, seen, _ = bare
    page.evaluate(f"location.hash = '#{view}'")
    page.wait_for_selector(f"main[data-view='{view}'][data-ready='true']")
    settled(page)
    for words in page.locator(RED).all_inner_texts():
        assert "gone.png" in words or words == "error in line 1"
    assert OPTION.findall(shown(page)) == []
    assert seen.faults == []


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("view", VIEWS)
def test_a_project_without_files(bare: tuple[Page, Seen, Path], view: str) -> None:
    page, seen, folder = bare
    (folder / "carpet.toml").unlink(missing_ok=True)
    page.evaluate(f"location.hash = '#{view}'")
    page.wait_for_selector(f"main[data-view='{view}'][data-ready='true']")
    expect(page.locator(RED)).to_have_count(0)  # the page has heard of the deletion
    settled(page)
    nothing_wrong(page, seen)
