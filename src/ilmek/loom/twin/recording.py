"""A run of the plant as its inputs with their times: replayed, it gives the same reports and the same digest."""

from collections.abc import Iterator

from ilmek.errors import LoomError
from ilmek.loom.control.ports import PortReport
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.model import FaultRates, PlantModel, plant_model
from ilmek.loom.twin.state import PlantInput, PlantState
from ilmek.loom.twin.step import step
from ilmek.loom.twin.woven import state_of_words, state_words
from ilmek.records import record

MOST_INPUTS = 2_000_000
"""Inputs of a recording."""


@record
class Recording:
    """A recorded run.

    programme  its digest                               start   state at its begin, as of `state_words`
    inputs     each with its time [ns], in order        end     time at its end [ns]
    digest     of its reports, in hexadecimal digits
    """

    programme: str
    rates: FaultRates
    start: tuple[int, ...]
    inputs: tuple[tuple[int, PlantInput], ...]
    end: int
    digest: str


class Recorder:
    """Records the run of a plant from a state: called with every input, as `TwinPort` does.

    Raises LoomError for a carpet with more knots than MOST_INPUTS, and beyond as many inputs.
    """

    def __init__(self, programme: LoomProgramme, rates: FaultRates, state: PlantState) -> None:
        self._programme, self._rates, self._start = programme.digest, rates, state_words(state)
        self._inputs: list[tuple[int, PlantInput]] = []
        if programme.setup.knots > MOST_INPUTS:
            raise _too_long()

    def __call__(self, time: int, one: PlantInput) -> None:
        """An input at a time [ns]."""
        if len(self._inputs) == MOST_INPUTS:
            raise _too_long()
        self._inputs.append((time, one))

    def recording(self, state: PlantState) -> Recording:
        """The run up to a state."""
        inputs = tuple(self._inputs)
        return Recording(self._programme, self._rates, self._start, inputs, state.time, state.digest.hex())


def _too_long() -> LoomError:
    return LoomError(f"a recording of more than {MOST_INPUTS:,} inputs", do="record a smaller carpet")


def replay(recording: Recording, programme: LoomProgramme) -> Iterator[tuple[PlantState, tuple[PortReport, ...]]]:
    """The recorded run once more: state and reports from each input's time to the next one's.

    Where the last state has another digest than the recording, it was changed, or made by another version. Raises
    LoomError for a recording of another programme, times out of order, and an input that the loom cannot carry out.
    """
    if recording.programme != programme.digest:
        raise LoomError("a recording of another programme", allowed="that of this programme", do="give its programme")
    plant = plant_model(programme.setup, recording.rates)
    state = state_of_words(plant, recording.start)
    for now, inputs in _groups(recording):
        if now < state.time:
            raise LoomError(f"an input at {now} ns behind one at {state.time} ns", allowed="inputs in order of time")
        state, before = _run_to(plant, state, now)
        state, at_once = step(plant, state, inputs, 0)
        yield state, (*before, *at_once)
    state, rest = _run_to(plant, state, recording.end)
    yield state, rest


def _groups(recording: Recording) -> Iterator[tuple[int, list[PlantInput]]]:
    """The inputs of each time."""
    group: list[PlantInput] = []
    now = 0
    for time, one in recording.inputs:
        if group and time != now:
            yield now, group
            group = []
        now = time
        group.append(one)
    if group:
        yield now, group


def _run_to(plant: PlantModel, state: PlantState, time: int) -> tuple[PlantState, tuple[PortReport, ...]]:
    if time < state.time:
        raise LoomError(f"an end at {time} ns behind {state.time} ns", allowed="the time of the last input or later")
    return step(plant, state, (), time - state.time)
