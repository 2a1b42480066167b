"""The fully automated carpet loom of the thesis, sized for one carpet.

Warp cylinders, shedding cams, beat-up and k knotting heads, each a machine of its own, with parameters that follow from
the carpet's width, length and quality; timed together by two cyclograms, of a knot and of a row.

Source: thesis, chapters 2.2.3 and 3. How heads share a row: `ilmek.loom.sharing`.
"""

from dataclasses import fields, replace

from ilmek.machines.arrangement.side_view import SideView
from ilmek.machines.automated_loom.assembly import LoomAssembly, assembly
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, ODD
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.energy import Energy
from ilmek.machines.automated_loom.equipment.station import WeaversStation
from ilmek.machines.automated_loom.equipment.tree import equipment_trees, whole_list
from ilmek.machines.automated_loom.equipment.yarn_path import YarnPath
from ilmek.machines.automated_loom.estimate import TimeShares, estimated_time
from ilmek.machines.automated_loom.figures import figures
from ilmek.machines.automated_loom.frame_modes import FrameModes
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.off_loom import OffLoom
from ilmek.machines.automated_loom.papers import papers
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.parts import PartsList, own_tree, parts_of_loom
from ilmek.machines.automated_loom.report import (
    LoomAnalysis,
    LoomVerdict,
    analyse,
    cam_tables,
    checks,
    results,
    tables,
    warnings,
)
from ilmek.machines.automated_loom.selection import design, with_room
from ilmek.machines.beat import BeatDrive
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import AnyComponent, Component
from ilmek.machines.weaver_hands import HAND
from ilmek.params import Params
from ilmek.part.plates import pieces_of, plates_of
from ilmek.report import BUILDABLE
from ilmek.timing.cyclogram import Cyclogram
from ilmek.weaving.warping import Warping

__all__ = [
    "MACHINE",
    "AutomatedLoomParams",
    "LoomDesign",
    "cyclograms",
    "design",
    "estimated_time",
]


def cyclograms(loom: LoomDesign) -> tuple[Cyclogram, ...]:
    """The cyclograms of a knot and of a row with their relations; cams and crank of the row are as made."""
    knot, row = loom.cyclograms
    made = tuple(replace(track, locked=track.name in (EVEN, ODD, BEATER)) for track in row.tracks)
    return knot, replace(row, tracks=made)


def by_hand(params: AutomatedLoomParams) -> tuple[AnyComponent, Params] | None:
    """The hand loom and its parameters, where knots, shed and beat are by hand."""
    if HAND not in (params.shed, params.beat):
        return None
    loom = MACHINES["hand-loom"]
    return loom, loom.params(**{field.name: getattr(params, field.name) for field in fields(params)})


MACHINE: Component[AutomatedLoomParams, LoomDesign, LoomAnalysis] = Component(
    name="automated-loom",
    title="Automated loom",
    params=AutomatedLoomParams,
    design=design,
    analysis=analyse,
    results=results,
    reported=(
        LoomVerdict,
        LoomAnalysis,
        SideView,
        TimeShares,
        BeatDrive,
        Energy,
        YarnPath,
        WeaversStation,
        PartsList,
        CarpetCost,
        OffLoom,
        Warping,
        FrameModes,
        LoomAssembly,
    ),
    checks=checks,
    tables=tables,
    figures=lambda found: figures(found.loom),
    warnings=warnings,
    cam_tables=cam_tables,
    cyclograms=cyclograms,
    papers=papers,
    parts=lambda loom: whole_list(loom).parts,
    plates=lambda loom: tuple(
        plate for tree in (own_tree(loom), *equipment_trees(loom)) for plate in plates_of(tree, loom_tree(loom))
    ),
    pieces=lambda loom: tuple(piece for tree in (own_tree(loom), *equipment_trees(loom)) for piece in pieces_of(tree)),
    children=lambda loom: loom.children,
    choices=lambda loom: (*loom.choices, *parts_of_loom(loom).frame.choices),
    assembly=assembly,
    with_room=with_room,
    verdict=LoomVerdict,
    headline=("weaves", BUILDABLE, "row_pitch_left"),
    variant=by_hand,
)
