"""Records in a notebook and in files, and a mechanism judged: read back by parsers of other make."""

import csv
import json
import re
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import ilmek
from ilmek.errors import ParameterError
from ilmek.linkage import Mechanism, Rotation
from ilmek.units import deg

FOUR_BAR = ilmek.four_bar(0.300, 0.0597, 0.2007, 0.2308, points={"coupler": {"P": 0.2 - 0.1j}})
SVG = "{http://www.w3.org/2000/svg}"


def motion() -> ilmek.Motion:
    return ilmek.solve(FOUR_BAR, np.linspace(0, 6, 25), speed="150rpm")


def cam() -> ilmek.PlateCam:
    parts = ilmek.rise("90deg", 0.04), ilmek.fall("90deg", 0.04), ilmek.dwell("180deg")
    return ilmek.plate_cam(ilmek.cam_programme(*parts), roller_radius=0.01)


def chart() -> ilmek.Chart:
    return ilmek.make_chart("examples/medallion.png", "30x40cm", "10x10/dm", colours=4)


class Tags(HTMLParser):
    """The tags of a page and its texts; every tag that is opened is closed."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.opened: list[str] = []
        self.seen: list[str] = []
        self.texts: list[str] = []
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:  # noqa: ARG002 - the signature of the parser
        self.seen.append(tag)
        if tag not in ("img", "br", "meta", "path", "line", "circle", "rect", "polyline", "polygon"):
            self.opened.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:  # noqa: ARG002 - the signature of the parser
        self.seen.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if self.opened and self.opened[-1] == tag:
            self.opened.pop()

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


SHOWN: dict[str, Callable[[], object]] = {
    "mechanism": lambda: FOUR_BAR,
    "judged": lambda: ilmek.judged(FOUR_BAR),
    "motion": motion,
    "forces": lambda: ilmek.inverse_dynamics(motion(), {"rocker": ilmek.bar(0, 0.23, mass=0.4)}),
    "run": lambda: ilmek.forward_dynamics(FOUR_BAR, {"crank": ilmek.bar(0, 0.06, mass=0.4)}, 0.1, speed=10),
    "programme": lambda: cam().programme,
    "cam": cam,
    "plot": lambda: motion().plot("rocker angle", "coupler angle"),
    "report": lambda: ilmek.design("cam"),
    "machine run": lambda: ilmek.run_machine(FOUR_BAR, speed="150rpm", steps=36),
}


@pytest.mark.parametrize("kind", SHOWN)
def test_a_record_shows_a_picture_in_a_notebook(kind: str) -> None:
    page = SHOWN[kind]()._repr_html_()  # type: ignore[attr-defined]
    tags = Tags(page)
    assert tags.opened == []
    assert "svg" in tags.seen
    assert any(mark in tags.seen for mark in ("path", "polyline", "polygon", "line"))


def test_a_chart_shows_its_carpet() -> None:
    assert re.match(r'<img alt="carpet" src="data:image/png;base64,iVBOR', chart()._repr_html_() or "")


def test_a_mechanism_that_closes_nowhere_shows_its_text() -> None:
    assert ilmek.four_bar(1.0, 0.1, 0.1, 0.1)._repr_html_() is None


def test_a_mechanism_of_two_inputs_shows_its_pose() -> None:
    pins = [ilmek.Pin("A", "ground", "arm"), ilmek.Pin("B", "arm", "hand")]
    bodies = [
        ilmek.Body("ground", {"A": 0}),
        ilmek.Body("arm", {"A": 0, "B": 0.3}),
        ilmek.Body("hand", {"B": 0.3, "C": 0.5}),
    ]
    arm = Mechanism(bodies, pins, (Rotation("arm", "A"), Rotation("hand", "B")))
    assert "svg" in Tags(arm._repr_html_() or "").seen


def test_a_mechanism_states_its_class_and_circuits() -> None:
    page = " ".join(Tags(FOUR_BAR._repr_html_() or "").texts)
    assert "crank-rocker" in page
    assert "a full turn" in page


def test_columns_are_written_as_they_are(tmp_path: Path) -> None:
    motion().save(tmp_path / "motion.csv")
    with (tmp_path / "motion.csv").open(encoding="utf-8") as stream:
        heads, *rows = list(csv.reader(stream))
    for number, (heading, values) in enumerate(motion().table().items()):
        assert heads[number] == heading
        assert np.array_equal([float(row[number]) for row in rows], values)


def test_a_picture_is_written_as_svg(tmp_path: Path) -> None:
    cam().save(tmp_path / "cam.svg")
    assert ET.parse(tmp_path / "cam.svg").getroot().tag == f"{SVG}svg"


def test_a_report_is_written_as_page_and_json(tmp_path: Path) -> None:
    report = ilmek.design("cam")
    report.save(tmp_path / "cam.html")
    report.save(tmp_path / "cam.json")
    assert json.loads((tmp_path / "cam.json").read_text())["results"]["prime_radius"] == report.number("prime_radius")
    assert "<title>" in (tmp_path / "cam.html").read_text()
    assert report.figure("cam-displacement") in report.figures


def test_a_form_that_a_record_has_not_is_named(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"\.pdf for a PlateCam; \.svg"):
        cam().save(tmp_path / "cam.pdf")


def test_a_plot_has_one_unit() -> None:
    with pytest.raises(ParameterError, match="choose columns of one unit"):
        motion().plot("rocker angle", "rocker omega")


# a mechanism judged, against closed forms


def test_a_four_bar_is_judged_as_by_the_law_of_cosines() -> None:
    judged = ilmek.judged(FOUR_BAR)
    g, a, b, c = 0.300, 0.0597, 0.2007, 0.2308
    ends = [np.arccos((b**2 + c**2 - reach**2) / (2 * b * c)) for reach in (g - a, g + a)]
    assert judged.transmission.angle == pytest.approx(min(min(end, np.pi - end) for end in ends), abs=1e-9)
    outer, inner = (np.arccos((g**2 + c**2 - reach**2) / (2 * g * c)) for reach in (a + b, b - a))
    back, front = judged.limits("rocker")
    assert back.value - front.value == pytest.approx(outer - inner, abs=1e-9)
    crank = [np.arccos((g**2 + reach**2 - c**2) / (2 * g * reach)) for reach in (a + b, b - a)]
    stroke = np.pi + abs(crank[0] - crank[1])
    ratio = stroke / (2 * np.pi - stroke)
    assert judged.time_ratio("rocker") == pytest.approx(max(ratio, 1 / ratio), abs=1e-9)


def test_a_slider_crank_is_judged() -> None:
    judged = ilmek.judged(ilmek.slider_crank(0.1, 0.3, offset=0.05))
    with pytest.raises(ilmek.IlmekError, match="no Grashof class"):
        _ = judged.grashof
    far, near = np.sqrt(0.4**2 - 0.05**2), np.sqrt(0.2**2 - 0.05**2)
    values = sorted(limit.value for limit in judged.limits("line"))
    assert values == pytest.approx([near, far], abs=1e-9)


def test_tolerances_of_a_judged_linkage_are_those_of_small_changes() -> None:
    judged = ilmek.judged(FOUR_BAR)
    lengths = dict(ground=0.300, crank=0.0597, coupler=0.2007, rocker=0.2308)
    exact = judged.sensitivity("rocker").value[:, 300]
    value = judged.motion.drives["crank"].value[300]
    steps = [
        ilmek.solve(ilmek.four_bar(**(lengths | {link: lengths[link] + step})), value).angle("rocker")[0]
        for link in lengths
        for step in (1e-6, -1e-6)
    ]
    differences = (np.array(steps[::2]) - np.array(steps[1::2])) / 2e-6
    points = [dimension.body for dimension in judged.dimensions]
    assert points == ["ground", "crank", "coupler", "coupler", "coupler", "rocker"]
    links = [points.index(link) for link in lengths]
    assert exact[links] == pytest.approx(differences, abs=1e-5)


def test_a_rocking_input_has_its_range() -> None:
    judged = ilmek.judged(ilmek.four_bar(0.300, 0.200, 0.2007, 0.2308))
    assert not judged.turns
    assert np.array(judged.range) / deg == pytest.approx([-117.922, 117.922], abs=1e-3)
    with pytest.raises(ilmek.IlmekError, match="a time ratio is of two limits in a full turn"):
        judged.time_ratio("rocker")


def test_an_unknown_output_offers_the_nearest() -> None:
    with pytest.raises(ilmek.IlmekError, match="did you mean 'rocker'"):
        ilmek.judged(FOUR_BAR).limits("roker")
