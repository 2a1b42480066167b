"""The cyclogram of the knotting head: six cams on one shaft that turns once for each knot.

The thesis moves the sley by a gear beside its five cams; here it has the sixth. The order is the thesis' (section
2.2.3, Figure 2.11). The angles follow from the steps of the turn (`motions`), or from the optimum that `timing.solver`
finds: the shortest cycle that the tools' limits allow; where that is shorter than the required one, the cyclogram of
the required one whose largest acceleration, over its limit, is least.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TypeAlias

from ilmek.cams.laws import LAWS
from ilmek.errors import ParameterError
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, HANDLER, OPENER, SIDE_GRASP, SIDE_MOTION, SLEY
from ilmek.machines.weaver.params import WeaverParams
from ilmek.timing.cyclogram import Cyclogram, Moment, Relation, Track, TrackEvent, TrackSegment, riding
from ilmek.timing.solver import least_acceleration, least_period, period_needed
from ilmek.units import deg, mm, turn

SOURCE = "thesis, 2.2.3: order of the knotting sequence"

TUBE_TURN, DRAW_TURN, PRESENT_TURN = 90 * deg, 110 * deg, 70 * deg
"""Rotations of the handler to the tube, drawing the pile, and to the side grippers; it turns on to come home."""

ARMS_RADIUS = 23.2 * mm
"""Least radius of the handler where arms tie: its shaft passes under their solenoids [m]; found by the clearances."""

LEAVES, LEFT_SHARE = "opener leaves", 0.4
"""Event of the opener's return, and its share of it, from which the sley may come down; assumed by this project."""

_SAME = 1e-9

_Needed: TypeAlias = tuple[float, float | None]
"""Times of the cutter and of the arms [s]."""


def handler_radius(params: WeaverParams, pile: float) -> float:
    """Radius at which the handler draws a length of pile yarn by `DRAW_TURN`, or by less [m]."""
    return max(pile / DRAW_TURN, ARMS_RADIUS if params.with_arms else 0.0)


def cyclogram(params: WeaverParams, crossing: float, pile: float) -> Cyclogram:
    """The head's cyclogram at the required cycle; positions [m], of the handler [rad].

    crossing  travel of the side grippers along the screw [m]     pile  length of the yarn that the handler draws [m]
    """
    drawn = TUBE_TURN + pile / handler_radius(params, pile)
    shown = drawn + PRESENT_TURN
    sley = params.sley_stroke
    tools = (
        _track(
            params,
            Track(HANDLER, "cam 5", (), unit="deg", revolves=turn),
            {
                "to tube": (0.0, TUBE_TURN),
                "draw": (TUBE_TURN, drawn),
                "present": (drawn, shown),
                "home": (shown, 2 * math.pi),
            },
            {"grasp": "", "cut": ""},
        ),
        _track(params, Track(SLEY, "cam 6", ()), {"down": (0.0, sley), "up": (sley, 0.0)}, {"knot down": "down"}),
    )
    return Cyclogram(
        "knot", params.cycle, (*(_opener(params) if params.with_arms else _grippers(params, crossing)), *tools)
    )


def _opener(params: WeaverParams) -> tuple[Track, ...]:
    """The opener on a cam of its own, where arms tie."""
    opened = params.opening
    positions = {"open warps": (0.0, opened), "return": (opened, 0.0)}
    return (_leaving(_track(params, Track(OPENER, "cam 2", ()), positions, {"warps open": "open warps"})),)


def _grippers(params: WeaverParams, crossing: float) -> tuple[Track, ...]:
    """Side and centre grippers, four cams."""
    jaw, back, centre = params.jaw, params.pull_back, params.centre_stroke
    opened, far = params.opening, params.opening + crossing
    return (
        _track(
            params,
            Track(SIDE_GRASP, "cam 1", ()),
            {"close": (0.0, jaw), "open": (jaw, 0.0)},
            {"pile held": "close", "pile released": "open"},
        ),
        # The warp opener sits on the side grippers; from the opened warps on the screw turns them.
        _leaving(
            _track(
                params,
                Track(SIDE_MOTION, "cam 2", ()),
                {
                    "pull back": (0.0, -back),
                    "open warps": (-back, opened),
                    "cross": (opened, far),
                    "turn back": (far, opened),
                    "return": (opened, 0.0),
                },
                {"warps open": "open warps", "pile crossed": "cross"},
            )
        ),
        _track(
            params,
            Track(CENTRE_GRASP, "cam 3", ()),
            {"close": (0.0, jaw), "open": (jaw, 0.0)},
            {"knot held": "close", "knot released": "open"},
        ),
        _track(
            params,
            Track(CENTRE_MOTION, "cam 4", ()),
            {"forward": (0.0, centre), "return": (centre, 0.0)},
            {"ends drawn out": "return"},
        ),
    )


def _leaving(track: Track) -> Track:
    """The track of the opener with the event from which the sley may follow it."""
    return replace(track, events=(*track.events, riding(LEAVES, track.segment("return"), LEFT_SHARE)))


def _track(
    params: WeaverParams, track: Track, positions: Mapping[str, tuple[float, float]], events: Mapping[str, str]
) -> Track:
    """A track with its motions from position to position, and its events at the end of a motion, or by themselves."""
    at, law = params.motions(track.name), LAWS[params.law]
    parts = {name: TrackSegment(name, *at[name], *ends, law) for name, ends in positions.items()}
    found = (riding(name, parts[on]) if on else TrackEvent(name, at[name][0]) for name, on in events.items())
    return replace(track, segments=tuple(parts.values()), events=tuple(found))


def relations(gap: float, cut: float = 0.0, arms: float | None = None) -> tuple[Relation, ...]:
    """The order of the motions, each at least `gap` after the other [rad].

    cut   angle that the cutter needs     arms  angle that arms need between opener and sley; default: no arms
    """
    blade = Relation(Moment(HANDLER, "present", "start"), Moment(HANDLER, "draw", "end"), max(gap, cut), "the cutter")
    handler = (
        (Moment(HANDLER, "grasp", "event"), Moment(HANDLER, "to tube", "end")),
        (Moment(HANDLER, "draw", "start"), Moment(HANDLER, "grasp", "event")),
        (Moment(HANDLER, "cut", "event"), Moment(HANDLER, "draw", "end")),
        (Moment(HANDLER, "present", "start"), Moment(HANDLER, "cut", "event")),
    )
    order = (*handler, *(_GRIPPERS_ORDER if arms is None else _ARMS_ORDER))
    between = (
        ()
        if arms is None
        else tuple(
            Relation(then, Moment(OPENER, "open warps", "end"), max(gap, arms), "the arms tie the knot")
            for then in (Moment(SLEY, "down", "start"), Moment(OPENER, "return", "start"))
        )
    )
    return (*(Relation(then, first, gap, SOURCE) for then, first in order), blade, *between)


def _sley_behind(opener: str) -> tuple[tuple[Moment, Moment], ...]:
    """The sley comes down as the opener leaves its path, and is not down before the opener is back."""
    return (
        (Moment(SLEY, "down", "start"), Moment(opener, LEAVES, "event")),
        (Moment(SLEY, "down", "end"), Moment(opener, "return", "end")),
    )


_ARMS_ORDER = (
    (Moment(HANDLER, "home", "start"), Moment(HANDLER, "present", "end")),
    (Moment(OPENER, "open warps", "start"), Moment(HANDLER, "home", "end")),
    *_sley_behind(OPENER),
    (Moment(SLEY, "up", "start"), Moment(SLEY, "down", "end")),
)

_GRIPPERS_ORDER = (
    (Moment(SIDE_GRASP, "close", "start"), Moment(HANDLER, "present", "end")),
    (Moment(SIDE_MOTION, "pull back", "start"), Moment(SIDE_GRASP, "close", "end")),
    (Moment(HANDLER, "home", "start"), Moment(SIDE_MOTION, "pull back", "end")),
    (Moment(SIDE_MOTION, "open warps", "start"), Moment(HANDLER, "home", "end")),
    (Moment(CENTRE_MOTION, "forward", "start"), Moment(SIDE_MOTION, "cross", "end")),
    (Moment(CENTRE_GRASP, "close", "start"), Moment(CENTRE_MOTION, "forward", "end")),
    (Moment(SIDE_GRASP, "open", "start"), Moment(CENTRE_GRASP, "close", "end")),
    (Moment(SIDE_MOTION, "turn back", "start"), Moment(SIDE_GRASP, "open", "end")),
    (Moment(CENTRE_MOTION, "return", "start"), Moment(SIDE_GRASP, "open", "end")),
    (Moment(SIDE_MOTION, "return", "start"), Moment(CENTRE_MOTION, "return", "end")),
    (Moment(SLEY, "down", "start"), Moment(CENTRE_MOTION, "return", "end")),
    *_sley_behind(SIDE_MOTION),
    (Moment(CENTRE_GRASP, "open", "start"), Moment(SLEY, "down", "end")),
    (Moment(SLEY, "up", "start"), Moment(SLEY, "down", "end")),
)


def arms_window(cyclogram: Cyclogram) -> tuple[float, float]:
    """Cam angles between which arms tie [rad]: from the opened warps until the opener or the sley moves."""
    opener, sley = cyclogram.track(OPENER), cyclogram.track(SLEY)
    last = min(opener.segment("return").start, sley.segment("down").start)
    return opener.segment("open warps").end, last


def optimised(limited: Cyclogram, gap: float, needed: _Needed) -> Cyclogram:
    """The cyclogram with the same motions at better cam angles, at its period, or at the shortest that is possible.

    limited  its tracks have limits      gap  of motions in sequence [rad]      needed  times of cutter and arms [s]
    """
    if not within(limited, gap, needed, limited.period):
        shortest = _shortest(limited, gap, needed)
        return replace(shortest, period=shortest.period * (1 + _SAME))
    return least_acceleration(_ordered(limited, gap, needed, limited.period)).cyclogram


def _shortest(limited: Cyclogram, gap: float, needed: _Needed) -> Cyclogram:
    """The shortest cycle in which cutter and arms have their times; their angles follow the cycle, so bisection."""
    low = high = period_needed(_ordered(limited, gap, (0.0, needed[1] and 0.0), 1.0))
    while not within(limited, gap, needed, high):
        low, high = high, 2 * high
    while high - low > _SAME * high:
        middle = (low + high) / 2
        low, high = (low, middle) if within(limited, gap, needed, middle) else (middle, high)
    return replace(least_period(_ordered(limited, gap, needed, high)).cyclogram, period=high)


def within(limited: Cyclogram, gap: float, needed: _Needed, period: float) -> bool:
    """Whether a period [s] is enough for the motions, with the angles that cutter and arms need at it.

    limited, gap, needed  as of `optimised`
    """
    try:
        return period_needed(_ordered(limited, gap, needed, period)) <= period * (1 + _SAME)
    except ParameterError:  # the times take more than the turn
        return False


def _ordered(limited: Cyclogram, gap: float, needed: _Needed, period: float) -> Cyclogram:
    cutting, arms = needed
    angle = turn / period
    return replace(limited, relations=relations(gap, cutting * angle, None if arms is None else arms * angle))
