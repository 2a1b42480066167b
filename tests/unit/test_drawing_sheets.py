"""Drawing sheets, judged by readers of another make: PDFium finds texts and their boxes, ezdxf dimensions and lines."""

import json
import math
import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing

from ilmek.elements.materials import find_material
from ilmek.io.drawings.dxf import write_sheet_dxf
from ilmek.jobs.design import design_machine
from ilmek.jobs.workshop import write_workshop
from ilmek.jobs.workshop_order import WorkshopOrder
from ilmek.machines.catalogue import find_machine
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.plates import pieces_of, plates_of
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, box, square_tube, stepped, tube
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle, keyed_bore, polygon, rounded_hull
from ilmek.report import Check, Report
from ilmek.report.sheet import DrawingSheet, Issue, SheetText
from ilmek.sentences import Sentence

pdfium = pytest.importorskip("pypdfium2")
pytest.importorskip("OCP")

POINT = 72 / 25.4


@pytest.fixture(scope="module")
def beat_up(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("beat-up") / "parts"
    design_machine("beat-up", {}, WorkshopOrder(folder), illustrated=False)
    return folder


def dimensions(document: Drawing) -> Iterator[tuple[int, bool, float, str]]:
    """Type, whether it is upright, true length [mm] and text of each dimension of a sheet."""
    for entity in document.modelspace().query("DIMENSION"):
        upright = entity.dxf.get("angle", 0.0) == 90.0
        yield entity.dimtype, upright, entity.dxf.actual_measurement, entity.dxf.text


def written(shape: Shape, folder: Path, process: str = "machined link") -> Drawing:
    """The sheet of a part of that shape, read back."""
    part = Part("probe/thing", "thing", process, shape, find_material("structural steel"))
    tree = Tree((RigidBody("body", (Occurrence(part),)),))
    report = Report("probe", "Probe", {}, (), (), plates=plates_of(tree), pieces=pieces_of(tree))
    write_workshop(report, folder)
    return ezdxf.readfile(folder / "thing.sheet.dxf")


LINEAR, ALIGNED, DIAMETER, RADIUS = 0, 1, 3, 4


def lengths(document: Drawing, *, upright: bool) -> list[float]:
    """Linear dimensions of one direction, ascending, those in brackets left out [mm]."""
    return sorted(
        v for kind, up, v, text in dimensions(document) if kind == LINEAR and up is upright and "(" not in text[:1]
    )


def labelled(document: Drawing, kind: int) -> list[tuple[float, int]]:
    """Diameters or radii with the number that stands before them [mm]."""
    found = ((v, re.match(r"(\d+)×", text)) for own, _, v, text in dimensions(document) if own == kind)
    return [(value, int(times.group(1)) if times else 1) for value, times in found]


def plate_volume(document: Drawing) -> float:
    """A rectangle 10 thick with round holes: two sides, the thickness in the view of the edge, diameters."""
    across, upwards = lengths(document, upright=False), lengths(document, upright=True)
    thick = 10.0
    sides = (across, upwards) if thick in upwards else (upwards, across)
    sides[1].remove(thick)
    area = sides[0][-1] * sides[1][-1] - sum(n * math.pi * d**2 / 4 for d, n in labelled(document, DIAMETER))
    return area * thick


def link_volume(document: Drawing) -> float:
    """Round ends about two centres: their distance, the radius, the bores, the thickness."""
    (distance,) = lengths(document, upright=False)
    (thick,) = lengths(document, upright=True)
    ((radius, ends),) = labelled(document, RADIUS)
    assert ends == 2
    bores = sum(n * math.pi * d**2 / 4 for d, n in labelled(document, DIAMETER))
    return (2 * radius * distance + math.pi * radius**2 - bores) * thick


def tube_volume(document: Drawing) -> float:
    """A square tube: length, side, wall."""
    *section, length = lengths(document, upright=False)
    wall, side = section
    return length * (side**2 - (side - 2 * wall) ** 2)


def round_volume(document: Drawing) -> float:
    """A plain or bored cylinder: length and one or two diameters."""
    (length,) = lengths(document, upright=False)
    diameters = sorted([d for d, _ in labelled(document, DIAMETER)] + lengths(document, upright=True))
    inner = diameters[0] if len(diameters) > 1 else 0.0
    return math.pi / 4 * length * (diameters[-1] ** 2 - inner**2)


def shaft_volume(document: Drawing) -> float:
    """Steps by the faces from the left, and the diameters by the order of their labels along the axis."""
    faces = [0.0, *lengths(document, upright=False)]
    entities = [e for e in document.modelspace().query("DIMENSION") if e.dimtype == DIAMETER]
    along = [e.dxf.actual_measurement for e in sorted(entities, key=lambda e: e.dxf.defpoint4.x)]
    return sum(math.pi / 4 * d**2 * (b - a) for d, (a, b) in zip(along, pairwise(faces), strict=True))


def keyed_volume(document: Drawing) -> float:
    """A disc with a keyed bore: outer and inner diameter, thickness, width of the keyway, depth over the bore."""
    (inner, _), (outer, _) = sorted(labelled(document, DIAMETER))
    width, floor = sorted(v for kind, _, v, _ in dimensions(document) if kind == ALIGNED)
    (thick,) = lengths(document, upright=False)
    r, half = inner / 2, width / 2
    beyond = floor - inner  # of the floor over the bore's circle
    sagitta_area = half * (r + beyond) * 2 - (half * math.sqrt(r**2 - half**2) + r**2 * math.asin(half / r))
    return thick * (math.pi / 4 * (outer**2 - inner**2) - sagitta_area)


def bar_volume(document: Drawing) -> float:
    """A solid bar: both sides of its section, and its length."""
    across, (height,) = lengths(document, upright=False), lengths(document, upright=True)
    return across[0] * across[1] * height


MM = 1e-3
CORNERS, BORES = np.array([0, 120, 120 + 80j, 80j]), (15 + 15j, 105 + 15j, 15 + 65j)
PLATE = Profile(polygon(CORNERS * MM), tuple(circle(at * MM, 4.5 * MM) for at in BORES))
ENDS = np.array([0, 231.6401339]) * MM
LINK = Profile(rounded_hull(ENDS, 15 * MM), (circle(0j, 3 * MM), circle(complex(ENDS[1]), 4 * MM)))
DISC = Profile(circle(0j, 40 * MM), (keyed_bore(10 * MM, 6 * MM, 2.8 * MM),))
TEN = {
    "plate": (Prism(PLATE, 10 * MM), plate_volume),
    "plain plate": (box(36 * MM, 135 * MM, 10 * MM), plate_volume),
    "link": (Prism(LINK, 10 * MM), link_volume),
    "short link": (Prism(Profile(rounded_hull(np.array([0, 0.0599528786]), 0.015), ()), 0.01), link_volume),
    "square tube": (square_tube(40 * MM, 3 * MM, 1508 * MM), tube_volume),
    "pin": (bar(6 * MM, 24 * MM), round_volume),
    "tube": (tube(60 * MM, 5 * MM, 1.6), round_volume),
    "shaft": (stepped((0.02, 0.03), (0.0301234567, 0.05), (0.017, 0.021)), shaft_volume),
    "keyed disc": (Prism(DISC, 8 * MM), keyed_volume),
    "bar": (box(20 * MM, 30 * MM, 400 * MM), bar_volume),
}


@pytest.mark.parametrize("name", TEN)
def test_a_part_is_rebuilt_from_the_dimensions_of_its_sheet_alone(name: str, tmp_path: Path) -> None:
    shape, rebuild = TEN[name]
    process = "machined link" if isinstance(shape, Prism) and "tube" not in name and name != "bar" else "turned part"
    volume = rebuild(written(shape, tmp_path / "out", process)) * MM**3
    assert volume == pytest.approx(shape.volume, rel=1e-6)


def glyphs(page: object) -> np.ndarray:
    """Boxes of the printed letters of a page [mm], by PDFium."""
    texts = page.get_textpage()  # type: ignore[attr-defined]
    boxes = np.array([texts.get_charbox(number) for number in range(texts.count_chars())]) / POINT
    return boxes[(np.ptp(boxes[:, [0, 2]], axis=1) > 0.05) & (np.ptp(boxes[:, [1, 3]], axis=1) > 0.05)]


def assert_clear(book: Path) -> None:
    """No letter lies on another, none beyond the zones of the frame."""
    document = pdfium.PdfDocument(book)
    for number in range(len(document)):
        page = document[number]
        boxes = glyphs(page)
        low, high = boxes[:, None, :2], boxes[None, :, 2:]
        meet = ((low < high - 0.05) & (boxes[None, :, :2] < boxes[:, None, 2:] - 0.05)).all(axis=2)
        pairs = np.argwhere(np.triu(meet, 2))  # neighbours in a word may be kerned
        assert not len(pairs), f"page {number + 1}: {boxes[pairs[0]].round(1).tolist()}"
        width, height = (side / POINT for side in page.get_size())
        assert boxes[:, 0].min() > 15
        assert boxes[:, 1].min() > 5
        assert boxes[:, 2].max() < width - 5
        assert boxes[:, 3].max() < height - 5


BOOKS = ("drawings.pdf", "drawings.tr.pdf")


@pytest.mark.parametrize("book", BOOKS)
def test_no_text_lies_on_another_or_leaves_the_frame(book: str, beat_up: Path) -> None:
    assert_clear(beat_up / book)


def test_the_turkish_book_has_its_words_on_the_same_sheets(beat_up: Path) -> None:
    english, turkish = (pdfium.PdfDocument(beat_up / name) for name in BOOKS)
    assert len(english) == len(turkish)
    for number in range(1, len(turkish)):
        page = turkish[number].get_textpage().get_text_range()
        assert all(word in page for word in ("Malzeme", "Kenarlar ISO 13715, dış", "Yarı mamul, işlem"))
        assert ("Parça resmi" in page) is ("Montaj resmi" not in page)
        assert not any(
            word in page
            for word in ("Part drawing", "Assembly drawing", "Stock, process", "Drawing number", "as delivered")
        )
        assert page != english[number].get_textpage().get_text_range()


def printed(value: float) -> str:
    """A length [mm] as a sheet has it."""
    return f"{value:.3f}".rstrip("0").rstrip(".")


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("name", ["tension-compensator", "tufting", "hand-loom", "weaver", "automated-loom"])
def test_the_sheets_of_every_machine_are_clear(name: str, tmp_path: Path) -> None:
    design_machine(name, {}, WorkshopOrder(tmp_path / "parts"), illustrated=False)
    for book in BOOKS:
        assert_clear(tmp_path / "parts" / book)


def points_of(document: Drawing, page: str) -> dict[str, bool]:
    """A toolmaker's points, each looked for in the DXF by layers and entities, or in the text of the PDF."""
    space = document.modelspace()
    drawn = {entity.dxf.layer for entity in space}
    every = list(dimensions(document))
    frames = [np.ptp(line.get_points("xy"), axis=0).tolist() for line in space.query("LWPOLYLINE[layer=='FRAME']")]
    measured = {kind for kind, *_ in every} | {"upright" for kind, up, *_ in every if kind == LINEAR and up}
    fits = re.findall(r"^(?:bore|journal) ⌀[\d.]+ (\w+)", page, re.M)
    blocks = [len(document.blocks[entity.dxf.geometry]) for entity in space.query("DIMENSION")]
    words = [text.dxf.text for text in space.query("TEXT")] + [text for *_, text in every]
    symbols = [text for text in words if re.match(r"a\d[\d.]*\u2003", text)]
    keyways = [text for text in words if re.match(r"(\d+× )?keyway ", text)]
    weights = {layer.dxf.name: layer.dxf.lineweight for layer in document.layers}
    return {
        "1 frame and zones": "FRAME" in drawn and re.search(r"^A$", page, re.M) is not None,
        "2 paper of the A series": max(frames) in ([180, 277], [390, 277], [564, 400], [811, 574]),
        "3 title": bool(re.search(r"^Title", page, re.M)),
        "4 drawing number": bool(re.search(r"^[a-z-]+/[a-z0-9-]+$", page, re.M)),
        "5 scale of ISO 5455": bool(re.search(r"\b(1:(1|2|5|10|20|50)|(2|5|10|20|50):1)\b", page)),
        "6 sheet of sheets": bool(re.search(r"\b1/[12]\b", page)),
        "7 projection": "Projection" in page,
        "8 material by its standard": bool(re.search(r"EN (ISO )?\d+", page)),
        "9 mass": bool(re.search(r"\d (kg|g)\b", page)),
        "10 pieces": "Pieces" in page,
        "11 general tolerances": bool(re.search(r"ISO (2768-mK|13920)", page)),
        "12 edges": "ISO 13715" in page and "outer" in page,
        "13 surface": bool(re.search(r"Ra \d|as delivered", page)),
        "14 visible outline wide": "VISIBLE" in drawn and weights["VISIBLE"] == 50 == 2 * weights["DIMENSION"],
        "15 size in two directions": len(measured) >= 2,
        "16 every measured value is printed": all(printed(value) in text for *_, value, text in every),
        "17 each dimension has its lines and arrows": min(blocks) >= 2,
        "18 axes of what is round": "⌀" not in page or "CENTRE" in drawn,
        "19 each fit beside its dimension": all(any(f" {fit} " in text for *_, text in every) for fit in fits),
        "20 date, revision and status": all(word in page for word in ("Rev.", "Date of issue", "Status")),
        "21 each weld with its length, and its position": "WELD" not in drawn
        or ("Welds ISO 2553" in page and all(re.search(r"\ba\d[\d.]*\s+[\d.]", text) for text in symbols)),
        "22 bends with side, radius and K": "bent" not in page
        or all(word in page for word in ("DIN 6935", "Inner radius", "Side")),
        "23 twist with angle, lead and hand": not re.search(r"twisted bar\b", page)
        or all(word in page for word in ("Lead", "Hand", "Angle")),
        "24 a cam's zero mark and direction": "cam plate" not in page or ("zero mark" in page and "turns" in page),
        "25 each keyway with its fit, angle and floor": page.count("keyway") == 0
        or (all(re.search(r"\d \w+ \(.* at ", text) for text in keyways) and "to its floor" in page),
        "26 stock and process": bool(re.search(r"Stock, process\s+[^\s—]", page)),
    }  # fmt: skip


def test_a_toolmaker_finds_his_points_on_every_sheet_of_the_beat_up(beat_up: Path) -> None:
    index = json.loads((beat_up / "workshop.json").read_text(encoding="utf-8"))
    names = [entry["file"] for entry in index["files"] if entry["kind"] == "sheet"]
    book = pdfium.PdfDocument(beat_up / "drawings.pdf")
    pages = [book[number].get_textpage().get_text_range() for number in range(len(book))]
    for name, page in zip(names, pages[-len(names) :], strict=True):
        points = points_of(ezdxf.readfile(beat_up / name), page.replace("\r", ""))
        missing = [point for point, there in points.items() if not there]
        assert len(missing) <= 1, f"{name}: {missing}"
    assert all(name.removesuffix(".sheet.dxf") in pages[0] for name in names)
    assert not any(ezdxf.readfile(beat_up / name).audit().errors for name in names)


def test_a_design_that_fails_is_stamped_on_every_sheet_with_its_reasons(tmp_path: Path) -> None:
    machine = find_machine("beat-up")
    report = machine.report_for({})
    failed = replace(
        report, checks=(*report.checks, Check("stress of a thing", 2.0, 1.0, "1", False, "given", cure="thicken it"))
    )
    write_workshop(failed, tmp_path / "out", issue=Issue(date="2026-11-30", revision="B"))
    book = pdfium.PdfDocument(tmp_path / "out" / "drawings.pdf")
    pages = [book[number].get_textpage().get_text_range() for number in range(len(book))]
    assert all(page.count("NOT RELEASED") == 2 for page in pages[1:])
    assert "stress of a thing: thicken it" in pages[0]
    assert all("2026-11-30" in page for page in pages)
    sheet = ezdxf.readfile(tmp_path / "out" / "crank.sheet.dxf")
    assert [text.dxf.text for text in sheet.modelspace().query("TEXT[layer=='STAMP']")] == ["NOT RELEASED"]


def test_the_same_design_gives_the_same_bytes(beat_up: Path, tmp_path: Path) -> None:
    design_machine("beat-up", {}, WorkshopOrder(tmp_path / "again"), illustrated=False)
    for name in ("drawings.pdf", "assembly-1.sheet.dxf", "carriage-plate.sheet.dxf", "pin.sheet.dxf"):
        assert (tmp_path / "again" / name).read_bytes() == (beat_up / name).read_bytes()


def test_what_needs_no_kernel_is_drawn_without_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ilmek.jobs.drawings._projector", lambda: None)
    bent = Sum((Placed(box(0.02, 0.1, 0.01)), Placed(box(0.02, 0.01, 0.05), (placement(0.0, 0.05, 0.01),))))
    steel = find_material("structural steel")
    parts = [Part(f"probe/{n}", n, "turned part", s, steel) for n, s in (("bent", bent), ("pin", bar(0.006, 0.02)))]
    tree = Tree((RigidBody("body", tuple(map(Occurrence, parts))),))
    made = write_workshop(Report("probe", "Probe", {}, (), (), pieces=pieces_of(tree)), tmp_path / "out")
    assert [entry["of"] for entry in made.entries if entry["kind"] == "sheet"] == ["pin"]
    assert "1 sheet of a part of several shapes is left out: pip install 'ilmek[step]'" in made.notes


def test_a_sheet_as_dxf_is_in_each_language(tmp_path: Path) -> None:
    sheet = DrawingSheet("1", "t", "A4", 210.0, 297.0, 1.0, (), (SheetText(0j, Sentence("sheet.mass")),))
    write_sheet_dxf(tmp_path / "en.dxf", sheet, {"tr": tmp_path / "tr.dxf"})
    texts = [ezdxf.readfile(tmp_path / f"{name}.dxf").modelspace()[0].dxf.text for name in ("en", "tr")]
    assert texts == ["Mass", "Kütle"]
