"""Options of the commands that make a carpet."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import click

from ilmek.cli.call_outputs import STANDARD
from ilmek.cli.options import file_option, text_option
from ilmek.jobs.order import GROUPS, QUALITY, SIZE, CarpetOrder
from ilmek.params import Parameter, declared
from ilmek.units import format_quantity

F = TypeVar("F", bound=Callable[..., Any])

SIZES = "a standard size (seccade, kelle, ...), width x length, like 120x180cm, 120cmxauto, or auto"
QUALITIES = "knots across x knots along, like 25x25/dm; also 40raj, 130kpsi, 62500/m2, 9/60 (India), 90line (China)"


LISTS = ("keep", "never", "mapped")
"""Parameters that are lists, whose options may be given again."""


def carpet_options(command: F) -> F:
    """Options of a carpet: picture, size, quality, knot, yarns, output, and the parameters of the order's groups."""
    for option in reversed((*_CARPET, *_of_the_groups(), *_OUTPUT)):
        command = option(command)
    return command


def carpet_inputs(order: CarpetOrder) -> dict[str, Path | None]:
    """The files that a carpet is read from, by name in messages."""
    return {**order.inputs}


def recipe_folder(save_recipe: str | None) -> Path:
    """The folder of the recipe that is written, of which it names its files: of standard output the current one."""
    return Path() if save_recipe in (None, STANDARD) else Path(str(save_recipe)).parent


def _of_the_groups() -> Iterator[Callable[[F], F]]:
    """One option for each parameter of `jobs.order.GROUPS`, with the declared meaning as help."""
    return (_option(parameter) for group in GROUPS.values() for parameter in declared(group))


def _option(parameter: Parameter) -> Callable[[F], F]:
    """The option of a parameter; its text is read and checked with the order."""
    name = (parameter.alias or parameter.name).replace("_", "-")
    meaning = f"{parameter.doc[0].upper()}{parameter.doc[1:]}"
    if parameter.name in LISTS:
        joined = "Several by semicolons, or the option again"
        return click.option(
            f"--{name}", parameter.name, multiple=True, callback=_one_text, metavar="TEXT", help=f"{meaning}. {joined}."
        )
    if parameter.kind is bool:
        return click.option(f"--{name}/--no-{name}", parameter.name, default=None, help=f"{meaning}.")
    default = "" if parameter.default is None else f"; default: {_shown(parameter)}"
    return click.option(f"--{name}", parameter.name, metavar=_metavar(parameter), help=f"{meaning}{default}.")


def _one_text(_context: click.Context, _option: click.Parameter, given: tuple[str, ...]) -> str | None:
    return "; ".join(given) or None


def _shown(parameter: Parameter) -> str:
    value = parameter.default
    return format_quantity(value, parameter.unit) if isinstance(value, int | float) else str(value)


def _metavar(parameter: Parameter) -> str:
    if parameter.choices:
        return "|".join((*(() if parameter.kind is str else ("N",)), *parameter.choices))
    return {"mm": "LENGTH", "cm": "LENGTH", "%": "SHARE", "deg": "ANGLE", "kg": "MASS", "g": "MASS"}.get(
        parameter.unit, "TEXT" if parameter.kind is str else "N"
    )


_CARPET = (
    click.argument("picture", type=click.Path(path_type=Path)),
    text_option(
        "--size",
        "SIZE",
        f"Carpet size: {SIZES}; default: that of a chart or a drawing made knot by knot, else auto: the shape of "
        f"the picture at the area of {SIZE}.",
    ),
    text_option(
        "--quality",
        "QUALITY",
        f"Knot density: {QUALITIES}; default: that of a chart or a drawing made knot by knot, {QUALITY}.",
    ),
    click.option("--knot", metavar="KNOT", help="symmetric or asymmetric; default: that of a chart, symmetric."),
    file_option(
        "--yarns",
        "FILE",
        "Yarn list: TOML, CSV or a GIMP palette (.gpl); wool: the sixteen wools of ilmek; default: that of a "
        "chart, the picture's own shades, dyed to order where no wool is near.",
        "yarn_file",
    ),
)
_OUTPUT = (
    click.option(
        "--pdf/--no-pdf",
        default=None,
        help="Write chart.pdf, or no chart.pdf and rows.pdf; default: those of at most 400 sheets.",
    ),
    text_option(
        "--save-recipe", "FILE", "Write the carpet as a recipe, with all that was set or decided; - prints it."
    ),
    file_option("--out", "DIR", "Output folder; on an error nothing is written."),
)
