"""By which keys and torque a fitter tightens a part: a screw, a nut, an anchor, or the grub screws of a hub.

Torques of grub screws of the class 45H in hubs, and of those of insert bearings: usual values of their makers, which
differ by some per cent. [ISO 4026; ISO 9628; SKF, Y-bearings]
"""

import math

from ilmek.elements.anchor_bolts import ANCHOR
from ilmek.elements.bearing_table import INSERT, ROLLING_BEARINGS
from ilmek.elements.eye_bolts import ROWS
from ilmek.elements.locknuts import locknut_of
from ilmek.elements.machine_screws import SCREWS, screw_of
from ilmek.part.part import SET_SCREW, Part
from ilmek.records import record
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, in_mm, mm

_GRUB = {3 * mm: (1.5 * mm, 0.9), 4 * mm: (2 * mm, 2.2), 5 * mm: (2.5 * mm, 4.0), 6 * mm: (3 * mm, 7.2)}
"""Of grub screws of hubs by thread [m]: width across flats of the socket [m], torque [N m]."""

_INSERT: tuple[tuple[float, tuple[str, float, float]], ...] = (
    (35 * mm, ("M6 x 0.75", 3 * mm, 4.0)),
    (45 * mm, ("M8 x 1", 4 * mm, 6.5)),
    (math.inf, ("M10 x 1", 5 * mm, 16.5)),
)
"""Largest bore of an insert bearing [m], its two grub screws, width across flats [m], torque [N m]."""


@record
class Tightening:
    """What of a part is turned: `number` pieces as designated, by which keys, torque [N m] and preload [N].

    keys  words of the kind of key with its size [m]      torque, preload  nan: by hand; not known
    """

    designation: str
    keys: tuple[tuple[str, float], ...]
    torque: float = math.nan
    preload: float = math.nan
    number: int = 1

    @property
    def tools(self) -> tuple[str, ...]:
        """The keys in words."""
        return tuple(Sentence(words, size=in_mm(size)) for words, size in self.keys)

    def text(self, pieces: int) -> str:
        """What is tightened of some pieces of the part, with its torque."""
        by = Sentence("manual.by-hand") if math.isnan(self.torque) else format_quantity(self.torque, "Nm", 3)
        return f"{pieces * self.number} × {self.designation}, {by}"


def tightening_of(part: Part) -> Tightening | None:
    """How a bought part is tightened; None: nothing of it is turned by a key."""
    if part.purchase is None:
        return None
    row = part.purchase.row
    return _ROWS.get(row) or _of_screw(row) or _of_nut(part, row) or _of_grub_screw(part)


_ROWS = {bolt.name: Tightening(bolt.name, (("manual.bar", bolt.thread),)) for bolt in ROWS} | {
    ANCHOR.designation: Tightening(
        ANCHOR.designation, (("manual.spanner", ANCHOR.key), ("manual.hammer-drill", ANCHOR.drill)), ANCHOR.torque
    )
}
"""Of what is turned by hand or has one size, by its designation."""


def _of_screw(row: str) -> Tightening | None:
    screw = screw_of(row)
    if screw is None:
        return None
    kind = "manual.hexagon-key" if screw.sink else "manual.spanner"
    return Tightening(row, ((kind, screw.key),), screw.torque, screw.tightened)


def _of_nut(part: Part, row: str) -> Tightening | None:
    """Of a locknut, or of the nut of a levelling foot."""
    if nut := locknut_of(row):
        return Tightening(row, (("manual.hook-spanner", nut.outer),), nut.torque, nut.tightened)
    thread = SCREWS.get(row.partition(",")[0]) if part.process == "levelling foot" else None
    return Tightening(f"ISO 4035 - {thread.name}", (("manual.spanner", thread.across),)) if thread else None


def _of_grub_screw(part: Part) -> Tightening | None:
    """Of the grub screws of a hub, or of an insert bearing."""
    assert part.purchase is not None
    if SET_SCREW in part.seats:
        size = part.seats[SET_SCREW].size
        key, torque = _GRUB[size]
        return Tightening(f"ISO 4026 - M{size / mm:g}", (("manual.hexagon-key", key),), torque)
    bearing = ROLLING_BEARINGS.get(part.purchase.row)
    if bearing is None or bearing.kind != INSERT:
        return None
    thread, key, torque = next(own for most, own in _INSERT if bearing.bore <= most + 1e-9)
    return Tightening(f"ISO 4026 - {thread}", (("manual.hexagon-key", key),), torque, number=2)
