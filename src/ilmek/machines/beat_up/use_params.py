"""Parameters of a beat-up in use: strength of its links, start of its crank, its travel along the carpet."""

from dataclasses import dataclass

from ilmek.machines.strength_params import LINK_MATERIALS, StrengthParams
from ilmek.params import Params, kind
from ilmek.units import mm

STARTS = ("servo", "clutch")
MODES = ("through", "start-stop")


@dataclass(frozen=True, slots=True)
class CastLinkParams(StrengthParams):
    """What links of grey cast iron bear, and their pins in bushes of sintered bronze."""

    material: str = kind.choice("grey cast iron", LINK_MATERIALS, doc="material of the links")


@dataclass(frozen=True, slots=True)
class CrankStartParams(Params):
    """How the crank is started and stopped."""

    drive: str | None = kind.choice(
        None, STARTS, doc="servo, or clutch and brake on a flywheel; default: the cheaper that is enough"
    )
    run_up: float = kind.ratio(
        0.75, above=0.0, at_most=1.0, doc="share of the crank's rotation to the beat in which it reaches its speed"
    )
    efficiency: float = kind.ratio(0.9, at_least=0.05, at_most=1.0, doc="efficiency of bearings and gears")
    speed_drop: float = kind.ratio(
        0.1, at_least=1e-3, at_most=0.9, doc="allowed loss of the flywheel's speed in a beat, with a clutch"
    )


@dataclass(frozen=True, slots=True)
class TravelParams(Params):
    """The slide along the carpet, and what the beater beats there; the defaults are for the thesis' loom."""

    warp_force: float = kind.force(
        10.0, at_least=1e-6, at_most=1e5, doc="force for each warp that the rows need; 10 N for 15 N of tension"
    )
    stroke_warps: int | None = kind.count(
        None, at_least=1, at_most=100_000, doc="warps of a stroke; default: as many as the force is enough for"
    )
    mode: str | None = kind.choice(
        None, MODES, doc="crank between two strokes: runs through, or stands; default: through where the step fits"
    )
    tooth_thickness: float | None = kind.length(
        None, at_least=1e-3 * mm, at_most=50 * mm, doc="thickness of a tooth; default: 0.4 of the warp pitch"
    )
    bar_distance: float = kind.length(
        20 * mm, at_least=0.0, at_most=1.0, doc="distance of the beater's bar from the warps, to the front"
    )
    reach: float = kind.length(20 * mm, at_least=0.1 * mm, at_most=1.0, doc="reach of the beater's teeth in the warps")
    park: float = kind.length(
        0.0,
        at_least=0.0,
        at_most=5.0,
        doc="run of the slide beyond its first and its last stroke, where the beater stands beside weavers",
    )
    beam_length: float | None = kind.length(
        None, at_least=10 * mm, at_most=50.0, doc="length of the beam that carries the slide; default: the slide's"
    )
    slide_mass: float | None = kind.mass(
        None, above=0.0, at_most=1e4, doc="mass on the slide; default: of all parts that stand on it"
    )
    speed: float = kind.speed(1.0, above=0.0, at_most=100.0, doc="allowed speed of the slide")
    acceleration: float = kind.acceleration(10.0, above=0.0, at_most=1e4, doc="allowed acceleration of the slide")
    jerk: float = kind.jerk(1000.0, above=0.0, at_most=1e7, doc="allowed jerk of the slide")
    friction: float = kind.ratio(0.02, at_least=0.0, at_most=1.0, doc="friction of the slide's guideway")
