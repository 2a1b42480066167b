"""The carpet on the loom and off it.

    size on the loom   length  rows * distance of the rows,   width  knots of a row * distance of the knots
    size off the loom  length  l (1 - s_l) / (1 + T / EA),    width  w (1 - s_w)
    mass off the loom  (yarns that stay in it) (1 - loss)

T tension of a warp, EA its stiffness: its elastic strain goes when the carpet is cut off, and the ground follows it.
s_l, s_w shrinkage in washing [ilmek.carpet.washing]. The pile is shorn to its height; what is shorn off is in the yarn
bill's waste. The size that is asked for is that off the loom: the loom's rows and warps are so much farther apart.
"""

from ilmek.carpet.ground import GroundParams, ground_yarns, selvedge_yarn
from ilmek.carpet.sizes import CarpetSize
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.records import computed, record


@record
class OffLoom:
    """A carpet of a width and a length on the loom [m], the warps strained, its yarns of a mass [kg]."""

    width: float
    length: float
    yarns: float
    ground: GroundParams

    woven_size = computed(
        "m", "width and length of the carpet on the loom", lambda it: {"width": it.width, "length": it.length}
    )

    @computed("m", "width and length of the carpet off the loom, shorn and washed")
    def size_off_loom(self) -> dict[str, float]:
        return {
            "width": self.width / self.ground.washing.widening,
            "length": self.length / self.ground.lengthening,
        }

    @computed("mm", "how much longer the carpet is woven than it is off the loom")
    def woven_longer(self) -> float:
        size: dict[str, float] = self.size_off_loom
        return self.length - size["length"]

    mass_off_loom = computed(
        "kg", "the carpet, shorn and washed", lambda it: it.yarns * (1 - it.ground.washing.wash_loss)
    )
    warp_strain = computed(
        "%", "elastic strain of the warps on the loom, which goes off it", lambda it: it.ground.warp_strain
    )


def off_loom(loom: LoomDesign) -> OffLoom:
    """The loom's carpet off the loom."""
    of_knot = float(loom.weaver.yarn_in_knot) if loom.heads else loom.params.billed
    return carpet_off_loom(loom.params, (loom.rows, loom.columns), of_knot)


def carpet_off_loom(params: AutomatedLoomParams, grid: tuple[int, int], of_knot: float) -> OffLoom:
    """A carpet off the loom: rows and knots of a row, pile yarn of a knot [m]."""
    cloth, ground, (rows, columns) = params.cloth, params.ground, grid
    size, quality, pile = CarpetSize(params.width, params.length), params.quality, cloth.carpet_yarns.pile
    of_ground = ground_yarns(size, quality, rows, columns, ground)
    bound = (*of_ground, selvedge_yarn(size, quality, pile.linear_density, ground))
    knots = rows * columns * of_knot * pile.linear_density
    return OffLoom(
        width=columns * cloth.knot_pitch,
        length=rows * cloth.row_distance,
        yarns=knots + sum(one.mass * one.kept for one in bound),
        ground=ground,
    )
