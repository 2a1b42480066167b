"""`ilmek machines`: list the machines and their parameters."""

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.terminal import say, show_table
from ilmek.jobs.machines import machine_form, machine_list
from ilmek.params import Parameter
from ilmek.sentences import Name, Sentence
from ilmek.units import format_quantity

EXAMPLES = """\b
Examples:
  ilmek machines
  ilmek machines beat-up
  ilmek machines beat-up --json -
"""


@click.command(epilog=EXAMPLES)
@click.argument("name", required=False, metavar="[MACHINE]")
@force_option
@json_option
def command(name: str | None, force: bool, json_to: str | None) -> None:
    """List the machines, or the parameters of MACHINE: name, default, unit, bounds, meaning."""
    machines = machine_list()
    form = None if name is None else machine_form(name)
    with call_outputs({"--json": json_to}, force=force) as call:
        call.give_json(lambda: {"machines": machines} if form is None else form.as_json())
    if call.quiet:
        return
    if form is None:
        show_table(("machine", "description"), list(machines.items()), words=(1,))
    else:
        say(Sentence("at", where=Name(form.machine), text=form.summary))
        headings = ("parameter", "default", "unit", "allowed", "meaning")
        show_table(headings, [_row(p) for p in form.parameters], wide=(0,), words=(3, 4))
        if form.machines:
            say(Sentence("terminal.also-of", machines=Name(", ".join(form.machines)), first=Name(form.machines[0])))


def _row(parameter: Parameter) -> tuple[str, str, str, str, str]:
    name = f"{parameter.name} ({parameter.alias})" if parameter.alias else parameter.name
    return name, _default(parameter), parameter.unit, parameter.bounds(), parameter.doc


def _default(parameter: Parameter) -> str:
    value = parameter.default
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else format_quantity(value, parameter.unit, digits=6)
