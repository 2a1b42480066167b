"""The linkage editor in a real browser: a four-bar is drawn, a joint is dragged, what cannot close is reported."""

import json
import re
import tomllib

from playwright.sync_api import Page, expect
from processes import ilmek, printed, until
from studio_browser import Studio, data_of, middle, open_view, until_file, violations


def click_at(page: Page, x: float, y: float) -> None:
    """Click a position given from the middle of the canvas, y upward [px], and wait until it is drawn."""
    across, up = middle(page, ".linkage-canvas")
    page.mouse.click(across + x, up - y)


def tool(page: Page, letter: str, name: str) -> None:
    page.keyboard.press(letter)
    expect(page.get_by_role("button", name=name, exact=True)).to_have_attribute("aria-pressed", "true")


def degrees_of_freedom(page: Page, count: int, driven: int) -> None:
    facts = page.locator(".linkage-facts").first.locator("dd")
    expect(facts.nth(0)).to_have_text(str(count))
    expect(facts.nth(1)).to_have_text(str(driven))


def test_a_four_bar_is_drawn_with_the_mouse(page: Page, running: Studio) -> None:
    open_view(page, running, "linkage")
    page.get_by_role("button", name="New", exact=True).click()
    expect(page.locator(".linkage-next")).to_contain_text("Draw the first link")
    tool(page, "l", "Link")
    bars = (((-200, -100), (-200, 0)), ((-200, 0), (100, 120)), ((100, 120), (150, -100)))
    for number, ends in enumerate(bars, 1):
        for end in ends:
            click_at(page, *end)
        expect(page.locator(f"[data-body=link{number}]")).to_be_visible()
    degrees_of_freedom(page, 5, 0)
    tool(page, "o", "Ground pivot")
    click_at(page, -200, -100)
    click_at(page, 150, -100)
    degrees_of_freedom(page, 1, 0)
    tool(page, "d", "Drive")
    click_at(page, -200, -100)
    degrees_of_freedom(page, 1, 1)
    expect(page.locator(".linkage-groups li")).to_contain_text(["Driven", "Dyad RRR"])
    tool(page, "t", "Traced point")
    click_at(page, 0, 70)
    expect(page.locator(".linkage-path:not(.joint)")).to_have_count(1)
    page.keyboard.press("Escape")
    path = "linkages/linkage.toml"
    until(lambda: len(data_of(running.project, path)["bodies"].get("link2", {}).get("points", {})) == 3)
    data = data_of(running.project, path)
    assert "branches" not in data  # the drawing shows them
    assert data["inputs"] == {"A": "link1"}
    assert sorted(sorted(joint["pin"]) for joint in data["joints"].values()) == [
        ["ground", "link1"],
        ["ground", "link3"],
        ["link1", "link2"],
        ["link2", "link3"],
    ]
    report = json.loads(printed(ilmek("mechanism", path, "--json", "-"), cwd=running.project))
    assert report["results"]["mobility"] == "1 degree of freedom by count and by rank"


def test_a_joint_is_dragged_and_moved_by_keys(page: Page, running: Studio) -> None:
    open_view(page, running, "linkage/four-bar")
    file = running.project / "linkages/four-bar.toml"
    before, old = file.read_text(encoding="utf-8"), page.locator(".linkage-path:not(.joint)").get_attribute("d")
    saves: list[str] = []
    page.on("request", lambda request: saves.append(request.url) if request.method == "PUT" else None)
    x, y = middle(page, "[data-joint=A] .pin")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 30, y - 10, steps=6)
    expect(page.locator(".linkage-path:not(.joint)")).not_to_have_attribute("d", str(old))
    assert file.read_text(encoding="utf-8") == before
    page.mouse.up()
    until(lambda: file.read_text(encoding="utf-8") != before)
    expect(page.locator(".project-saved")).to_have_text("Saved")
    assert len(saves) == 1
    assert violations(page) == []
    page.keyboard.press("Control+z")
    until(lambda: file.read_text(encoding="utf-8") == before)
    expect(page.locator(".linkage-path:not(.joint)")).to_have_attribute("d", str(old))
    page.locator(".linkage-canvas").focus()
    for joint in ("A0", "A", "B", "B0"):
        page.keyboard.press("Tab")
        expect(page.locator(f"[data-joint={joint}]")).to_be_focused()
    page.keyboard.press("ArrowRight")
    until(lambda: file.read_text(encoding="utf-8") != before)
    moved, still = data_of(running.project, "linkages/four-bar.toml"), tomllib.loads(before)
    assert moved["bodies"]["ground"]["points"]["B0"] != still["bodies"]["ground"]["points"]["B0"]
    assert moved["bodies"]["crank"] == still["bodies"]["crank"]


FOUR_BAR = """name = "beside"
inputs = { A = "link1" }
branches = { C = 1 }

[bodies]
ground = { points = { A = [0, 0], D = ["100mm", 0] } }
link1 = { points = { A = [0, 0], B = ["30mm", 0] } }
link2 = { points = { B = [0, 0], C = ["90mm", 0] } }
link3 = { points = { D = [0, 0], C = ["60mm", 0] } }

[joints]
A.pin = ["ground", "link1"]
B.pin = ["link1", "link2"]
C.pin = ["link2", "link3"]
D.pin = ["ground", "link3"]
"""


def test_a_traced_point_is_put_anywhere_on_the_plane_of_a_link(page: Page, running: Studio) -> None:
    path = "linkages/beside.toml"
    (running.project / path).write_text(FOUR_BAR, encoding="utf-8")
    open_view(page, running, "linkage/beside")
    expect(page.locator("[data-body=link1]")).to_be_visible()

    def points(body: str) -> list[str]:
        return list(data_of(running.project, path)["bodies"][body]["points"])

    x, y = middle(page, "[data-joint=D] .pin")
    page.locator(".linkage-canvas").focus()
    tool(page, "t", "Traced point")
    page.mouse.click(x - 90, y + 60)  # nearest to the rocker, link3
    until(lambda: points("link3") == ["D", "C", "E"])
    expect(page.locator(".linkage-path:not(.joint)")).to_have_count(1)
    page.keyboard.press("Escape")
    page.get_by_role("tab", name="Parts").click()
    page.get_by_role("button", name="link2", exact=True).click()
    page.locator(".linkage-canvas").focus()
    tool(page, "t", "Traced point")
    page.mouse.click(x - 180, y + 120)  # in the plane of the coupler, which is chosen
    until(lambda: len(points("link2")) == 3)
    expect(page.locator(".linkage-path:not(.joint)")).to_have_count(2)
    expect(page.locator(".ui-toast")).to_have_count(0)


def test_a_mechanism_that_cannot_close_is_drawn_with_the_reason(page: Page, running: Studio) -> None:
    open_view(page, running, "linkage/watt-six-bar")
    page.get_by_role("tab", name="Parts").click()
    page.get_by_role("button", name="coupler", exact=True).click()
    length = page.get_by_label("length", exact=True)
    for typed, words, bodies, entry in (("20mm", "cannot close .*lengthen", 5, '"20mm"'), ("0", "above 0", 4, "0\n")):
        length.fill(typed)
        length.press("Enter")
        expect(page.locator(".linkage-panels .ui-callout.bad")).to_have_text(re.compile(words))
        expect(page.locator("[data-body]")).to_have_count(bodies)
        until_file(running.project, "linkages/watt-six-bar.toml", f"coupler.length = {entry}")
    page.get_by_role("button", name="Save as…").click()
    expect(page.get_by_role("dialog")).to_be_visible()
    assert violations(page) == []


def test_an_optional_key_is_added_and_a_point_is_chosen(page: Page, running: Studio) -> None:
    path = "linkages/slider-crank-press.toml"
    open_view(page, running, "linkage/slider-crank-press")
    page.get_by_role("tab", name="Parts").click()
    springs = page.locator(".linkage-numbers").filter(has_text="Springs")
    offered = springs.get_by_label("balance between point 1").locator("option").all_inner_texts()
    assert {"ground.S", "ram.T", "crank.A"} <= set(offered)
    assert {name.partition(".")[0] for name in offered} == set(data_of(running.project, path)["bodies"])
    springs.get_by_label("Add …").select_option("damping")
    expect(springs.get_by_label("balance damping")).to_have_value("1N*s/m")
    until(lambda: data_of(running.project, path)["springs"]["balance"].get("damping") == "1N*s/m")


def test_a_file_of_another_program_is_opened_and_moves(page: Page, running: Studio) -> None:
    """A slider-crank of Linkage, with a drawing element that has no equivalent."""
    places = {0: (0, 0, 'anchor="true" input="true"'), 1: (0, 40, ""), 2: (-200, 0, 'anchor="true"')}
    places |= {3: (200, 0, 'anchor="true"'), 4: (110, 0, 'slider="true"'), 5: (9, 9, 'layer="1"')}
    limits = '<slidelimit id="2"/><slidelimit id="3"/>'
    connectors = "".join(
        f'<connector id="{key}" x="{x}" y="{y}" {more}>{limits if key == 4 else ""}</connector>'
        for key, (x, y, more) in places.items()
    )
    links = "".join(
        f'<Link id="{key}"><connector id="{a}"/><connector id="{b}"/></Link>'
        for key, (a, b) in enumerate([(0, 1), (1, 4)])
    )
    open_view(page, running, "linkage")
    drawn = {"name": "crank.linkage2", "mimeType": "", "buffer": f"<linkage2>{connectors}{links}</linkage2>".encode()}
    page.locator("input[type=file]").set_input_files(drawn)  # type: ignore[arg-type]
    expect(page.get_by_text("drawing and measuring elements")).to_be_visible()
    expect(page.locator("[data-body=L1]")).to_be_visible()
    degrees_of_freedom(page, 1, 1)
    assert data_of(running.project, "linkages/crank.toml")["inputs"] == {"P0": "L0"}
