"""`ilmek machines`: list the machines and their parameters."""

import click

from ilmek.cli.options import json_option
from ilmek.cli.terminal import give_json, say, show_table
from ilmek.jobs.machines import machine_form, machine_list
from ilmek.params import Parameter
from ilmek.units import format_quantity

EXAMPLES = """\b
Examples:
  ilmek machines
  ilmek machines beat-up
  ilmek machines beat-up --json -
"""


@click.command(epilog=EXAMPLES)
@click.argument("name", required=False, metavar="[MACHINE]")
@json_option
def command(name: str | None, json_to: str | None) -> None:
    """List the machines, or the parameters of MACHINE: name, default, unit, bounds, meaning."""
    if name is None:
        machines = machine_list()
        if not give_json(json_to, {"machines": machines}):
            show_table(("machine", "description"), list(machines.items()))
        return
    form = machine_form(name)
    if not give_json(json_to, form.as_json()):
        say(f"{form.machine}: {form.summary}")
        show_table(("parameter", "default", "unit", "allowed", "meaning"), [_row(p) for p in form.parameters])
        if form.machines:
            say(f"also every parameter of {', '.join(form.machines)}, as {form.machines[0]}.NAME=VALUE")


def _row(parameter: Parameter) -> tuple[str, str, str, str, str]:
    allowed = parameter.allowed().removeprefix("allowed: ")
    name = f"{parameter.name} ({parameter.alias})" if parameter.alias else parameter.name
    return name, _default(parameter), parameter.unit, allowed, parameter.doc


def _default(parameter: Parameter) -> str:
    value = parameter.default
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else format_quantity(value, parameter.unit, digits=6)
