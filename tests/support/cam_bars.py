"""The bar of a cam shaft beyond its cams."""


from ilmek.machines.shedding import SheddingDesign
from ilmek.machines.shedding.stack import part_id
from ilmek.machines.shedding.tree import tree
from ilmek.plane.solids import volume


def beyond_cams(design: SheddingDesign, index: int, length: float) -> float:
    """Volume of a shaft's bar without the square in the cams of a length [m], with both pressure rings [m³].

    By the mesh of the bar, whose chords take a little from its journals.
    """
    parts = {part.id: part for part, _ in tree(design).occurrences()}
    bar, ring = (parts[part_id(name, index)].shape for name in ("cam-shaft", "pressure-ring"))
    assert bar is not None
    assert ring is not None
    square = design.shafts[index].shaft.bar ** 2 * length
    return volume(bar.mesh(1e-6)) - square + 2 * volume(ring.mesh(1e-6))
