"""The controller as others see it: a snapshot of its state, and its commands.

The terminal, the command channel and field buses show and command a controller through `ControllerView` alone. Rows
and warp pairs count from 0, from the bottom edge and from the left; times are whole nanoseconds of the loom's clock.
"""

from typing import Protocol

from ilmek.records import value_record


@value_record
class HeadView:
    """A head: its last knot, and what it ties next.

    column, yarn            of the knot in work, else of the last one; None: none yet in this row
    tied, knots             knots of the row that are done, and all of the row
    next_yarn               of its next knot in another yarn; None: none in this row
    """

    column: int | None
    tube: int | None
    yarn: int | None
    tied: int
    knots: int
    next_yarn: int | None


@value_record
class AlarmView:
    """An alarm that is raised.

    name    stable, as in the list of alarms      stops  whether the loom stands until it is cleared
    """

    name: str
    cause: str
    remedy: str
    stops: bool
    time: int


@value_record
class YarnView:
    """Yarn of a tube of a head: index of the yarn, and what is left of its package [m]."""

    head: int
    tube: int
    yarn: int
    left: float


@value_record
class WeftView:
    """A bobbin of weft: its name, and the rows that it lasts."""

    name: str
    left: int


@value_record
class Snapshot:
    """State of a controller at an instant.

    programme    its digest                             state, mode   names of PackML, for example "Execute"
    row, rows    in work, from 0, and all               commands      that the state permits, by name
    knots, total certain knots, and all of the carpet   uncertain     knots of which the journal has no end
    time, left   of the loom's clock [ns]: until now, and until the end by the programme, without faults
    speed        knots a second of the loom's clock, lately
    faults       knots that had to be tried again
    stop         what the operator changes in the stop that the loom waits in; "": none
    requests     questions to the operator, which the commands "yes" and "no" answer one after the other
    """

    programme: str
    state: str
    mode: str
    commands: tuple[str, ...]
    row: int
    rows: int
    knots: int
    total: int
    uncertain: int
    time: int
    left: int
    speed: float
    faults: int
    stop: str
    heads: tuple[HeadView, ...]
    alarms: tuple[AlarmView, ...]
    yarns: tuple[YarnView, ...]
    wefts: tuple[WeftView, ...]
    requests: tuple[str, ...] = ()


@value_record
class Answer:
    """The answer to a command: whether it is carried out, and why not."""

    ok: bool
    reason: str = ""


class ControllerView(Protocol):
    """A running controller. Its methods may be called from any thread."""

    def snapshot(self) -> Snapshot:
        """Its state after the last event; takes less than a millisecond."""

    def command(self, name: str) -> Answer:
        """Give a command by its name; returns when the controller has answered and the snapshot shows it.

        Commands are those of PackML, for example "hold"; "production", "maintenance" and "manual", which choose the
        mode; "resume", which goes on with the carpet from any state; "acknowledge", all alarms;
        "yes" and "no", which answer the first request; "rows-back 3", three whole rows and the row in work were taken
        out; "jog beater 0.05rad".
        """
