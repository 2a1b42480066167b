"""The knotting head's design: cycle, limits, carriage and colour selector."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ilmek.cams.loaded_plate_cam import CamShaftDrive, LoadedPlateCam, drive_for, torque_at
from ilmek.machines.weaver.cam_belt import CamBelt, cam_belt
from ilmek.machines.weaver.cams import cams_for
from ilmek.machines.weaver.carriage_belt import BESIDE
from ilmek.machines.weaver.cutter_motor import motor_length
from ilmek.machines.weaver.cyclogram import arms_window, handler_radius, optimised, relations, within
from ilmek.machines.weaver.cyclogram import cyclogram as knot_cyclogram
from ilmek.machines.weaver.forces import HeadForces
from ilmek.machines.weaver.grippers import Grippers, grippers_for, yarn_needed
from ilmek.machines.weaver.head_shape import HeadShape, head_shape, head_tools
from ilmek.machines.weaver.knot import on_the_pair, proof_text, tied_by
from ilmek.machines.weaver.magazine import Magazine, fewest_tiers
from ilmek.machines.weaver.motions import CENTRE_MOTION, HANDLER, OPENER, SIDE_MOTION, SLEY
from ilmek.machines.weaver.opener import TEETH, Opener, opener_for
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.selector import selector_of
from ilmek.machines.weaver.tool_parts import ToolBodies
from ilmek.machines.weaver.widths import case_width
from ilmek.records import computed, record, result
from ilmek.timing.cyclogram import Cyclogram, Relation
from ilmek.timing.s_curve import move_time, travel_time
from ilmek.timing.track import ActuatorLimits, Track, peak_acceleration, peak_speed, shortest_period
from ilmek.units import mm, turn
from ilmek.weaving.knots.proof import TiedKnot, no_knot
from ilmek.weaving.warp_opening import WarpSpans

_USUAL_STEPS = WeaverParams().steps

_WHOLE = 1e-9
"""Part of a millimetre, and of a tier, that is rounding."""


@dataclass(frozen=True, slots=True)
class TrackPeaks:
    """A track at the head's cycle: stroke [m], largest speed [m/s] and acceleration [m/s²], and the shortest cycle
    that its limits allow [s]; of the handler at the tip.
    """

    stroke: float
    speed: float
    acceleration: float
    shortest: float


@record
class Weaver:
    """A designed knotting head.

    cyclogram  at its cycle                   peaks   by track, in order of the cyclogram
    grippers   in plan view                   tied    the knot that their motions tie, proved; none where arms tie
    cams       one for each track             drive   of the cam shaft, belt: from its reducer
    opener     of the warps                   magazine  of the tubes
    shape      in the side view           tool_bodies  the tools as bodies
    needs      width of what is in the head [m], by name
    """

    params: WeaverParams
    cyclogram: Cyclogram
    peaks: Mapping[str, TrackPeaks]
    cycle: float = result("s", "time of a knot: as required, or the shortest possible", name="cycle_time_knot")
    drawn: float = result("mm", "pile yarn drawn for a knot", name="yarn_drawn")
    handler_radius: float = result("mm", "radius at which the handler draws that yarn")
    grippers: Grippers
    tied: TiedKnot
    carriage_step: float = result("s", "time of the step to the next knot", name="carriage_step_time")
    carriage_window: float = result("s", "time in which no tool is in the warps")
    travel: float = result("s", "time of each further pitch", name="carriage_travel_time")
    colour_change: float = result("s", "mean time to bring another tube in line", name="colour_change_time")
    cams: tuple[LoadedPlateCam, ...]
    drive: CamShaftDrive
    belt: CamBelt
    opener: Opener
    magazine: Magazine
    shape: HeadShape
    tool_bodies: ToolBodies
    width: float = result("mm", "width of the head, along the row", name="head_width_chosen")
    needs: Mapping[str, float] = result("mm", "width that each content of the head needs", name="head_width_needed")

    @computed("s", "shortest cycle that speeds and accelerations allow", name="cycle_time_shortest")
    def shortest(self) -> float:
        return self.peaks[self.limiting].shortest

    knots_per_minute = computed("", "knots of one head in a minute, without colour changes", lambda it: 60 / it.cycle)
    cam_speed = computed("rpm", "speed of the cam shaft", lambda it: it.cyclogram.speed)
    speed_max = computed(
        "m/s", "largest speed of each track", lambda it: {name: peak.speed for name, peak in it.peaks.items()}
    )

    @computed("m/s^2", "largest acceleration of each track")
    def acceleration_max(self) -> dict[str, float]:
        return {name: peak.acceleration for name, peak in self.peaks.items()}

    @computed("", "the knot that the grippers' motion ties on the pair of warps, proved", absent="none")
    def knot_tied(self) -> str | None:
        return on_the_pair(self.tied)

    knot_why = computed("", "conclusion of the proof", lambda it: proof_text(it.tied))
    yarn_billed = computed(
        "mm", "pile yarn of a knot by the yarn bill, what is shorn off included", lambda it: it.params.billed
    )
    yarn_in_knot = computed(
        "mm", "pile yarn that stays in the carpet for a knot", lambda it: it.params.billed - 2 * it.params.cut_waste
    )
    cut_waste = computed("mm", "pile yarn cut off for a knot", lambda it: it.drawn - it.yarn_in_knot)

    @computed("s", "time from the first tube to the last")
    def colour_change_longest(self) -> float:
        return self.magazine.longest_time

    def cam(self, track: str) -> LoadedPlateCam:
        """The cam of a track. Raises KeyError where it has none."""
        return {cam.name: cam for cam in self.cams}[track]

    @property
    def belt_length(self) -> float:
        """Length of the belt on its straight line, with its clamps, for the row and the steps at its ends [m]."""
        cloth = self.params.cloth
        return cloth.width + cloth.knot_pitch + 2 * BESIDE

    @property
    def tools(self) -> tuple[Track, ...]:
        """The tracks of its own tools; the cyclogram has those of arms besides."""
        return tuple(track for track in self.cyclogram.tracks if track.name in self.peaks)

    @computed("", "the track that sets the shortest cycle", name="cycle_time_set_by")
    def limiting(self) -> str:
        return max(self.peaks, key=lambda name: self.peaks[name].shortest)

    @computed("s", "from cut to next grasp: a selector that knows the next colour could move in it; not used")
    def selector_window(self) -> float:
        events = {event.name: event.angle for event in self.cyclogram.track(HANDLER).events}
        return (turn - events["cut"] + events["grasp"]) / self.cyclogram.speed


def design(params: WeaverParams) -> Weaver:
    """The head that ties a knot in the required time, or in the shortest that speeds and accelerations allow."""
    drawn, grippers = _grippers(params)
    radius = handler_radius(params, drawn)
    cycle = _within_limits(params, knot_cyclogram(params, grippers.crossing, drawn), radius)
    opener = _opener(params, grippers)
    reaching = head_tools(params, grippers, drawn)
    tools = ToolBodies(params, grippers, opener, reaching, radius)
    window, cams = carriage_window(cycle), cams_for(HeadForces(params, cycle, opener, radius), tools)

    most = float(np.abs(torque_at(cams, cams[0].angle)).max())
    belt = cam_belt(most, max(cam.radius for cam in cams), params.cam_belt, params.shaft)
    rest = {"cams": case_width(params), "warps pushed aside": min(opener.crowd, params.opener.crowd_limit)}
    if params.with_arms:
        rest["arms"] = params.arms.width
    magazine = _magazine(params, max(rest.values()))
    needs = {**rest, "tubes": magazine.width}
    return Weaver(
        params=params,
        cyclogram=cycle,
        peaks={track.name: _peaks(track, cycle.period, radius, params) for track in cycle.tracks},
        cycle=cycle.period,
        drawn=drawn,
        handler_radius=radius,
        grippers=grippers,
        tied=no_knot("arms tie it") if params.with_arms else tied_by(cycle, grippers, params.jaw),
        carriage_step=move_time(params.cloth.knot_pitch, params.carriage),
        carriage_window=window,
        travel=travel_time(params.cloth.knot_pitch, window, params.carriage),
        colour_change=magazine.mean_time,
        cams=cams,
        drive=drive_for(cams, cycle.speed, belt.ratio),
        belt=belt,
        opener=opener,
        magazine=magazine,
        shape=head_shape(reaching, cams, magazine, selector_of(params, magazine), motor_length(params)),
        tool_bodies=tools,
        width=params.head_width or math.ceil(max(needs.values()) / mm - _WHOLE) * mm,
        needs=needs,
    )


def stretches(params: WeaverParams) -> bool:
    """Whether the usual angles of the motions may be exchanged for better ones: no others are set, nor in use."""
    usual = params.steps == _USUAL_STEPS and not any(angles.given for angles in params.tool_angles)
    return usual and not params.optimise


def ties_in_time(params: WeaverParams) -> bool:
    """Whether the motions, stretched where they may be, tie within the required cycle: without a whole design."""
    if not params.optimise and not stretches(params):
        return ties_as_set(params)
    drawn, grippers = _grippers(params)
    required = knot_cyclogram(params, grippers.crossing, drawn)
    limited = replace(required, tracks=_limited(params, required, handler_radius(params, drawn)))
    return within(limited, params.relation_gap, (params.cutting_time, params.arms.time), params.cycle)


def ties_as_set(params: WeaverParams) -> bool:
    """Whether the motions at the angles that are set tie within the required cycle: without a whole design."""
    drawn, grippers = _grippers(params)
    tied = _within_limits(params, knot_cyclogram(params, grippers.crossing, drawn), handler_radius(params, drawn))
    return tied.period <= params.cycle * (1 + _WHOLE)


def head_relations(weaver: Weaver) -> tuple[Relation, ...]:
    """The order of the head's motions, the time of arms included."""
    time = weaver.params.arms.time
    return relations(weaver.params.relation_gap, arms=None if time is None else time / weaver.cycle * turn)


def _grippers(params: WeaverParams) -> tuple[float, Grippers]:
    """The yarn drawn for a knot [m], and the grippers for it."""
    drawn = max(params.billed, params.arms.yarn if params.with_arms else yarn_needed(params))
    return drawn, grippers_for(params, drawn)


def _opener(params: WeaverParams, grippers: Grippers) -> Opener:
    """The opener for the grippers, or for the arms."""
    own, cloth = params.opener, params.cloth
    spans = WarpSpans(
        tension=cloth.warp_tension,
        stiffness=cloth.carpet_yarns.warp.stiffness,
        length=max(own.warp_length, own.front_span + own.height + own.back_span),
        front=own.front_span,
        back=own.back_span,
    )
    arms = params.arms
    outside = params.pair / 2 + (arms.outer or cloth.warp_pitch)
    reach = arms.depth if params.with_arms else params.opening + grippers.crossing
    opener = opener_for(
        params.pair,
        outside if params.with_arms else abs(grippers.warps[-1].real),
        params.opening,
        cloth.warp_pitch,
        params.warp,
        spans,
        params.friction,
        (own.wall or TEETH[-1], 2 * own.plate, reach),
    )
    if own.wall is not None:
        return opener
    return next((one for one in (replace(opener, wall=wall) for wall in TEETH) if one.bend <= own.bend_limit), opener)


def _magazine(params: WeaverParams, rest: float) -> Magazine:
    """The magazine in as few tiers as make it no wider than the head, or than the rest of it [m]."""
    most = max(1, min(params.tubes, math.floor(params.magazine_room / params.tube_pitch + _WHOLE)))
    width = params.head_width or rest
    tiers = params.tube_tiers or fewest_tiers(params.magazine, params.tubes, params.tube_pitch, width, most)
    return Magazine(params.magazine, params.tubes, params.tube_pitch, params.selector, min(tiers, params.tubes))


def _within_limits(params: WeaverParams, required: Cyclogram, radius: float) -> Cyclogram:
    """The cyclogram at the required cycle, or at the shortest that the limits allow."""
    if params.optimise:
        limited = replace(required, tracks=_limited(params, required, radius))
        return optimised(limited, params.relation_gap, (params.cutting_time, params.arms.time))
    shortest = max(_peaks(track, required.period, radius, params).shortest for track in required.tracks)
    if params.arms.time is not None:
        first, last = arms_window(required)
        shortest = max(shortest, params.arms.time * turn / max(last - first, params.relation_gap))
    return replace(required, period=max(required.period, shortest))


def _limited(params: WeaverParams, required: Cyclogram, radius: float) -> tuple[Track, ...]:
    """The tracks with the limits of their actuators; the handler's are of its tip."""
    speed, acceleration = params.speed_limit, params.acceleration_limit
    arms = {track: radius if track.name == HANDLER else 1.0 for track in required.tracks}
    return tuple(replace(track, limits=ActuatorLimits(speed / arm, acceleration / arm)) for track, arm in arms.items())


def carriage_window(cyclogram: Cyclogram) -> float:
    """Time in which the head may step along the row [s]: from the last tool out of the warps to the opener's entry."""
    names = {track.name for track in cyclogram.tracks}
    opener = cyclogram.track(SIDE_MOTION if SIDE_MOTION in names else OPENER)
    returns = [cyclogram.track(name).segment("return").end for name in (opener.name, CENTRE_MOTION) if name in names]
    out = max(*returns, cyclogram.track(SLEY).segment("up").end)
    return (turn - out + opener.segment("open warps").start) / cyclogram.speed


def _peaks(track: Track, period: float, radius: float, params: WeaverParams) -> TrackPeaks:
    arm = radius if track.name == HANDLER else 1.0
    return TrackPeaks(
        track.stroke * arm,
        peak_speed(track, period) * arm,
        peak_acceleration(track, period) * arm,
        shortest_period(track, params.speed_limit / arm, params.acceleration_limit / arm),
    )
