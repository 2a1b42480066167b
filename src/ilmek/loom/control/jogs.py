"""Jogs: an axis moves alone by a distance that an operator follows by eye, in manual mode."""

from ilmek.loom.control.exchange import JogRequested
from ilmek.loom.control.interlocks import JOG_LIMITS, TensionLimits, jog_axis, violated
from ilmek.loom.control.packml import PackMode, PackState, Refusal, state_name
from ilmek.loom.control.state import AXIS, ControllerState


def jog_refused(state: ControllerState, given: JogRequested, tension: TensionLimits) -> Refusal | None:
    """Why an axis is not moved; None: it is."""
    name = f"a jog of {given.axis[:40]!r} by {given.distance:g}"
    if state.mode is not PackMode.MANUAL or state.state is not PackState.EXECUTE:
        now = f"{state_name(state.state)} of {state.mode.name.lower()} mode"
        return Refusal(f"{name} in {now}", "allowed in Execute of manual mode")
    axis = jog_axis(given.axis)
    if axis is None:
        return Refusal(name, f"axes are {', '.join(JOG_LIMITS)}")
    limit = JOG_LIMITS[axis]
    if not 0 < abs(given.distance) <= limit.distance:
        return Refusal(name, f"up to {limit.distance:g} {limit.unit}, not 0")
    if AXIS in state.progress:
        return Refusal(name, "one axis moves at a time", "wait until the jog has ended")
    if state.sensors is None:
        return Refusal(name, "the sensors must be known", "check the connection to the loom")
    broken = violated(frozenset((axis,)), state.sensors, tension)
    return Refusal(name, f"{broken[0].name}: {broken[0].why}") if broken else None
