"""A made part as its drawing needs it, from the plate or piece of a report."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import field

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.materials import MATERIALS
from ilmek.part.blanks import blanks_of, size_of, sold_as
from ilmek.part.features import drillings
from ilmek.part.folding import folded_sheet
from ilmek.part.hole_kinds import HoleKinds, hole_kinds
from ilmek.part.part import WELDED, CamMaking, Part
from ilmek.part.plates import FLAT
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.specification import PartSpecification, specification
from ilmek.part.tolerances import FitDuty, ToleratedFeature, groove_tolerance
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Tree
from ilmek.part.welds import Weld, arc_partners, welds_of
from ilmek.plane.biarcs import as_contour
from ilmek.plane.contours import circle
from ilmek.records import record
from ilmek.report import Contour, Plate, RoundSolid, WorkPiece
from ilmek.sentences import Sentence
from ilmek.sentences.english import ENGLISH
from ilmek.units import format_quantity, mm, um
from ilmek.viz.drawings.like_notches import shortened
from ilmek.viz.drawings.picture import millimetres


@record
class DrawnPart:
    """A made part.

    number   of the drawing: the part's id        name  of its files
    shape    of the package `part`                flat  it is cut from flat stock       pieces  to be made
    file     of its flat pattern, for the laser   smooth  its outline is a curve
    stated   what holds for the part as a whole; None: not known        cam  how a disc cam is cut; None: it is none
    welds    of the part to others       cut  section of stock, and length that it is cut to [m]; None: of no bar
    bent     the part of which `shape` is the flat pattern; None: of none
    kinds    of its pieces by their holes; None: all have the same
    """

    number: str
    name: str
    title: str
    material: str
    density: float
    process: str
    size: str
    pieces: int
    shape: object
    volume: float
    notes: tuple[str, ...] = ()
    paths: Mapping[str, ComplexArray | Contour] = field(default_factory=dict)
    marks: Mapping[str, ComplexArray] = field(default_factory=dict)
    features: tuple[ToleratedFeature, ...] = ()
    file: str = ""
    smooth: bool = False
    stated: PartSpecification | None = None
    cam: CamMaking | None = None
    welds: tuple[Weld, ...] = ()
    cut: tuple[str, float] | None = None
    bent: Prism | None = None
    kinds: HoleKinds | None = None

    @property
    def mass(self) -> float:
        """Mass of one [kg]; nan: its material is in no table."""
        return self.volume * self.density

    @property
    def mass_words(self) -> str:
        """Its mass as a title block has it."""
        if math.isnan(self.mass):
            return "—"
        return format_quantity(self.mass, "kg", 3) if self.mass >= 0.1 else format_quantity(self.mass, "g", 3)

    @property
    def treatment(self) -> str:
        """How it is hardened, ISO 15787: least hardness and depth, and by how much each may be exceeded."""
        given = self.stated
        if given is None or given.hardening is None:
            return ""
        hard = given.hardening
        if not hard.kind:
            return Sentence("sheet.through-hardened", hardness=hard.hardness, more=hard.more)
        deep, deeper = f"{given.depth / mm:g}", f"{given.depth / 2 / mm:g}"
        return Sentence(
            "sheet.hardened", hardness=hard.hardness, more=hard.more, kind=hard.kind, depth=deep, deeper=deeper
        )

    @property
    def stock(self) -> str:
        """What it is made of, and how."""
        key = f"sheet.process-{self.process.replace(' ', '-')}"
        process = Sentence(key) if key in ENGLISH else self.process
        if self.size and process:
            return Sentence("sheet.stock-process", stock=self.size, process=process)
        return self.size or process or "—"

    @property
    def surface(self) -> str:
        """Roughness of all surfaces that state no other."""
        if self.stated is None:
            return "—"
        return Sentence("sheet.as-delivered") if self.stated.roughness is None else f"Ra {self.stated.roughness / um:g}"

    @property
    def edges(self) -> tuple[str, str]:
        """States of outer and inner edges [mm], ISO 13715; "": not known."""
        if self.stated is None:
            return "", ""
        outer, inner = self.stated.outer_edge / mm, self.stated.inner_edge / mm
        return f"{outer:+g}".replace("-", "−"), f"{inner:+g}".replace("-", "−")

    @property
    def general(self) -> str:
        """General tolerances."""
        return "ISO 2768-mK" if self.stated is None else self.stated.general


def drawn_plate(plate: Plate, machine: str, name: str) -> DrawnPart:
    """A plate, by its machine and the name of its files; a plate of no tree is a machined link of its material."""
    outline = as_contour(plate.outline, 1 * um)
    cuts = [*(circle(hole.at, hole.radius) for hole in plate.holes)]
    cuts += [as_contour(cutout, 1 * um) for cutout in plate.cutouts]
    solid = plate.solid
    drilled = drillings(solid.shape) if isinstance(solid, WorkPiece) and isinstance(solid.shape, Prism) else ()
    shape = Prism(Profile(outline, tuple(cuts)), plate.thickness, drilled)
    volume = shape.volume if solid is None else solid.volume
    material = next((row for row in MATERIALS.values() if plate.material in {row.name, row.designation}), None)
    part = plate.part if isinstance(plate.part, Part) else None
    if part is None and material is not None:
        part = Part(f"{machine}/{name}", plate.title, FLAT[1], shape, material)
    size = size_of(part) if part is not None else ""
    if isinstance(solid, RoundSolid):
        size = Sentence("sheet.development", size=f"⌀{format_quantity(2 * solid.outer, 'mm')}")
    bent = part.shape if part is not None and isinstance(part.shape, Prism) and folded_sheet(part.shape) else None
    return DrawnPart(
        part.id if part else f"{machine}/{name}", name, plate.title, _designation(part) or plate.material,
        _density(part), part.process if part else FLAT[1], size, plate.number, shape, volume,
        (
            *(part.notes if part is not None and part.cam is not None else plate.notes),
            *_row(part, plate.tree),
            *_welded(part, plate.tree),
        ),
        plate.paths, plate.marks, _features(plate.features), f"{name}.dxf", not isinstance(plate.outline, Contour),
        _stated(part), part.cam if part else None, _welds(part, plate.tree), bent=bent, kinds=_kinds(part, plate.tree),
    )  # fmt: skip


def drawn_piece(piece: WorkPiece, machine: str, name: str) -> DrawnPart:
    """A piece that is turned, sawn or welded, by its machine and the name of its files."""
    part, shape = piece.part if isinstance(piece.part, Part) else None, shortened(piece.shape)
    ends = () if shape is piece.shape else (Sentence("sheet.ends-of-row"),)
    return DrawnPart(
        part.id if part else f"{machine}/{name}", name, piece.title.capitalize(), piece.material, _density(part),
        part.process if part else "", piece.size, piece.number, shape, piece.volume,
        (*(part.notes if part else ()), *_row(part, piece.tree), *_welded(part, piece.tree), *ends),
        features=_features(piece.features),
        stated=_stated(part), welds=_welds(part, piece.tree), cut=_cut(part), kinds=_kinds(part, piece.tree),
    )  # fmt: skip


def _row(part: Part | None, tree: object) -> Iterator[Sentence]:
    """Where the pieces of a part stand that is there many times in an even row, with nothing in it that sets them."""
    if part is None or not isinstance(tree, Tree) or tolerances_of(tree).get(part.id):
        return
    for occurrence in (own for body in tree.bodies for own in body.occurrences if own.part.id == part.id):
        steps = np.diff([position.origin for position in occurrence.positions], axis=0)
        if len(steps) >= _LEAST_ROW and np.ptp(steps, axis=0).max() < um:
            pitch, number = float(np.linalg.norm(steps[0])), len(steps) + 1
            sizes = {"pitch": millimetres(pitch), "error": millimetres(groove_tolerance(pitch))}
            yield Sentence("sheet.row", number=str(number), **sizes)
            return


def _welded(part: Part | None, tree: object) -> Iterator[Sentence]:
    """What a machined part is welded to before its seats are finished, journals between centres."""
    if part is None or not part.machined or not isinstance(tree, Tree) or part.id not in arc_partners(tree):
        return
    titles = {own.id: own.title for own, _ in tree.occurrences()}
    to = ", ".join(sorted({titles[name] for name in arc_partners(tree)[part.id]}))
    journals = any(own.duty is FitDuty.BEARING for own in tolerances_of(tree).get(part.id, ()))
    yield Sentence("sheet.finish-between-centres" if journals else "sheet.finish-after-welding", parts=to)


_LEAST_ROW = 9
"""Pitches of a row from which it is one."""


def _cut(part: Part | None) -> tuple[str, float] | None:
    """Section and length of stock that is welded to others."""
    blanks = blanks_of(part) if part and part.process == WELDED else ()
    return (blanks[0].name, blanks[0].length) if blanks else None


def _features(features: tuple[object, ...]) -> tuple[ToleratedFeature, ...]:
    return tuple(feature for feature in features if isinstance(feature, ToleratedFeature))


def _welds(part: Part | None, tree: object) -> tuple[Weld, ...]:
    return welds_of(tree).get(part.id, ()) if part and isinstance(tree, Tree) else ()


def _kinds(part: Part | None, tree: object) -> HoleKinds | None:
    return hole_kinds(tree).get(part.id) if part and isinstance(tree, Tree) else None


def _density(part: Part | None) -> float:
    return math.nan if part is None or part.material is None else part.material.density


def _designation(part: Part | None) -> str:
    return "" if part is None else sold_as(part)


def _stated(part: Part | None) -> PartSpecification | None:
    return None if part is None or part.material is None else specification(part)
