"""The parts list of a tree: a line for each part, with the number of its pieces."""

from ilmek.part.part import Part
from ilmek.part.tree import Tree
from ilmek.report import BillLine


def bill(tree: Tree) -> tuple[BillLine, ...]:
    """The lines of the parts list, in the order of the bodies."""
    return tuple(line_of(part, number) for part, number in tree.occurrences())


def line_of(part: Part, number: int = 1) -> BillLine:
    """The line of so many pieces of a part."""
    bought = part.purchase
    return BillLine(
        name=part.title,
        number=number,
        description=part.size or (bought.row if bought else ""),
        material=part.material.name if part.material else "",
        kind=part.process,
        mass=part.mass,
        length=bought.length if bought else 0.0,
        power=bought.power if bought else 0.0,
        drives=bought.drives if bought else 0,
        part=part.id,
    )
