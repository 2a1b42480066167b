"""`ilmek machines`: what can be designed, and with which parameters."""

import click

from ilmek.cli.options import json_option
from ilmek.cli.terminal import console, give_json, show_table
from ilmek.machines import MACHINES, find_machine
from ilmek.machines.machine import Machine
from ilmek.params import Parameter, declared
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
        if not give_json(json_to, {"machines": {machine.name: machine.summary for machine in MACHINES.values()}}):
            show_table(("machine", "what it is"), [(machine.name, machine.summary) for machine in MACHINES.values()])
        return
    machine = find_machine(name)
    if not give_json(json_to, as_json(machine)):
        console().print(f"{machine.name}: {machine.summary}")
        show_table(("parameter", "default", "unit", "allowed", "meaning"), [_row(p) for p in declared(machine.params)])


def as_json(machine: Machine) -> dict[str, object]:
    """A machine's parameters: default and bounds in SI, and the unit they are shown in."""
    names = ("name", "default", "unit", "above", "at_least", "below", "at_most", "choices", "doc", "symbol", "alias")
    parameters = [{name: getattr(parameter, name) for name in names} for parameter in declared(machine.params)]
    return {"machine": machine.name, "summary": machine.summary, "parameters": parameters}


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
