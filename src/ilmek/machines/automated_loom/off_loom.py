"""The carpet off the loom, and the warping before it.

    off the loom   length  l (1 - s_l) / (1 + T / EA),   width  w (1 - s_w),   mass  (yarns that stay in it) (1 - loss)
    warping        each warp  l (1 + crimp) + 2 fringe + waste;   time  set-up + n (t_warp + length / speed)

T tension of a warp, EA its stiffness: its elastic strain goes when the carpet is cut off, and the ground follows it.
s_l, s_w shrinkage in washing. The pile is shorn to its height; what is shorn off is in the yarn bill's waste. The
carpet's width and length are those on the loom. Rates of washing and warping are assumed by this project.
"""

from ilmek.carpet.ground import GroundParams, ground_yarns, selvedge_yarn
from ilmek.carpet.sizes import CarpetSize
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.finish_params import FinishParams
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.records import computed, record


@record
class OffLoom:
    """A carpet of a width and a length on the loom [m], its warps stretched by a strain, its yarns of a mass [kg].

    warps, ground  number of warps, and what lengthens each
    """

    finish: FinishParams
    width: float
    length: float
    strain: float
    yarns: float
    warps: int
    ground: GroundParams

    @computed("m", "width and length of the carpet off the loom, shorn and washed")
    def size_off_loom(self) -> dict[str, float]:
        along = (1 - self.finish.shrink_along) / (1 + self.strain)
        return {"width": self.width * (1 - self.finish.shrink_across), "length": self.length * along}

    @computed("mm", "how much longer a carpet is to be woven that has the length off the loom")
    def woven_longer(self) -> float:
        size: dict[str, float] = self.size_off_loom
        return self.length * (self.length / size["length"] - 1)

    mass_off_loom = computed("kg", "the carpet, shorn and washed", lambda it: it.yarns * (1 - it.finish.wash_loss))
    warp_strain = computed("%", "elastic strain of the warps on the loom, which goes off it", lambda it: it.strain)
    warp_cut = computed(
        "m",
        "length of a warp to be wound: carpet, take-up by its crimp, fringes, what is lost in the loom",
        lambda it: it.ground.warp_length(it.length),
    )

    @computed("h", "preparing, drawing in and winding of all warps")
    def dressing_time(self) -> float:
        finish, each = self.finish, float(self.warp_cut)
        return finish.warp_set_up + self.warps * (finish.warp_time + each / finish.warp_speed)


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
        finish=params.finish,
        width=params.width,
        length=params.length,
        strain=cloth.warp_tension / cloth.carpet_yarns.warp.stiffness,
        yarns=knots + sum(one.mass * one.kept for one in bound),
        warps=cloth.warps,
        ground=ground,
    )
