"""`ilmek serve`: weave a programme on the simulated loom, seen and commanded over OPC UA."""

import threading
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.interrupts import before_end
from ilmek.cli.options import file_option, force_option, text_option
from ilmek.cli.password import typed_password
from ilmek.cli.plc_options import plc_address, plc_options
from ilmek.cli.running import run_options, work_shown
from ilmek.cli.settings import read_settings
from ilmek.cli.terminal import note
from ilmek.errors import ParameterError
from ilmek.io.users_file import check_user_name
from ilmek.jobs.plc.connection import PlcAddress
from ilmek.jobs.plc.line import feed
from ilmek.jobs.run.loom_run import LoomRun
from ilmek.jobs.run.order import RunOrder, read_run_order
from ilmek.jobs.serve import PORT, RIGHTS, ServeOrder, add_user, checked_order, loom_server, nodeset_text, require_extra

EXAMPLES = """\b
Examples:
  ilmek serve --add-user anna
  ilmek serve --add-user office --right viewer
  ilmek serve carpet/programme.ilmek --speed 100x
  ilmek serve carpet/programme.ilmek --port 4841 --start
  ilmek serve carpet/programme.ilmek --host 0.0.0.0 --certificate loom.pem --key loom-key.pem
  ilmek serve carpet/programme.ilmek --nodeset loom.xml
  ilmek serve carpet/programme.ilmek --plc opc.tcp://192.168.1.5:4840 --target twincat --user host --start

Limits: file 1,000 MB; users file, certificate and key 100 kB; 200 users; 32 job orders; 512 clients.
"""


@click.command(epilog=EXAMPLES)
@click.argument("programme", type=click.Path(path_type=Path), metavar="[PROGRAMME.ilmek]", required=False)
@click.option("--host", default="127.0.0.1", help="Address to listen at; default: 127.0.0.1, this computer alone.")
@click.option("--port", type=int, default=PORT, metavar="N", help=f"Port to listen at; default: {PORT}.")
@file_option("--users", "FILE", "File of the users; default: opcua/users.toml in the folder of ilmek's settings.")
@file_option("--certificate", "FILE", "The server's certificate, PEM or DER; default: one made by itself and kept.")
@click.option("--key", type=click.Path(path_type=Path), metavar="FILE", help="The key of --certificate.")
@click.option("--anonymous-read", is_flag=True, help="Clients without a name may read; default: nobody without one.")
@click.option("--plc", "plc_url", metavar="URL", help="Feed the PLC at opc.tcp://HOST:PORT instead; default: none.")
@plc_options
@click.option("--start", is_flag=True, help="Weave at once; default: wait for a job order or a command.")
@run_options
@text_option("--add-user", "NAME", "Write a user to the users file, and end; asks for the password.", "add_user_name")
@click.option(
    "--right", default="operator", type=click.Choice(RIGHTS), help="Of --add-user: command, or only read; operator."
)
@file_option("--nodeset", "FILE.xml", "Write the loom's address space as a NodeSet, and end.")
@force_option
def command(
    *,
    programme: Path | None,
    host: str,
    port: int,
    users: Path | None,
    certificate: Path | None,
    key: Path | None,
    anonymous_read: bool,
    start: bool,
    settings: tuple[str, ...],
    add_user_name: str | None,
    right: str,
    nodeset: Path | None,
    force: bool,
    plc_url: str | None,
    target: str,
    node: str | None,
    plc_user: str | None,
    plc_certificate: Path | None,
    unsecured: bool,
    **run_order: Any,
) -> int:
    """Weave PROGRAMME on the simulated loom as `ilmek run` does, with an OPC UA server beside it.

    Clients see the loom along OPC 40001-1 Machinery, give job orders by OPC 40001-3, and command it by the methods of
    OPC 30050 PackML. The channel is signed and encrypted, and a client gives a user's name and password. The loom waits
    for a job order; the server goes on after the carpet, until Ctrl-C.

    With --plc it is the host of a PLC with the program of `ilmek plc`: it gives the carpet and one row at a time, notes
    each row in the journal first, and ends with an error where program and journal differ.
    """
    order = ServeOrder(host, port, users, certificate, key, anonymous_read)
    if add_user_name is not None:
        _add_user(order, add_user_name, right)
        return 0
    if programme is None:
        raise ParameterError("no PROGRAMME.ilmek", do="give the file of a programme, or --add-user NAME")
    require_extra()
    if nodeset is not None:
        with call_outputs({"--nodeset": nodeset}, force=force, inputs={"PROGRAMME": programme}) as call:
            call.give("--nodeset", lambda: nodeset_text(programme))
        return 0
    run = read_run_order(programme, settings=read_settings(settings), **run_order)
    if plc_url is None:
        _serve(replace(run, start=start, serves=True), checked_order(order))
        return 0
    address = plc_address(
        plc_url, target=target, node=node, plc_user=plc_user, plc_certificate=plc_certificate, unsecured=unsecured
    )
    _feed(replace(run, start=start), address)
    return 0


def _feed(run_order: RunOrder, address: PlcAddress) -> None:
    stop = threading.Event()

    def stopped() -> str:
        stop.set()
        return f"the PLC gets no more rows; the same command goes on with {run_order.folder}"

    with before_end(stopped):
        feed(run_order, address, stop, note)
    note("the carpet is woven")


def _serve(run_order: RunOrder, order: ServeOrder) -> None:
    with ExitStack() as stack:
        run = stack.enter_context(LoomRun(run_order))
        server = loom_server(run, run.programme, run_order.programme.name, order, note)
        stack.enter_context(server)
        note(f"{server.url} serves {run_order.programme}; Ctrl-C ends it")
        work_shown(run, f"{server.url}; Ctrl-C ends")


def _add_user(order: ServeOrder, name: str, right: str) -> None:
    check_user_name(name)
    there = add_user(order.users_file, name, right, typed_password("no user was written"))
    note(f"{order.users_file} has {'a new password of' if there else 'the user'} {name}, {right}")
