"""The loom of the project in space: its parts, their motions, its carpet; and the drawing of a part."""

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.errors import ParameterError
from ilmek.io.glb import glb_bytes
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.loom import LoomResult, make_loomed, read_loom_order
from ilmek.jobs.loom_space import loom_scene, scene_answer
from ilmek.jobs.machine_file import read_machine_order
from ilmek.jobs.order import read_order
from ilmek.jobs.studio.answers import Binary, Context, packed
from ilmek.jobs.studio.project.folder import ProjectFolder, digest_of, kind_of, read_bytes
from ilmek.machines import automated_loom, hand_loom
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.component import AnyComponent
from ilmek.machines.hand_loom import HandLoom
from ilmek.plane.contours import along
from ilmek.progress import SILENT, Progress
from ilmek.records import alike
from ilmek.report import Contour, Plate, Report
from ilmek.report.scene import Scene
from ilmek.units import mm
from ilmek.viz.scene_data import checks_of_parts, judgement

GLB = "model/gltf-binary"
RECIPE = "carpet.toml"
_CHORD = 0.02 * mm
_LOOMS: dict[str, AnyComponent] = {one.name: one for one in (automated_loom.MACHINE, hand_loom.MACHINE)}


@dataclass(frozen=True, slots=True)
class LoomRequest:
    """A loom of the project: by a recipe, the loom for its carpet; by a machine file, the loom of its settings.

    file  path in the project
    """

    file: str = RECIPE


@dataclass(frozen=True, slots=True)
class PlateRequest:
    """A plate of a loom, by its name in the workshop files."""

    plate: str
    file: str = RECIPE


@dataclass(frozen=True, slots=True)
class PlateDrawing:
    """The drawing of a plate [m]: closed lines of x and y in turn, the outline first; round holes: x, y, radius."""

    title: str
    lines: tuple[tuple[float, ...], ...]
    holes: tuple[tuple[float, float, float], ...]
    thickness: float
    material: str
    number: int
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class ProjectLoom:
    """A designed loom with its report, without its parts against each other; its carpet and its programme, if any.

    machine  that has designed it
    """

    machine: AnyComponent
    design: LoomDesign | HandLoom
    report: Report
    charted: ChartResult | None = None
    loomed: LoomResult | None = None

    @property
    def scene(self) -> Scene:
        """The loom in space."""
        return loom_scene(self.design, self.report)


def scene(request: LoomRequest, context: Context) -> Binary:
    """The loom in space: JSON, 32-bit floats and integers; of a recipe also its chart, a byte a knot, top row first.

    Raises IlmekError where the file is no loom, or its loom cannot be designed.
    """
    loom = project_loom(context.folder, request.file, context.progress)
    return scene_answer(loom.scene, None if loom.charted is None else loom.charted.chart)


def in_space(request: LoomRequest, context: Context) -> Binary:
    """What a scene leaves open, some seconds of work: the parts of the loom against each other in space.

    The checks that fail, those of each part by its name, and the pairs of parts that come nearest.
    """
    loom = project_loom(context.folder, request.file, context.progress)
    whole = loom_scene(loom.design, loom.machine.report(loom.design, illustrated=False))
    return packed({**judgement(whole), "checks": checks_of_parts(whole)})


def glb(request: LoomRequest, context: Context) -> Binary:
    """The loom as GLB, with an animation for each of its drives."""
    return Binary(GLB, glb_bytes(project_loom(context.folder, request.file, context.progress).scene))


def plate(request: PlateRequest, context: Context) -> PlateDrawing:
    """The drawing of a plate of the loom. Raises ParameterError for a name that no plate has."""
    loom = project_loom(context.folder, request.file, context.progress)
    found = {one.name: one for one in loom.report.all_plates}.get(request.plate)
    if found is None:
        raise ParameterError(f"the loom has no plate {request.plate!r}")
    return drawing_of(found)


def drawing_of(found: Plate) -> PlateDrawing:
    """The drawing of a plate."""
    lines = (found.outline, *found.cutouts)
    return alike(
        PlateDrawing,
        found,
        lines=tuple(_flat(line) for line in lines),
        holes=tuple((hole.at.real, hole.at.imag, hole.radius) for hole in found.holes),
    )


def _flat(line: ComplexArray | Contour) -> tuple[float, ...]:
    points = along(line, _CHORD) if isinstance(line, Contour) else line
    return tuple(np.column_stack([points.real, points.imag]).ravel().tolist())


def project_loom(folder: Path, file: str, progress: Progress = SILENT) -> ProjectLoom:
    """The loom of a file of a project; it is designed again only where a file that it depends on was changed.

    Raises IlmekError where the file is no loom, or its loom cannot be designed.
    """
    path = ProjectFolder(folder).text_path(file)
    content = read_bytes(path) or b""
    if kind_of(file) == "machine":
        return _of_machine(str(path), digest_of(content))
    pictures = "".join(sorted(f"{one}{one.stat().st_mtime_ns}" for one in (folder / "pictures").glob("*")))
    return _of_recipe(str(path), digest_of(content + pictures.encode()), progress)


@lru_cache(maxsize=3)
def _of_machine(path: str, _digest: str) -> ProjectLoom:
    order = read_machine_order(path, {})
    if order.machine not in _LOOMS:
        allowed = f"a recipe, or a machine file of an {' or a '.join(_LOOMS)}"
        raise ParameterError(f"{Path(path).name} is the file of a {order.machine}", allowed=allowed)
    machine, params = _LOOMS[order.machine].ordered(order.settings)
    design = machine.designed(params)
    return ProjectLoom(machine, design, machine.report(design, illustrated=False, assembled=False))


_recipes: dict[tuple[str, str], ProjectLoom] = {}
_MOST_RECIPES = 2


def _of_recipe(path: str, digest: str, progress: Progress) -> ProjectLoom:
    """The loom for the carpet of a recipe."""
    loom = _recipes.get((path, digest))
    if loom is None:
        order = read_order(Path(path))
        charted = make_charted(order, progress.part(0.0, 0.5, "picture"))
        part = progress.part(0.5, 1.0, "loom")
        loomed = make_loomed(read_loom_order(order), charted, part, illustrated=False, assembled=False)
        if loomed.made is None:
            reason = next((check for check in loomed.report.checks if not check.ok), None)
            raise ParameterError(
                reason.name if reason else "the loom cannot be designed", do=reason.cure if reason else ""
            )
        loom = ProjectLoom(_LOOMS[loomed.report.machine], loomed.made, loomed.report, charted, loomed)
        while len(_recipes) >= _MOST_RECIPES:
            _recipes.pop(next(iter(_recipes)))
        _recipes[path, digest] = loom
    return loom
