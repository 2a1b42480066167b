"""The loom's own parts that are in none of its machines, as bodies: the back rest."""

from ilmek.elements.materials import MATERIALS
from ilmek.elements.tubes import TUBES, Tube
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.shapes import tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree

BACK_REST = "automated-loom/back-rest"


def back_rest_tube(loom: LoomDesign) -> Tube:
    """The tube of the back rest: the thickest of the stock of its diameter."""
    outer = 2 * loom.side.back_rest.radius
    return max(TUBES.values(), key=lambda row: (-abs(row.outer - outer), row.wall))


def own_tree(loom: LoomDesign) -> Tree:
    """The bodies; what carries the back rest is not designed yet."""
    section, axis, wide = back_rest_tube(loom), loom.side.back_rest.at, loom.task.width
    roller = Part(
        BACK_REST,
        "back rest",
        "steel tube",
        f"tube {section.name} mm",
        tube(section.outer, section.wall, wide),
        MATERIALS["structural steel"],
    )
    position = placement(-wide / 2, axis.imag, axis.real).after(ALONG_WIDTH)
    return Tree(
        (RigidBody("automated-loom/back rest", (Occurrence(roller, (position,)),), joint=Joint(JointKind.MISSING)),)
    )
