"""Concrete machines. A new machine is a package here and an entry below; `ilmek.machines.catalogue` finds it."""

from dataclasses import dataclass

from ilmek.plugins import Registry


@dataclass(frozen=True, slots=True)
class Entry:
    """A machine of the catalogue.

    part      whether every automated loom has one      beats  names of the kinds of beat that it can be in a loom
    by_hand   whether a hand loom has one
    knotting  whether it can be in a loom's heads
    package   that has its MACHINE; default: the one of its name here
    """

    summary: str
    part: bool = False
    beats: tuple[str, ...] = ()
    knotting: bool = False
    by_hand: bool = False
    package: str = ""

    @property
    def in_a_loom(self) -> bool:
        """Whether an automated loom can have one."""
        return self.part or self.knotting or self.by_hand or bool(self.beats)


_OWN = {
    "automated-loom": Entry("the loom for one carpet: heads, shedding, beat-up, warp tension, timed together"),
    "weaver": Entry("knotting head: six cams on one shaft, one knot a turn (thesis, 2.2.3)", knotting=True),
    "beat-up": Entry(
        "crank-rocker that beats weft and knots to the fell: links, motion, forces", beats=("travelling",)
    ),
    "cam": Entry("a cam and its follower: profile, pressure angle, curvature, forces, spring, roller"),
    "weft": Entry("shuttles or a rapier that lay the wefts: bobbins, stops, tension, motion, axis", part=True),
    "shedding": Entry("cams that open the shed: profile, pressure angle, curvature, torque, square shaft", part=True),
    "hammer": Entry(
        "comb that beats the rows: force per warp, rows it leaves, uniformity, stroke or crank-rockers",
        beats=("linkage", "comb", "guide-cams"),
    ),
    "tension-compensator": Entry(
        "sprung back rest that relieves the lifted warps: levers, springs, tension over the turn", part=True
    ),
    "warp-tension": Entry(
        "cylinder that tensions the warps: slope, deflection, torque, reducer and motor, take-up", part=True
    ),
    "hand-loom": Entry("the loom without drives: weavers tie, open the shed and beat; cylinders wound by hand"),
    "hand-shed": Entry(
        "shed opened by hand: rod, string heddles, levers: forces of the hands, bending, openings", by_hand=True
    ),
    "hand-beat": Entry(
        "comb and tools of a hand loom: energy and number of blows, rows that they leave, times", by_hand=True
    ),
    "tufting": Entry(
        "needle six-bar of a tufting machine: motion, torques of both shafts, forces, friction of the backing"
    ),
    "tufting-machine": Entry(
        "tufting machine for a carpet: needle drives, loopers, proof of the loop, torsion of the shafts, production"
    ),
    "knotting-four-bar": Entry(
        "four-bar with a gripper on its coupler, from links or three poses, one side or two on gears"
    ),
    "knotting-dyad": Entry(
        "two-link arms that tie a proved knot clear of the warps, or every arm through four timed points", knotting=True
    ),
    "path-four-bar": Entry(
        "four-bars whose coupler point passes given points, the nearest within limits or all exact ones"
    ),
    "motion-four-bar": Entry(
        "four-bars whose coupler takes three, four or five given poses, those without defects ranked"
    ),
    "function-four-bar": Entry(
        "four-bars whose rocker generates a function of the crank angle, exact or best over the range"
    ),
}

ENTRIES = Registry("ilmek.machines", _OWN, Entry)
"""Each machine by its name, in the order of the catalogue; its package has the name with _ for -."""

BEATS = {beat: name for name, entry in _OWN.items() for beat in entry.beats}
"""Machines that can beat in a loom, by the kind of beat."""


WEFT_CARRIERS = ("shuttle", "rapier")
"""What can carry the weft through the shed."""


def loom_parts() -> tuple[str, ...]:
    """Machines that every automated loom has, in the order in which they are designed."""
    return tuple(name for name, entry in ENTRIES.items() if entry.part)


def loom_machines() -> tuple[str, ...]:
    """Machines that an automated loom can have."""
    return tuple(name for name, entry in ENTRIES.items() if entry.in_a_loom)
