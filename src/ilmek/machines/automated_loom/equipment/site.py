"""What the guards of a loom, its circuit and the station of its weavers are made for."""

from functools import lru_cache

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.signals import Signal, signals_of
from ilmek.machines.automated_loom.equipment.stopping import StoppingTime, stopping_time
from ilmek.machines.automated_loom.equipment.surroundings import Surroundings, surroundings
from ilmek.records import record


@record
class LoomSite:
    """A loom as its guards see it: the room that it takes, and how it stands still.

    floor    height of the floor over the fell [m]      width    of the cloth [m]
    signals  of its control                             heads, weavers  numbers; one of them is 0
    """

    near: Surroundings
    stops: StoppingTime
    floor: float
    width: float
    signals: tuple[Signal, ...]
    heads: int
    weavers: int


@lru_cache(maxsize=4)
def site_of(loom: LoomDesign) -> LoomSite:
    """The site of an automated loom."""
    return LoomSite(
        near=surroundings(loom),
        stops=stopping_time(loom),
        floor=loom.side.floor,
        width=loom.task.cloth.width,
        signals=signals_of(loom.heads, loom.weavers),
        heads=loom.heads,
        weavers=loom.weavers,
    )
