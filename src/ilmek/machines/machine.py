"""What a machine is to everything above it: parameters, a design and a report."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ilmek.params import Params
from ilmek.report import Report
from ilmek.timing.cyclogram import Cyclogram


@dataclass(frozen=True, slots=True)
class Machine:
    """A machine of the catalogue.

    name     as typed on the command line: `beat-up`
    summary  one line for `ilmek machines`
    params   its declared parameters
    design   params -> the design (a frozen record of the machine's own)
    report   design -> Report
    cyclograms   design -> its cyclograms, with what must hold; None: a machine without
    """

    name: str
    summary: str
    params: type[Params]
    design: Callable[[Any], Any]
    report: Callable[[Any], Report]
    cyclograms: Callable[[Any], tuple[Cyclogram, ...]] | None = None
