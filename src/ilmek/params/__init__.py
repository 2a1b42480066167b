"""Declared parameters: one declaration drives validation, command-line options, forms and documentation.

    from ilmek.params import Params, kind

    @dataclass(frozen=True, slots=True)
    class BeatUpParams(Params):
        swing: float = kind.angle(30 * deg, above=0.0, below=180 * deg, doc="swing of the rocker", symbol="psi")
        crank: float | None = kind.length(None, above=0.0, doc="crank; default: synthesised")

Bounds are in SI. `above` and `below` exclude the bound, `at_least` and `at_most` include it. The kinds are read through
their module, because fields are often named like them (`length`, `speed`).
"""

from ilmek.params import kind
from ilmek.params.kind import nested, param
from ilmek.params.parameter import Parameter, Setting, Value
from ilmek.params.record import Overrides, Params, declared, listed, overridden, overrides, reachable

__all__ = [
    "Overrides",
    "Parameter",
    "Params",
    "Setting",
    "Value",
    "declared",
    "kind",
    "listed",
    "nested",
    "overridden",
    "overrides",
    "param",
    "reachable",
]
