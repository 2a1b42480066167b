"""Rates of the workshop: materials by their mass, processes by the time of a machine with its worker.

    price of a step = rate of an hour * (t_piece + n t_feature + L t_m + A t_cm2 + V t_cm3);   once for a batch: set-up

A process takes a time for each piece (to load, to clamp, to deburr), for each of n features (piercings, bores, folds),
per length L, area A and volume V of what it cuts, removes or joins; its set-up is shared by all pieces of a part.
"""

from collections.abc import Mapping
from typing import NamedTuple

ASSUMED = "assumed by this project"


class Rate(NamedTuple):
    """A rate of a material or a process: the label with its unit, value, what is usual, and where it is from."""

    kind: str
    label: str
    value: float
    usual: tuple[float, float]
    source: str = ASSUMED


LASER, BENDING, SAWING, TURNING, MILLING = "laser cutting", "bending", "sawing", "turning", "milling"
GRINDING, WELDING, HARDENING, COATING = "grinding", "welding", "hardening", "coating"
DRILLING = "drilling"

FINEST: Mapping[str, int] = {LASER: 12, SAWING: 14, BENDING: 14, WELDING: 16, TURNING: 6, MILLING: 7, GRINDING: 5}
"""Finest tolerance grade IT that a process holds with care, bores on a milling machine reamed or fine-bored; usual
tables of attainable grades: turning 6 to 13, reaming 6 to 9, milling 7 to 13, grinding 4 to 8. Lasers cut thin sheet to
± 0.1 mm by their makers."""

DRAWN = 11
"""Grade of a bright bar as it is delivered: EN 10278, squares h11, rounds h9 to h11."""

RATES = (
    Rate("structural steel", "per kg", 1.3, (0.8, 2.0)),
    Rate("heat-treatable steel", "per kg", 1.6, (1.0, 2.5)),
    Rate("alloy heat-treatable steel", "per kg", 2.2, (1.4, 3.5)),
    Rate("induction-hardened steel", "per kg", 1.8, (1.0, 3.0)),
    Rate("case-hardened steel", "per kg", 2.0, (1.2, 3.5)),
    Rate("bearing steel", "per kg", 3.0, (1.8, 5.0)),
    Rate("stainless steel", "per kg", 4.5, (3.0, 7.0)),
    Rate("hard-drawn stainless steel", "per kg", 60.0, (30.0, 120.0)),
    Rate("grey cast iron", "per kg", 2.5, (1.5, 4.0)),
    Rate("nodular cast iron", "per kg", 3.0, (1.8, 5.0)),
    Rate("aluminium alloy", "per kg", 6.0, (4.0, 10.0)),
    Rate("tin bronze", "per kg", 14.0, (9.0, 20.0)),
    Rate("POM", "per kg", 7.0, (4.0, 12.0)),
    Rate("beech", "per kg", 3.0, (1.5, 6.0)),
    Rate("carbon fibre", "per kg", 90.0, (50.0, 200.0)),
    Rate(LASER, "per h", 95.0, (60.0, 150.0)),
    Rate(LASER, "h a batch", 0.2, (0.1, 0.5)),
    Rate(LASER, "s a piece", 15.0, (5.0, 60.0)),
    Rate(LASER, "s a feature", 1.0, (0.2, 5.0)),
    Rate(LASER, "s per m", 1.5, (1.0, 4.0)),
    Rate(LASER, "s per cm2", 0.25, (0.15, 0.6), "cutting tables of fibre lasers of 4 to 6 kW: 24 m/min mm in steel"),
    Rate(BENDING, "per h", 50.0, (35.0, 90.0)),
    Rate(BENDING, "h a batch", 0.3, (0.1, 0.6)),
    Rate(BENDING, "s a piece", 20.0, (10.0, 60.0)),
    Rate(BENDING, "s a feature", 20.0, (8.0, 40.0)),
    Rate(SAWING, "per h", 35.0, (25.0, 60.0)),
    Rate(SAWING, "h a batch", 0.1, (0.05, 0.3)),
    Rate(SAWING, "s a piece", 45.0, (15.0, 120.0)),
    Rate(SAWING, "s per cm2", 1.0, (0.6, 3.0), "makers' tables of band saws: 20 to 100 cm2/min in steel"),
    Rate(TURNING, "per h", 50.0, (35.0, 85.0)),
    Rate(TURNING, "h a batch", 0.75, (0.4, 2.0)),
    Rate(TURNING, "s a piece", 60.0, (15.0, 180.0)),
    Rate(TURNING, "s per cm2", 0.6, (0.3, 1.5), "150 m/min, 0.12 mm a turn: 180 cm2/min, half of the time"),
    Rate(TURNING, "s per cm3", 3.0, (1.0, 6.0), "150 m/min, 0.25 mm a turn, 2 mm deep: 75 cm3/min, a quarter of it"),
    Rate(MILLING, "per h", 55.0, (40.0, 95.0)),
    Rate(MILLING, "h a batch", 1.5, (0.5, 4.0)),
    Rate(MILLING, "s a piece", 240.0, (60.0, 600.0)),
    Rate(MILLING, "s a feature", 25.0, (10.0, 60.0)),
    Rate(MILLING, "s per cm2", 1.0, (0.4, 3.0)),
    Rate(MILLING, "s per cm3", 3.0, (0.5, 6.0)),
    Rate(DRILLING, "per h", 45.0, (30.0, 75.0)),
    Rate(DRILLING, "h a batch", 0.3, (0.1, 1.0)),
    Rate(DRILLING, "s a piece", 45.0, (15.0, 120.0)),
    Rate(DRILLING, "s a feature", 20.0, (8.0, 60.0), "drill, counterbore or tap a hole"),
    Rate(GRINDING, "per h", 60.0, (45.0, 100.0)),
    Rate(GRINDING, "h a batch", 1.5, (0.5, 3.0)),
    Rate(GRINDING, "s a piece", 240.0, (60.0, 600.0)),
    Rate(GRINDING, "s per cm2", 12.0, (3.0, 20.0)),
    Rate(WELDING, "per h", 45.0, (30.0, 75.0)),
    Rate(WELDING, "h a batch", 0.25, (0.1, 1.0)),
    Rate(WELDING, "s a piece", 300.0, (120.0, 900.0)),
    Rate(WELDING, "s per m", 500.0, (300.0, 1200.0), "fillet of 4 mm by MAG: 0.35 m/min, the arc burns 35 % of it"),
    Rate(HARDENING, "per h", 50.0, (35.0, 90.0)),
    Rate(HARDENING, "h a batch", 0.3, (0.1, 1.0)),
    Rate(HARDENING, "per kg", 4.0, (2.0, 10.0)),
    Rate(COATING, "per m2", 15.0, (8.0, 30.0)),
)
"""All rates, in the currency of the prices; a process has those of an hour, by its times, of its mass or its area."""
