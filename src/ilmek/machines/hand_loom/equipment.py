"""What a driven beat needs beside its machine on a hand loom: guards, safety circuit, encoder, the weavers' station.

A fence stands at the sides and the rear, a light grid behind the weavers, and each of them holds two buttons while it
beats, as on an automated loom [`automated_loom.equipment`]. Nothing but the beat is driven or stopped.
"""

from functools import lru_cache

from ilmek.elements.field_devices import GRID
from ilmek.machines.automated_loom.equipment.circuit import circuit, circuit_checks
from ilmek.machines.automated_loom.equipment.guard_parts import guards
from ilmek.machines.automated_loom.equipment.guards import guard_checks
from ilmek.machines.automated_loom.equipment.sensors import encoder, sensor_tree
from ilmek.machines.automated_loom.equipment.signals import BEAT_ANGLE, beat_signals
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.equipment.station import station_checks, station_of, station_tree
from ilmek.machines.automated_loom.equipment.stopping import BEAT as BEAT_AXIS
from ilmek.machines.automated_loom.equipment.stopping import StoppingTime, beat_stop, circuit_time
from ilmek.machines.automated_loom.equipment.surroundings import Surroundings, hazards_of
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.beat import BeatDrive
from ilmek.machines.beat_up.beam import BEAM
from ilmek.machines.hand_loom.driven_beat import BEAT, two_beats
from ilmek.machines.hand_shed.tree import SHED
from ilmek.part.extents import extents
from ilmek.part.tree import Tree
from ilmek.report import Check, at_least
from ilmek.units import mm

OWN = "hand-loom"
"""Machine of what is in none of the others."""


def beat_site(drive: BeatDrive, tree: Tree, floor: float, weavers: int) -> LoomSite:
    """The site of a loom of which the beat alone is driven.

    tree  all bodies without guards, station and circuit      floor  over the fell [m]
    """
    return LoomSite(
        near=Surroundings(tree, extents(tree, (SHED, BEAT)), tuple(hazards_of(extents(tree, (BEAT,))))),
        stops=StoppingTime(circuit_time(GRID), {BEAT_AXIS: beat_stop(drive, two_beats(drive.beat))}),
        floor=floor,
        width=drive.task.cloth.width,
        signals=beat_signals(weavers),
        heads=0,
        weavers=weavers,
    )


@lru_cache(maxsize=4)
def equipment(site: LoomSite) -> tuple[MachineTree, ...]:
    """The trees of guards, circuit, station, and of the encoder on the beat's carriage."""
    others = watched(site)
    return (*others, MachineTree(OWN, circuit(site, with_equipment(site))))


@lru_cache(maxsize=4)
def watched(site: LoomSite) -> tuple[MachineTree, ...]:
    """The equipment without its circuit."""
    own = (MachineTree(OWN, made(site)) for made in (guards, station_tree))
    return (*own, sensor_tree(encoder(site.near, BEAT_ANGLE, "encoder of the beat"), OWN))


@lru_cache(maxsize=4)
def with_equipment(site: LoomSite) -> Tree:
    """All bodies but those of the circuit."""
    tree = site.near.tree
    for own in watched(site):
        tree = tree.carrying(own.parent, own.tree, own.position)
    return tree


def equipment_checks(site: LoomSite) -> tuple[Check, ...]:
    """The checks of guards, circuit and station, and of the room for arms over what stands before the warps."""
    return (
        *guard_checks(site),
        *circuit_checks(site, with_equipment(site)),
        *station_checks(site),
        *_arms_checks(site),
    )


ARM_ROOM = 60 * mm
"""From the line between shoulder and fell to what lies below it [m]: half an arm in a sleeve; assumed."""


def _arms_checks(site: LoomSite) -> tuple[Check, ...]:
    """Room under the straight line from the shoulder of a weaver to the fell; none where nothing lies under it."""
    shoulder = station_of(site).bench.shoulder
    slope, half = shoulder.imag / shoulder.real, site.width / 2
    rooms = [
        slope * float(extent.low[2]) - float(extent.high[1])
        for extent in site.near.extents
        if not extent.moving
        and 0 < extent.low[2] < shoulder.real
        and extent.high[1] < shoulder.imag
        and extent.low[0] < half
        and extent.high[0] > -half
    ]
    if not rooms:
        return ()
    source = "shoulder to fell, straight; assumed by this project"
    return (
        at_least("weavers: room under their arms", min(rooms), ARM_ROOM, "mm", source).with_cure(
            "set a larger hands.weft_laid", BEAM
        ),
    )
