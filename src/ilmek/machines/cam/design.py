"""Design of a cam: motion, size, follower, spring, forces over the turn, roller, hub.

Every largest or least value is an exact bound over the pieces of the programme, not the largest of samples.
"""

import math
from dataclasses import replace

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.barrel import Barrel, undercut_in_space
from ilmek.cams.contact import FollowerLoad
from ilmek.cams.hertz import LINE_YIELD, POINT_YIELD
from ilmek.cams.loaded_cam import JAMMED, CamExtremes, CamShape, CamState, FollowerContact, LoadedCam
from ilmek.cams.programme import CamProgramme, jumps
from ilmek.cams.return_spring import LiftOff, doubling_spring, least_preload, least_rate, lift_off, velocity_drop
from ilmek.cams.trace import CamRole
from ilmek.elements.cam_rollers import ROLLERS, Roller, RollerDuty, find_roller
from ilmek.elements.hubs import Hub, bore_for, hub_for
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.machines.cam.params import CamParams
from ilmek.machines.cam.shape import CamSize, cam_of, cams_of, part_knots, programme_of, roller_width, size_of
from ilmek.records import computed, record, result
from ilmek.report import Json
from ilmek.units import format_quantity

ROOM = 0.8
"""Radius of a roller that is chosen, at most, over the least radius of the pitch curve and over the prime radius."""

MARGIN = 1.2
"""Speed up to which a chosen spring holds the follower, over the speed of the cam."""


@record
class CamDesign:
    """The design of a cam; `follower_load`: mass, load and spring of the follower, at the cam's speed."""

    params: CamParams
    programme: CamProgramme
    size: CamSize
    cams: CamShape
    follower_load: FollowerLoad
    roller: Roller | None
    duty: RollerDuty | None
    hub: Hub
    lift_off: LiftOff
    extremes: CamExtremes
    area: float
    face_width: float = result("mm", "thickness of the cam", least=0.0)
    pressure_limit: float = result("MPa", "allowed Hertz pressure", name="hertz_pressure_limit")

    prime_radius = computed(
        "mm",
        "prime radius Rp; base radius of a flat follower, mean radius of a barrel, travel per radian of a wedge",
        lambda it: it.cam.prime_radius,
        least=0.0,
    )
    prime_radius_min = computed("mm", "smallest for the limit", lambda it: it.size.smallest.value)

    @computed(
        "mm",
        "least convex radius of curvature of the pitch curve, of a flat follower's surface",
        absent="it is nowhere convex",
    )
    def curvature_radius_min(self) -> float | None:
        convex = limits.convex_radius_min(self.cam).value
        return convex if math.isfinite(convex) else None

    curvature_at = computed("deg", "cam angle of that radius", lambda it: limits.convex_radius_min(it.cam).at)

    @computed("mm", "least concave radius of curvature of that curve", absent="it is convex all round")
    def concave_radius_min(self) -> float | None:
        hollow = limits.concave_radius_min(self.cam)
        return hollow.value if hollow else None

    lift = computed("mm", "lift of the follower; of an arm along its arc", lambda it: it.params.lift)
    rise = computed("deg", "cam angle of the rise", lambda it: it.params.rise)
    dwell = computed("deg", "cam angle for which the follower stays lifted", lambda it: it.params.dwell)
    fall = computed("deg", "cam angle of the fall", lambda it: it.params.fall_angle)

    @computed("W", "greatest shaft power", absent=JAMMED)
    def power_max(self) -> float | None:
        return None if self.extremes.jammed else max(self.extremes.torque.value, 0.0) * self.params.speed

    spring_rate = computed(
        "N/mm", "rate of the return spring", lambda it: it.follower_load.rate / it.params.per_unit**2
    )
    preload = computed(
        "N", "spring force at the lowest position", lambda it: it.follower_load.preload / it.params.per_unit
    )
    spring_force_max = computed("N", "its force at full lift", lambda it: it.preload + it.spring_rate * it.params.lift)

    @computed("rpm", "speed of the cam at which the follower lifts off", absent="never")
    def lift_off_speed(self) -> float | None:
        return self.lift_off.speed if math.isfinite(self.lift_off.speed) else None

    @computed("", "roller of the table", name="roller", absent="none, or none fits")
    def roller_name(self) -> str | None:
        return self.roller.name if self.roller else None

    roller_radius = computed(
        "mm", "radius of roller or ball; 0 of knife and flat", lambda it: it.cam.roller_radius, least=0.0
    )

    @computed("h", "life of the roller", absent="no roller of the table, or without load")
    def roller_life(self) -> float | None:
        life = self.duty.time(self.roller) if self.roller and self.duty else math.inf
        return life if math.isfinite(life) else None

    @computed("rpm", "mean speed of the roller", absent="no roller")
    def roller_speed(self) -> float | None:
        return self.duty.turns * self.duty.speed if self.duty else None

    @computed("mm", "bore of the cam", optional=True)
    def bore(self) -> float | None:
        return None if self.params.kind == "wedge" else self.hub.bore

    @computed("mm", "keyway in the cam", optional=True)
    def keyway(self) -> Json:
        return None if self.params.kind == "wedge" else {"width": self.hub.key_width, "depth": self.hub.key_depth}

    @property
    def cam(self) -> CamRole:
        """The cam; of conjugate ones the one that lifts."""
        return self.cams.cam

    @property
    def rise_knots(self) -> FloatArray:
        """Cam angles of the rise [rad] between which it is smooth."""
        return part_knots(self.programme, "rise")

    @property
    def fall_knots(self) -> FloatArray:
        """Cam angles of the fall [rad] between which it is smooth."""
        return part_knots(self.programme, "fall")

    @property
    def cornered(self) -> bool:
        """Whether a jump of the velocity makes a corner that no roller or face can follow; a knife's edge can."""
        sides = [jump.after - jump.before for jump in jumps(self.programme, 1)]
        wrong = any(step < 0 or self.params.led for step in sides)
        return wrong and (self.cam.flat or self.cam.roller_radius > 0)

    @computed("", "whether no surface can guide the follower")
    def undercut(self) -> bool:
        if self.cornered:
            return True
        cam, pair = self.cams
        other = pair is not None and limits.undercut(pair.second)
        both = self.params.kind in ("grooved", "barrel")
        round_ = isinstance(cam, Barrel) and undercut_in_space(cam, both_flanks=both) is not None
        return other or round_ or limits.undercut(cam, both_flanks=both)

    @property
    def loaded(self) -> LoadedCam:
        """The cam and its follower under load."""
        return LoadedCam(contact_of(self.params), self.cams, self.follower_load)

    def state(self, angle: FloatArray) -> CamState:
        """Geometry and forces at cam angles [rad]."""
        return self.loaded.state(angle)

    def hertz(self, angle: FloatArray) -> FloatArray:
        """Hertz pressure [Pa] at cam angles [rad]; NaN where cam and follower cannot be in contact."""
        return self.loaded.hertz(angle, self.face_width)


def design(params: CamParams) -> CamDesign:
    """The cam for the parameters. Raises ParameterError where it cannot exist."""
    programme = programme_of(params)
    size = size_of(params, programme)
    follower_load = follower_load_of(params, programme)
    bare = cam_of(params, programme, size, params.roller_radius or 0.0)
    roller, cams = _with_roller(params, bare, size, follower_load)
    width = roller_width(params, cams.cam.roller_radius)
    loaded = LoadedCam(contact_of(params), cams, follower_load)
    extremes = loaded.extremes(width)
    torque = max(abs(extremes.torque.value), abs(extremes.back_torque.value))
    hub = hub_for(params.bore or bore_for(torque if math.isfinite(torque) else 0.0))
    if params.kind in ("barrel", "face"):
        _check_ring(params, cams.cam.prime_radius - width / 2, hub)
    return CamDesign(
        params=params,
        programme=programme,
        size=size,
        cams=cams,
        follower_load=follower_load,
        roller=roller,
        duty=loaded.duty() if params.follower == "roller" else None,
        hub=hub,
        lift_off=LiftOff(math.inf, 0.0) if params.led else lift_off(programme, follower_load),
        extremes=extremes,
        area=math.nan if params.laid_flat else limits.area(cams.cam),
        face_width=width,
        pressure_limit=pressure_limit(params),
    )


def _check_ring(params: CamParams, inner: float, hub: Hub) -> None:
    """Raise ParameterError where the face of a barrel or end cam reaches its axis, or a given bore the face."""
    if inner <= 0:
        given = f"the face of the {params.kind} cam reaches its axis"
        allowed = f"a face narrower by {format_quantity(-2 * inner, 'mm')}"
        raise ParameterError(given, allowed=allowed, do="set a smaller face_width, or a larger prime_radius")
    if params.bore is not None and hub.reach >= inner:
        given = f"bore={format_quantity(params.bore, 'mm')} does not fit into the {params.kind} cam"
        allowed = f"less than {format_quantity(inner, 'mm')} from the axis, keyway included"
        raise ParameterError(given, allowed=allowed, do="set a smaller bore, or a larger prime_radius")


def contact_of(params: CamParams) -> FollowerContact:
    """How the follower of the parameters touches its cam."""
    return FollowerContact(
        follower=params.follower,
        led=params.led,
        laid_flat=params.laid_flat,
        pivot=params.pivot_distance if params.motion == "oscillating" else None,
        side=params.side_sign,
        crown=params.crown_radius,
        sliding=params.sliding_friction,
        guide=params.guide_friction,
        material=params.material,
        follower_material=params.follower_material,
    )


def follower_load_of(params: CamParams, programme: CamProgramme) -> FollowerLoad:
    """Mass, load and return spring; by default the weakest spring that holds up to the hold speed."""
    if params.led:
        return FollowerLoad(params.speed, params.mass * params.per_unit**2, load=params.load * params.per_unit)
    hold = MARGIN * params.speed if params.hold_speed is None else params.hold_speed
    arc = params.per_unit
    rate, preload = (params.spring_rate or 0.0) * arc**2, (params.preload or 0.0) * arc
    bare = FollowerLoad(hold, params.mass * arc**2, rate, preload, params.load * arc)
    if velocity_drop(programme) is not None:
        return replace(bare, speed=params.speed)
    if params.spring_rate is None and params.preload is None:
        bare = doubling_spring(programme, bare)
    elif params.preload is None:
        bare = replace(bare, preload=least_preload(programme, bare))
    elif params.spring_rate is None:
        bare = replace(bare, rate=least_rate(programme, bare))
    return replace(bare, speed=params.speed)


def pressure_limit(params: CamParams) -> float:
    """Where the weaker of both materials first yields, below its surface [Johnson, Contact Mechanics]."""
    if params.pressure_limit is not None:
        return params.pressure_limit
    strength = min(MATERIALS[name].strength for name in (params.material, params.follower_material))
    return strength * (POINT_YIELD if contact_of(params).at_a_point else LINE_YIELD)


def _with_roller(
    params: CamParams, bare: CamRole, size: CamSize, follower_load: FollowerLoad
) -> tuple[Roller | None, CamShape]:
    """The roller and its cam: as given, from the table, or of half the radius that there is room for.

    Of the table it is the smallest with the required life; where none has it, the largest that there is room for.
    """

    def fitted(radius: float) -> CamShape:
        return cams_of(params, bare.programme, size, radius)

    if params.roller is not None:
        roller = find_roller(params.roller)
        return roller, fitted(roller.radius)
    if params.roller_radius is not None or params.follower in ("knife", "flat"):
        return None, fitted(params.roller_radius or 0.0)
    room = _room(params, bare)
    fitting = [roller for roller in ROLLERS.values() if roller.radius <= ROOM * room]
    if params.follower == "spherical" or not fitting:
        return None, fitted(0.5 * room)
    for roller in fitting:
        duty = LoadedCam(contact_of(params), fitted(roller.radius), follower_load).duty()
        if duty.largest <= roller.force_limit and duty.time(roller) >= params.life:
            return roller, fitted(roller.radius)
    return fitting[-1], fitted(fitting[-1].radius)


def _room(params: CamParams, bare: CamRole) -> float:
    """Radius [m] below which a roller nowhere undercuts the cam, and is smaller than the prime circle."""
    room = min(limits.convex_radius_min(bare).value, bare.prime_radius)
    hollow = limits.concave_radius_min(bare) if params.kind in ("grooved", "barrel") else None
    return room if hollow is None else min(room, hollow.value)
