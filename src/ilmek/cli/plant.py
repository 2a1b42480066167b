"""`ilmek plant`: a simulated loom for a PLC."""

import threading
from pathlib import Path
from typing import Any

import click

from ilmek.cli.interrupts import before_end
from ilmek.cli.options import file_option, stops_option, text_option
from ilmek.cli.plc_options import plc_address, plc_options
from ilmek.cli.settings import read_settings
from ilmek.cli.terminal import note, show_pairs
from ilmek.cli.verdict import CHECK_FAILS
from ilmek.jobs.plc.line import weave_for_plc
from ilmek.jobs.plc.plant import hostile_drives
from ilmek.jobs.run.order import read_run_order, read_seed

EXAMPLES = """\b
Examples:
  ilmek plant carpet/programme.ilmek --plc opc.tcp://192.168.1.5:4840 --target twincat
  ilmek plant carpet/programme.ilmek --plc opc.tcp://127.0.0.1:4840 --unsecured --drives 7

Limits: file 1,000 MB.
"""


@click.command(epilog=EXAMPLES)
@click.argument("programme", type=click.Path(path_type=Path), metavar="PROGRAMME.ilmek")
@click.option("--plc", "url", required=True, metavar="URL", help="OPC UA server of the PLC: opc.tcp://HOST:PORT.")
@plc_options
@file_option("--carpet", "FILE", "The carpet that is woven; default: NAME.woven beside PROGRAMME.")
@text_option("--drives", "SEED", "One order in eight a drive is silent, early, stuck or lies; default: none.")
@text_option("--faults", "SEED", "Simulate breaks of yarn, weft and warp as `ilmek run` does; default: none.")
@stops_option
@click.option("--set", "settings", multiple=True, metavar="NAME=VALUE", help="Set a rate of --faults.")
def command(
    *,
    programme: Path,
    url: str,
    carpet: Path | None,
    drives: str | None,
    faults: str | None,
    stops: Path | None,
    settings: tuple[str, ...],
    **address: Any,
) -> int:
    """Be the loom of a PLC that weaves PROGRAMME: heads, drives, sensors and the operator who repairs.

    The loom is that of `ilmek run`, at its own speed. It reads the orders of the program that `ilmek plc` has written
    and writes its inputs, which no field bus may write as well. `ilmek serve --plc` feeds the rows.

    Exit code 0: the carpet is complete and equal to the chart; 3: a knot is wrong, or it was ended before.
    """
    order = read_run_order(programme, "1x", None, faults=faults, stops=stops, settings=read_settings(settings))
    act_of = hostile_drives(None if drives is None else read_seed("--drives", drives))
    stop, kept = threading.Event(), carpet or programme.with_suffix(".woven")
    with before_end(lambda: _stopped(stop, kept)):
        woven = weave_for_plc(order, kept, plc_address(url, **address), stop, note, act_of=act_of)
    show_pairs(
        [
            ("carpet", f"{woven.knots:,} of {woven.total:,} knots"),
            ("against the chart", f"{woven.missing} missing, {woven.double} double, {woven.wrong} of another yarn"),
        ]
    )
    return 0 if woven.complete else CHECK_FAILS


def _stopped(stop: threading.Event, carpet: Path) -> str:
    stop.set()
    return f"the carpet is in {carpet}; the same command goes on"
