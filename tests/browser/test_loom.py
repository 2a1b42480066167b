"""The loom in a real browser: its parts, its motion, a run of the twin, and what is shown where it cannot be drawn."""

import io
import json
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, Route, expect
from processes import until
from studio_browser import PATIENCE, Seen, Studio, context_of, open_view, settled, studio, violations

from ilmek.jobs.loom_space import loom_in_space
from ilmek.jobs.studio.loom.scene import project_loom
from ilmek.viz.loom_page import LoomPage, loom_page

LOOM = """machine = "automated-loom"

[settings]
width = "0.3 m"
length = "0.4 m"
beat = "travelling"
"""
RECIPE = 'picture = "pictures/small.png"\nsize = "20x30cm"\nquality = "20x20/dm"\ncolours = 2\n'
FAILED = "weft: opening of the shed for the carrier"
NO_WEBGL = """const context = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind === "webgl2" ? null : context.call(this, kind, ...rest);
};"""
SHED_OPEN = 21
"""Master angle at which the first shed is open [deg]."""


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """A studio on a project with a small carpet, a small loom, and one that fails its checks."""
    folder = tmp_path_factory.mktemp("studio") / "project"
    (folder / "pictures").mkdir(parents=True)
    (folder / "machines").mkdir()
    pixels = np.zeros((12, 16, 3), np.uint8)
    pixels[:, ::2] = (180, 30, 30)
    Image.fromarray(pixels).save(folder / "pictures" / "small.png")
    (folder / "carpet.toml").write_text(RECIPE)
    (folder / "machines" / "loom.toml").write_text(LOOM)
    (folder / "machines" / "weak-loom.toml").write_text(LOOM + 'lift = "8 mm"\n')
    with studio(folder) as one:
        yield one


def picture(page: Page) -> np.ndarray:
    """The picture, after what waits has been drawn."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return np.asarray(Image.open(io.BytesIO(page.locator(".loom canvas").screenshot())).convert("RGB"), float)


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """Share of the pixels that differ."""
    return float((np.abs(after - before).max(axis=2) > 24).mean())


def until_changed(page: Page, before: np.ndarray, share: float) -> np.ndarray:
    """The picture once more than a share of its pixels differ: a busy machine draws late."""
    taken = [before]

    def differs() -> bool:
        taken[0] = picture(page)
        return changed(before, taken[0]) > share

    until(differs, f"{share:.0%} of the picture changed")
    return taken[0]


def until_drawn(page: Page) -> None:
    """Wait until the picture is a fine one, and no further one is drawn for some time."""
    canvas, counts = page.locator(".loom canvas"), [""]

    def rests() -> bool:
        expect(canvas).to_have_attribute("data-fine", "true")
        before = canvas.get_attribute("data-pictures") or ""
        page.wait_for_timeout(300)
        counts.append(canvas.get_attribute("data-pictures") or "")
        return counts[-1] == before

    until(rests, lambda: f"pictures are drawn though nothing changes: {counts[-3:]}")


def listed(page: Page) -> Locator:
    """The list of the parts."""
    return page.locator(".loom-parts select")


def fact(page: Page, name: str) -> str:
    return page.locator(".loom-facts div", has=page.get_by_text(name, exact=True)).locator("dd").inner_text()


def until_fact(page: Page, name: str, shown: str | re.Pattern[str]) -> None:
    row = page.locator(".loom-facts div", has=page.get_by_text(name, exact=True))
    expect(row.locator("dd")).to_have_text(shown, timeout=PATIENCE)


def knots(page: Page) -> int:
    return int(fact(page, "Knots").split(" of ")[0].replace(",", ""))


def until_more_knots(page: Page, than: int) -> int:
    page.wait_for_function(
        """than => {
          const row = [...document.querySelectorAll(".loom-run .loom-facts div")]
            .find(one => one.querySelector("dt").textContent === "Knots");
          return row && Number(row.querySelector("dd").textContent.split(" of ")[0].replace(",", "")) > than;
        }""",
        arg=than,
        timeout=PATIENCE,
    )
    return knots(page)


def test_a_part_has_the_numbers_of_the_design_and_its_drawing(page: Page, running: Studio) -> None:
    open_view(page, running, "loom/machines/loom.toml")
    page.get_by_role("tab", name="Parts").click()
    listed(page).select_option("shedding/shedding-cam")
    expect(page.get_by_role("heading", name="Shedding cam")).to_be_visible()
    design = page.evaluate(
        """async () => (await fetch("/api/machines/automated-loom/design", {method: "POST",
          headers: {"content-type": "application/json"},
          body: JSON.stringify({settings: {width: "0.3 m", length: "0.4 m", beat: "travelling"}})})).json()"""
    )
    checks = {one["name"]: one for one in design["checks"]}
    shown = page.locator(".loom-checks li")
    assert shown.count() > 0
    for name, words in [one.split("\n") for one in shown.all_inner_texts()]:
        assert ": holds" in words if checks[name]["ok"] else ": fails" in words
        if checks[name]["unit"] == "1":
            assert words.startswith(f"{checks[name]['value']:.4g} ")
    expect(page.locator(".loom-holding li").last).to_contain_text("which stands on the floor")
    drawing = page.locator(".loom-plate svg path")
    expect(drawing).to_be_visible(timeout=PATIENCE)
    box = drawing.evaluate("path => { const box = path.getBBox(); return [box.height, box.width] }")
    extents = [float(number) for number in re.findall(r"[\d.]+", fact(page, "Width × height × depth"))]
    assert [1000 * one for one in box] == pytest.approx(extents[1:], abs=0.2)
    assert violations(page) == []


def test_the_pairs_that_come_nearest_are_listed_and_shown_by_a_press(page: Page, running: Studio) -> None:
    open_view(page, running, "loom/machines/loom.toml")
    page.get_by_role("tab", name="Clearances").click()
    pairs = page.locator(".loom-nearest li")
    expect(pairs.first).to_be_visible(timeout=PATIENCE)
    compared = page.evaluate(
        """async () => (await fetch("/api/loom/space", {method: "POST",
          headers: {"content-type": "application/json"},
          body: JSON.stringify({file: "machines/loom.toml"})})).text()"""
    )
    nearest = json.JSONDecoder().raw_decode(compared, compared.index("{"))[0]["nearest"]
    shown = [float(re.sub(r"[^-.\d]", "", text.replace("−", "-"))) for text in pairs.locator("b").all_inner_texts()]
    assert shown == pytest.approx([1000 * pair["distance"] for pair in nearest], rel=1e-3)
    numbers = [k for k, pair in enumerate(nearest) if pair["cyclogram"] in {"row", "knot"} and pair["angle"] > 0.01]
    before = picture(page)
    pairs.nth(numbers[0]).get_by_role("button").click()
    until_changed(page, before, 0.2)
    angle = round(np.degrees(nearest[numbers[0]]["angle"]) * 2) / 2
    assert float(page.get_by_label("Master angle").input_value()) == pytest.approx(np.radians(angle), abs=0.01)
    assert violations(page) == []


def _is_picked_by_its_label(page: Page, label: Locator) -> bool:
    """Whether a click on the point that a label names shows the part of that name; another may stand before it."""
    name, box = label.inner_text().removeprefix("⚠ "), label.bounding_box()
    assert box is not None
    page.mouse.click(box["x"] - 6, box["y"] + 10)
    expect(page.locator(".loom-part h2")).to_have_text(re.compile(r"\w"))
    return page.locator(".loom-part h2").inner_text().casefold().startswith(name.casefold())


def test_the_picture_is_turned_scrubbed_and_worked_by_keys(page: Page, running: Studio) -> None:
    open_view(page, running, "loom")
    page.get_by_role("button", name="Shed", exact=True).click()
    angle, canvas = page.get_by_label("Master angle"), page.get_by_role("application", name="The loom in space")
    angle.fill("0")
    until_drawn(page)
    closed = picture(page)
    angle.fill(str(round(SHED_OPEN / 0.5) * np.pi / 360))
    expect(angle).to_have_attribute("aria-valuetext", re.compile(f"^{SHED_OPEN}°"))
    opened = until_changed(page, closed, 0.01)
    canvas.focus()
    page.keyboard.press(".")
    expect(angle).to_have_attribute("aria-valuetext", re.compile(f"^{SHED_OPEN + 1}°"))
    page.keyboard.press("Home")
    whole = until_changed(page, opened, 0.2)
    for keys in ("ArrowLeft", "+", "Shift+ArrowUp"):
        page.keyboard.press(keys)
        whole = until_changed(page, whole, 0.02)
    page.keyboard.press("PageDown")
    expect(page.get_by_role("tab", name="Parts")).to_have_attribute("aria-selected", "true")
    first = page.locator(".loom-parts option").first
    assert listed(page).input_value() == first.get_attribute("value")
    page.get_by_role("tab", name="Picture").click()
    page.get_by_text("Names in the picture").click()
    labels = page.locator(".loom-labels span")
    expect(labels.first).to_be_visible()
    assert any(_is_picked_by_its_label(page, label) for label in labels.all())
    page.get_by_role("tab", name="Picture").click()
    page.get_by_label("Section").select_option("x")
    cut = until_changed(page, whole, 0.05)
    page.get_by_label("Explode").fill("0.6")
    until_changed(page, cut, 0.05)
    until_drawn(page)


def test_a_run_is_held_found_again_after_a_reload_and_stopped(page: Page, running: Studio) -> None:
    open_view(page, running, "loom")
    page.get_by_role("tab", name="Run of the twin").click()
    page.get_by_role("button", name="Start").click()
    until_more_knots(page, 3)
    assert fact(page, "State") == "Execute"
    page.get_by_role("button", name="Hold").click()
    until_fact(page, "State", "Held")
    held = knots(page)
    page.wait_for_timeout(400)
    assert knots(page) == held
    page.get_by_role("button", name="Resume").click()
    resumed = until_more_knots(page, held)
    page.reload()
    until_fact(page, "State", "Execute")
    found = until_more_knots(page, resumed)
    open_view(page, running, "files")
    open_view(page, running, "loom")
    until_more_knots(page, found)
    page.get_by_role("button", name="Stop").click()
    until_fact(page, "State", "Stopped")
    expect(page.get_by_role("status").filter(has_text=re.compile(r"^Woven: [\d,]+ knots, 0 faults"))).to_be_visible()
    expect(page.get_by_role("button", name="Start")).to_be_visible()
    assert violations(page) == []


def test_a_view_that_was_left_keeps_no_memory(page: Page, running: Studio) -> None:
    printed: list[str] = []
    page.on("console", lambda message: printed.append(message.text))
    open_view(page, running, "loom")
    protocol = page.context.new_cdp_session(page)

    def used() -> float:
        """Memory after so many visits, in MB."""
        protocol.send("HeapProfiler.collectGarbage")
        usage = protocol.send("Runtime.getHeapUsage")
        return float(usage["usedSize"] + usage.get("backingStorageSize", 0)) / 1e6

    sizes = []
    for _ in range(7):
        open_view(page, running, "files")
        settled(page)  # a request that is under way keeps what its view had
        sizes.append(used())
        open_view(page, running, "loom")
        settled(page)
    assert sizes[-1] - sizes[2] < 2.0, sizes
    assert [one for one in printed if "WebGL" in one] == []


def test_the_page_of_a_loom_needs_no_server(browser: Browser, running: Studio, tmp_path: Path) -> None:
    loom = project_loom(running.project, "machines/loom.toml")
    space = loom_in_space(loom.design, loom.report, None)
    assert space is not None
    file = tmp_path / "loom.html"
    file.write_text(loom_page(LoomPage("Loom", "1 m", "report.html", space=space)))
    seen = Seen()
    with context_of(browser, width=390, height=844, dark=True) as context:
        page = context.new_page()
        seen.watch(page, file.as_uri())
        page.goto(file.as_uri())
        expect(page.locator(".loom canvas")).to_have_attribute("data-pictures", re.compile(r"\d"), timeout=PATIENCE)
        page.get_by_role("tab", name="Parts").click()
        listed(page).select_option("beat-up/crank")
        crank = next(part for part in loom.scene.parts if part.name == "beat-up/crank")
        assert fact(page, "Material") == crank.material
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        assert violations(page) == []
    assert seen.faults == []


def test_without_webgl_the_parts_are_listed(browser: Browser, running: Studio, seen: Seen) -> None:
    with context_of(browser, width=390, height=844) as context:
        context.add_init_script(NO_WEBGL)
        page = context.new_page()
        seen.watch(page, running.base)
        open_view(page, running, "loom/machines/loom.toml")
        expect(page.get_by_text("WebGL 2 is off or missing")).to_be_visible()
        listed(page).select_option("beat-up/crank")
        assert float(fact(page, "Mass of one").split()[0]) > 0
        assert violations(page) == []
    assert seen.faults == []


def test_a_loom_that_fails_its_checks_is_shown_with_the_parts_concerned(page: Page, running: Studio) -> None:
    open_view(page, running, "loom/machines/weak-loom.toml")
    failures = page.get_by_label("Checks that fail")
    expect(failures.get_by_text(FAILED)).to_be_visible()
    failures.get_by_role("button", name="shuttle").first.click()
    expect(page.locator(".loom-checks li.bad").filter(has_text=FAILED)).to_contain_text("fails")
    marked = page.locator(".loom-parts option").filter(has_text="⚠ shuttle (")
    assert marked.count() == 2  # one for each weft
    assert violations(page) == []


def test_a_project_without_a_loom_says_what_to_do(page: Page, running: Studio) -> None:
    def without_looms(route: Route) -> None:
        summary = route.fetch().json()
        route.fulfill(body=json.dumps({**summary, "files": []}), content_type="application/json")

    page.route(re.compile(r"/api/project(\?|$)"), without_looms)
    page.goto("about:blank")
    open_view(page, running, "loom")
    expect(page.get_by_role("button", name="Design an automated loom")).to_be_visible()
    expect(page.get_by_role("button", name="Choose a carpet")).to_be_visible()


def test_the_loom_is_saved_as_glb(page: Page, running: Studio, tmp_path: Path) -> None:
    open_view(page, running, "loom/machines/loom.toml")
    with page.expect_download(timeout=PATIENCE) as download:
        page.get_by_role("button", name="Save as GLB").click()
    download.value.save_as(tmp_path / "loom.glb")
    assert (tmp_path / "loom.glb").read_bytes()[:4] == b"glTF"
