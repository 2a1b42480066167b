"""End stops and the ratchet of one input in a forward run.

A stop ends the travel of the input on the side on which it starts. Where the input meets it, its speed comes back by
the coefficient of restitution e, and the rest of the kinetic energy is lost:

    q'+ = -e q'-,    dE = (1 - e²) E                                        [Newton's law of impact]

A ratchet lets the input move in one direction, without backlash. An input that is pressed against a stop, or against
its ratchet, rests there until drive and loads move it away.
"""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import scipy

from ilmek.dynamics.equation_of_motion import GeneralEquation
from ilmek.dynamics.forward_run import ForwardState
from ilmek.dynamics.own_machine import EndStop
from ilmek.dynamics.reversals import RunSample, between, departed
from ilmek.errors import MechanismError
from ilmek.records import record

PROBES = 16
"""Parts of a step of the integrator in which contact is sought."""

SLOW = 1e-5
"""Speed or momentum after an impact, over the greatest before, below which a pressed input stays at its stop."""

SCANNED = 600
"""Parts of the rest of a run in which it is sought when an input leaves its rest, and halvings of that part."""

HALVINGS = 50


class Contact(NamedTuple):
    """Where the input meets a stop, or rests on its ratchet: its state, the way back, and what is lost there.

    away  direction in which it is free, +1 or -1
    """

    at: RunSample
    name: str
    away: float
    rebound: float


@record
class Limits:
    """Stops with the side on which the input is, +1: below the stop; ratchet: the free direction, 0: none."""

    stops: tuple[tuple[EndStop, float], ...] = ()
    ratchet: int = 0

    def contact(self, solver: "scipy.integrate.DOP853", last: RunSample) -> Contact | None:
        """The first contact in the last step, up to a state."""
        found = [contact for contact in self._contacts(solver, last) if contact is not None]
        return min(found, key=lambda contact: contact.at.time, default=None)

    def _contacts(self, solver: "scipy.integrate.DOP853", last: RunSample) -> Iterator[Contact | None]:
        for stop, side in self.stops:
            time = _first(solver, last.time, 0, stop.position, side)
            if time is not None:
                at = between(solver, last.equation, time)
                at.row[0] = stop.position
                yield Contact(at, stop.name, -side, stop.rebound)
        if self.ratchet:
            time = _first(solver, last.time, 1, 0.0, -float(self.ratchet))
            if time is not None:
                yield Contact(between(solver, last.equation, time), "ratchet", float(self.ratchet), 0.0)


def limits_of(stops: Sequence[EndStop], ratchet: int, start: ForwardState) -> Limits | None:
    """The limits of a run; None without any. Raises MechanismError for a start on a stop, or against the ratchet."""
    if not stops and not ratchet:
        return None
    if np.ndim(start.position):
        raise MechanismError("stops and a ratchet are those of one input", do="leave them out")
    position, speed = float(start.position), float(start.speed)
    for stop in stops:
        if stop.position == position:
            raise MechanismError(f"the input starts on its stop {stop.name!r}", do="move the stop or the start")
    if speed * ratchet < 0:
        raise MechanismError(f"the input starts at {speed:g} against its ratchet", do="turn the start or the ratchet")
    return Limits(tuple((stop, math.copysign(1.0, stop.position - position)) for stop in stops), ratchet)


def _first(solver: "scipy.integrate.DOP853", end: float, entry: int, limit: float, side: float) -> float | None:
    """The first time up to `end` in the last step at which side (row[entry] - limit) becomes positive."""
    dense = solver.dense_output()
    times = np.linspace(solver.t_old, end, PROBES + 1)
    over = side * (dense(times)[entry] - limit)
    beyond = np.flatnonzero(over[1:] > 0)
    if len(beyond) == 0:
        return None
    early, late = float(times[beyond[0]]), float(times[beyond[0] + 1])
    if over[beyond[0]] >= 0:  # it leaves the limit, and may be back within this part
        begins = (early + (late - early) / 2**k for k in range(1, HALVINGS))
        free = next((time for time in begins if side * (float(dense(time)[entry]) - limit) < 0), None)
        if free is None:
            return early
        early = free
    return float(
        scipy.optimize.brentq(
            lambda time: side * (float(dense(time)[entry]) - limit), early, late, xtol=1e-15, rtol=1e-15
        )
    )


def after_contact(contact: Contact, greatest: float) -> RunSample | None:
    """The state after a contact; None: the input rests. greatest: speed or momentum of the run until then."""
    before = contact.at
    speed = contact.rebound * abs(float(before.row[1]))
    loss = _kinetic(before) * (1 - contact.rebound**2)
    row = before.row.copy()
    row[-1] -= loss
    if speed > SLOW * greatest:
        row[1] = contact.away * speed
        return _with_signs(RunSample(before.time, row, before.equation), contact.away)
    before.row[:] = row
    before.row[1] = 0.0
    return _left(before, contact.away)


def rest(contact: Contact, end: float) -> RunSample | None:
    """The state in which a resting input leaves; None: it rests until the end of the run [s]."""
    times = np.linspace(contact.at.time, end, SCANNED + 1)
    early = contact.at.time
    for time in times[1:].tolist():
        if _left(contact.at._replace(time=time), contact.away) is not None:
            late = time
            for _ in range(HALVINGS):
                middle = (early + late) / 2
                if _left(contact.at._replace(time=middle), contact.away) is None:
                    early = middle
                else:
                    late = middle
            return _left(contact.at._replace(time=late), contact.away)
        early = time
    return None


def _left(at: RunSample, away: float) -> RunSample | None:
    """The state just after a rest that drive and loads end; None: they press the input on."""
    after, rate = departed(at, away)
    return after if rate * away > 0 else None


def _with_signs(at: RunSample, away: float) -> RunSample:
    equation = at.equation
    return (
        at._replace(equation=equation.departed(at.time, at.row, away)) if isinstance(equation, GeneralEquation) else at
    )


def _kinetic(at: RunSample) -> float:
    """Kinetic energy of a state of one input [J]."""
    if isinstance(at.equation, GeneralEquation):
        terms = at.equation.terms(at.time, at.row)
        return 0.0 if terms is None else float(terms.matrix[0, 0]) * float(at.row[1]) ** 2 / 2
    return float(at.row[1]) ** 2 / 2
