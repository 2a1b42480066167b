"""What a run is to weave, and how; read from the options of a command."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from ilmek.errors import ParameterError, shortened
from ilmek.io.stops_file import read_stops
from ilmek.loom.control.opening import LARGEST_GROUP
from ilmek.loom.control.sequence import ROWS_BACK
from ilmek.loom.operations import LoomSetup
from ilmek.loom.twin.faults import RATES, StopParams
from ilmek.loom.twin.model import NO_FAULTS, FaultRates, fault_rates
from ilmek.params import Setting
from ilmek.records import value_record

FASTEST = 1e6
"""Largest speed of the simulated loom's clock; beyond it, it is as fast as possible."""

OPERATORS = ("auto", "ask")

FAST, FAST_COMMIT = 100.0, 64
"""Above this speed a group commit has so many knots where none is given, at most this speed one knot."""

_SEEDS = 2**64


@value_record
class RunOrder:
    """A run.

    programme  the file                       journal  folder; default: beside the programme, NAME.journal
    new        begin another carpet           speed    of the simulated loom's clock; None: as fast as possible
    commit     knots of a group commit        faults   seed of the simulated faults; None: no faults
    stops      their rates                    operator faults and changes are seen to without anybody
    start      weave at once; else wait for commands
    serves     go on after the carpet and after a stop, for commands; else end with them
    record     keep all inputs of the simulated loom
    rows_back  whole rows that were taken out before the row in work, and that row; None: none
    """

    programme: Path
    journal: Path | None = None
    new: bool = False
    speed: float | None = 1.0
    commit: int = 1
    faults: int | None = None
    stops: StopParams = StopParams()
    operator: bool = True
    start: bool = True
    serves: bool = False
    record: bool = False
    rows_back: int | None = None

    @property
    def folder(self) -> Path:
        """The journal's folder."""
        return self.journal or self.programme.with_suffix(".journal")

    def rates(self, setup: LoomSetup) -> FaultRates:
        """Probabilities of the simulated faults on a loom."""
        return NO_FAULTS if self.faults is None else fault_rates(self.stops, setup, self.faults)


def read_run_order(
    programme: Path,
    speed: str,
    journal: Path | None,
    *,
    new: bool = False,
    commit: int | None = None,
    faults: str | None = None,
    stops: Path | None = None,
    settings: Mapping[str, Setting] = MappingProxyType({}),
    operator: str = "auto",
    rows_back: int | None = None,
) -> RunOrder:
    """A run from the options of a command, as texts.

    stops     file of the rates of faults; those in `settings` replace them
    Raises ParameterError, UnitError, LoomError.
    """
    factor = _speed(speed)
    if commit is None:
        commit = FAST_COMMIT if factor is None or factor > FAST else 1
    if not 1 <= commit <= LARGEST_GROUP:
        raise ParameterError(f"--commit {commit}", allowed=f"1 to {LARGEST_GROUP:,} knots")
    if operator not in OPERATORS:
        raise ParameterError(f"--operator {shortened(operator)!r}", allowed=", ".join(OPERATORS))
    if faults is None and (stops is not None or settings):
        raise ParameterError("rates of faults without --faults", do="give a seed: --faults 7")
    for name in settings:
        if name not in RATES:
            raise ParameterError(f"--set {shortened(name)}", allowed=f"rates of faults: {', '.join(RATES)}")
    seed = None if faults is None else read_seed("--faults", faults)
    if rows_back is not None and not 0 <= rows_back <= ROWS_BACK:
        raise ParameterError(f"--rows-back {rows_back}", allowed=f"0 to {ROWS_BACK}")
    rates, automatic = read_stops(stops, settings), operator == "auto"
    return RunOrder(programme, journal, new, factor, commit, seed, rates, automatic, rows_back=rows_back)


def _speed(text: str) -> float | None:
    """A factor like 1000x; None for max.

    >>> _speed("1000x"), _speed("0.5"), _speed("max")
    (1000.0, 0.5, None)
    """
    if text == "max":
        return None
    try:
        found = float(text.removesuffix("x"))
    except ValueError:
        found = 0.0
    if not 0 < found <= FASTEST:
        raise ParameterError(f"--speed {shortened(text)!r}", allowed="a factor above 0 like 1000x, up to 1000000x; max")
    return found


def read_seed(option: str, text: str) -> int:
    """A seed of an option. Raises ParameterError."""
    if not (text.isascii() and text.isdigit() and len(text) <= len(str(_SEEDS)) and int(text) < _SEEDS):
        raise ParameterError(f"{option} {shortened(text)!r}", allowed="a seed: a whole number from 0 to 2^64 - 1")
    return int(text)
