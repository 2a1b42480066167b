"""Synthesis in a real browser: a point is dragged and the candidates follow; one of them goes to the editor."""

import math
import re

import pytest
from playwright.sync_api import Page, expect
from studio_browser import Studio, data_of, middle, open_view, until_data, until_file, violations


def full_search_ended(page: Page) -> None:
    expect(page.locator(".ui-verdict").get_by_text("Full search", exact=True)).to_be_visible()
    expect(page.locator(".synthesis-card").first).to_be_visible()


def test_a_pose_is_dragged_and_undone(page: Page, running: Studio) -> None:
    open_view(page, running, "synthesis/flap")
    full_search_ended(page)
    path = "synthesis/flap.toml"
    before = data_of(running.project, path)
    x, y = middle(page, ".handle.point .dot", 2)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 20, y + 15, steps=5)
    page.mouse.up()
    until_data(running.project, path, lambda data: data != before)
    full_search_ended(page)
    assert violations(page) == []
    page.get_by_label("Undo (Ctrl+Z)").click()
    until_data(running.project, path, lambda data: data == before)


def test_a_point_is_moved_by_keys_and_a_limit_typed(page: Page, running: Studio) -> None:
    open_view(page, running, "synthesis/flat-d")
    path = "synthesis/flat-d.toml"
    before = data_of(running.project, path)["settings"]["points"]
    page.get_by_role("button", name=re.compile("^Point 1 at")).press("ArrowRight")
    page.get_by_role("radio", name="Limits").click()
    page.get_by_role("region", name="Task").get_by_label("Size at most", exact=True).fill("180mm")
    until_file(running.project, path, "180mm")
    assert data_of(running.project, path)["settings"]["points"] != before


def test_a_candidate_goes_to_the_editor(page: Page, running: Studio) -> None:
    open_view(page, running, "synthesis/square")
    full_search_ended(page)
    page.locator(".synthesis-card").last.click()
    page.get_by_role("button", name="To the linkage editor").click()
    page.wait_for_url(re.compile("#linkage/square"))
    assert data_of(running.project, "linkages/square.toml")["inputs"] == {"A0": "crank"}


def test_a_path_is_clicked_on_an_empty_plane(page: Page, running: Studio) -> None:
    open_view(page, running, "synthesis")
    page.get_by_role("button", name="New task").click()
    page.get_by_role("button", name="Create").click()
    page.wait_for_url(re.compile("#synthesis/path$"))
    expect(page.get_by_text("4 more points are needed")).to_be_visible()
    box = page.get_by_role("group", name="Plane of the task").bounding_box()
    assert box is not None
    for number, (x, y) in enumerate([(0.3, 0.6), (0.4, 0.45), (0.55, 0.4), (0.68, 0.48), (0.75, 0.62)], 1):
        page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])
        expect(page.get_by_role("button", name=re.compile(f"^Point {number} at"))).to_be_attached()
    full_search_ended(page)
    assert violations(page) == []
    points = data_of(running.project, "synthesis/path.toml")["settings"]["points"]
    assert points.count("(") == 5
    page.get_by_role("button", name="Remove all").click()
    expect(page.get_by_text("4 more points are needed")).to_be_visible()
    page.get_by_label("Undo (Ctrl+Z)").click()
    until_file(running.project, "synthesis/path.toml", points)


def test_poses_are_pressed_dragged_and_released(page: Page, running: Studio) -> None:
    """A drag gives a pose its direction, a click that of the way; the gallery has no power of ten."""
    path = "synthesis/dragged.toml"
    (running.project / path).write_text('machine = "motion-four-bar"\n\n[settings]\nposes = ""\n', encoding="utf-8")
    open_view(page, running, "synthesis/dragged")
    plane = page.get_by_role("group", name="Plane of the task")
    box = plane.bounding_box()
    assert box is not None

    def at(x: float, y: float) -> tuple[float, float]:
        return box["x"] + x * box["width"], box["y"] + y * box["height"]

    for (x, y), degrees in (((0.3, 0.6), 30), ((0.5, 0.4), -10)):
        to = math.radians(degrees)
        left, top = at(x, y)
        page.mouse.move(left, top)
        page.mouse.down()
        page.mouse.move(left + 80 * math.cos(to), top - 80 * math.sin(to), steps=6)
        page.mouse.up()
    expect(page.get_by_text("1 more pose is needed")).to_be_visible()
    page.mouse.click(*at(0.7, 0.65))
    full_search_ended(page)
    until_data(running.project, path, lambda data: data["settings"]["poses"].count("(") == 3)
    poses = data_of(running.project, path)["settings"]["poses"]
    (_, _, first), (x2, y2, second), (x3, y3, third) = re.findall(r"\(([^,]+),([^,]+),([^)]+)\)", poses)
    assert float(first.removesuffix("deg")) == pytest.approx(30, abs=1)
    assert float(second.removesuffix("deg")) == pytest.approx(-10, abs=1)
    way = math.atan2(*(float(b.removesuffix("mm")) - float(a.removesuffix("mm")) for a, b in ((y2, y3), (x2, x3))))
    assert float(third.removesuffix("deg")) == pytest.approx(math.degrees(way), abs=1)
    assert not re.search(r"\d[eE][-−]\d", page.locator(".synthesis-gallery").inner_text())
    before = poses
    page.get_by_role("button", name=re.compile("^Direction of pose 1")).press("ArrowUp")
    until_data(running.project, path, lambda data: data["settings"]["poses"] != before)
    turned = re.findall(r",([^,)]+)deg\)", data_of(running.project, path)["settings"]["poses"])[0]
    assert float(turned) == pytest.approx(float(first.removesuffix("deg")) + 1, abs=1e-6)
    assert violations(page) == []
