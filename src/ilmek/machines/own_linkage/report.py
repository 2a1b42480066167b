"""What is reported of an own mechanism's construction: layers in depth, checks of its pins and keys, its masses."""

from collections.abc import Iterator

from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.model import GROUND
from ilmek.machines.link_tree import body_id, inertia_of
from ilmek.machines.own_linkage.construction import Construction
from ilmek.machines.own_linkage.tree import own_tree
from ilmek.part.meetings import meetings
from ilmek.report import Check, Result, Table, at_most, columns
from ilmek.units import counted

FIT = "assumed by this project; of a pin that the file gives: its own"


def made_inertias(built: Construction) -> dict[str, Inertia]:
    """Inertia of each moving body as made: its plate with all that is fixed in it."""
    bodies = {body.id: body for body in own_tree(built).bodies}
    return {body: inertia_of(bodies[body_id(built.name, body)].occurrences) for body in built.machine.mechanism.moving}


def construction_results(built: Construction) -> tuple[Result, ...]:
    """The layers, and how they were found."""
    layers, tree = built.layering, own_tree(built)
    return (
        Result("layers", layers.number, "1", "layers in depth above the plate that stands"),
        Result("layer_of", dict(layers.layers), "1", "layer of each body; of the ground 0", shown=False),
        Result("layers_tried", layers.tried, "1", "assignments of a body to a layer that were tried", shown=False),
        Result("parts_mass", tree.mass, "kg", "mass of all parts"),
        Result("fits", len(meetings(tree)), "1", "pairs of features that meet with a fit", shown=False),
    )


def construction_checks(built: Construction) -> tuple[Check, ...]:
    """Whether nothing meets in the layers, all couplings and drives have parts, and pins and keys bear their forces."""
    return (*_layer_checks(built), *_pin_checks(built), *_key_checks(built))


def _layer_checks(built: Construction) -> Iterator[Check]:
    layers, mechanism = built.layering, built.machine.mechanism
    without = 0 if layers.found else len(mechanism.moving)
    source = f"search of layers in depth: {counted(layers.tried, 'assignment')} tried, {layers.number} layers"
    cure = "move a pivot or a guide out of the way of the links, or make links narrower"
    ids = tuple(body_id(built.name, body) for body in mechanism.moving)
    yield at_most("bodies without a layer in which they meet nothing", without, 0, "1", source).with_cure(cure, *ids)
    if mechanism.couplings:
        source = f"gears, belts and racks are not made: {', '.join(coupling.name for coupling in mechanism.couplings)}"
        cure = "order them by their ratio, and leave them room"
        yield at_most("couplings without parts", len(mechanism.couplings), 0, "1", source).with_cure(cure)


def _pin_checks(built: Construction) -> Iterator[Check]:
    """The worst of the pins, by its stress over what it is allowed."""
    cure = "set a thicker pin, a shorter link beside it, or a lower load"
    for name in ("bending", "shear", "pressure"):
        shares = {
            axis.name: max(
                (getattr(stress, name) / getattr(built.studs[axis.name].member, name), getattr(stress, name))
                for stress in built.stresses(axis)
            )
            for axis in built.axes
        }
        if built.loads.pins and shares:
            worst = max(shares, key=lambda pin: shares[pin][0])
            limit = getattr(built.studs[worst].member, name)
            source = f"pin {worst} as a cantilever; {FIT}"
            bodies = next(axis.points for axis in built.axes if axis.name == worst)
            ids = tuple(body_id(built.name, body) for body in bodies)
            title = f"{name} of the pins as made"
            yield at_most(title, shares[worst][1], limit, "MPa", source).with_cure(cure, *ids)


def _key_checks(built: Construction) -> Iterator[Check]:
    for axis in built.axes:
        key = built.key(axis) if axis.driven else None
        if key is not None and built.loads.torques:
            yield key.check(f"shaft {axis.name}", "set a thicker pin there", (body_id(built.name, axis.driven),))


def construction_table(built: Construction) -> Table:
    """Each body with its layer and its mass, as made and in the forces."""
    made, used = made_inertias(built), built.machine.inertias
    rows = [
        (body, built.layering.layers[body], made[body].mass, used[body].mass if body in used else 0.0)
        for body in built.machine.mechanism.moving
    ]
    heads = columns("body | layer | mass as made [kg] 4 | mass in the forces [kg] 4")
    return Table("layers", f"Layers of the bodies above {GROUND}", heads, tuple(rows), brief=True)
