"""What a loom requires of a machine in it: the carpet, the warps, and the machines designed before."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from ilmek.elements.carpet_yarns import CarpetYarns
from ilmek.machines.weaver_hands import HAND
from ilmek.params import Params
from ilmek.records import record
from ilmek.units import mm
from ilmek.weaving.cloth import Cloth

if TYPE_CHECKING:
    from ilmek.machines.arrangement.side_view import SideView
    from ilmek.machines.automated_loom.params import AutomatedLoomParams
    from ilmek.machines.beat import BeatDrive
    from ilmek.machines.shedding.design import SheddingDesign
    from ilmek.machines.tension_compensator.design import TensionCompensator
    from ilmek.machines.warp_tension.design import WarpTensionDesign
    from ilmek.machines.weaver.design import Weaver
    from ilmek.machines.weft.design import Weft

P = TypeVar("P", bound=Params)

TO_COLUMNS = 100 * mm
"""From a bearing of the cylinders to the columns of a hand loom [m]: shaft end, bearing, bracket; assumed."""


class MachineDesign(Protocol):
    """A design of any machine: it has the parameters that it was made from."""

    @property
    def params(self) -> Params:
        """Its parameters."""
        ...


@record
class LoomTask:
    """The loom's task for one of its machines.

    params   of the loom                                   rows, columns  of knots
    cloth    that is woven: warps, rows, yarns, tension
    period   time of a row's wefts and beats [s]; nan before it is known
    take_up_time, row_time  [s]: of the take-up; of the shortest row; nan before they are known
    designs  of the machines designed before, by their names
    side     the side view of the loom; None before the shedding is designed
    beat     the drive of the beat; None before it is designed
    """

    params: "AutomatedLoomParams"
    rows: int
    columns: int
    cloth: Cloth
    designs: Mapping[str, Any]
    period: float = float("nan")
    take_up_time: float = float("nan")
    row_time: float = float("nan")
    side: "SideView | None" = None
    beat: "BeatDrive | None" = None

    @property
    def yarns(self) -> CarpetYarns:
        """The yarns of the cloth."""
        return self.cloth.carpet_yarns

    @property
    def weft(self) -> "Weft":
        """What lays the wefts. Raises KeyError before it is designed, as for the shedding cams."""
        design: Weft = self.designs["weft"]
        return design

    @property
    def weaver(self) -> "Weaver | None":
        """The knotting head; None before it is designed, and where weavers tie."""
        return self.designs.get("weaver")

    @property
    def shedding(self) -> "SheddingDesign":
        """The shedding cams."""
        design: SheddingDesign = self.designs["shedding"]
        return design

    @property
    def compensator(self) -> "TensionCompensator | None":
        """The tension compensator; None before it is designed."""
        return self.designs.get("tension-compensator")

    @property
    def warp_tension(self) -> "WarpTensionDesign | None":
        """The warp cylinders; None before they are designed."""
        return self.designs.get("warp-tension")

    @property
    def width(self) -> float:
        """Distance of the bearings of cylinders and cam shaft [m]."""
        return self.cloth.width + 2 * self.params.margin

    @property
    def rail_length(self) -> float:
        """Length of the heads' rail [m]: for its belt, and beyond its ends the axes of its retreat are clear of a head
        and its step. Without heads as far as between the bearings; to the columns where these bear what lies along it.
        """
        head, cloth = self.weaver, self.cloth
        if head is None:
            return self.width + (2 * TO_COLUMNS if self.params.shed == HAND else 0.0)
        room = head.width / 2 + self.params.clearance
        return max(self.width, cloth.width + cloth.knot_pitch + 2 * room, head.belt_length)

    def parameters(self, name: str, derived: P) -> P:
        """The parameters of one of its machines: those derived for it, with those that the user set in their place.

        Raises ParameterError where they contradict each other.
        """
        return self.params.machines.over(name, derived)
