"""Options of the commands that reach a PLC over OPC UA."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from ilmek.cli.options import file_option, text_option
from ilmek.cli.password import typed_password
from ilmek.io.plc.targets import TARGETS
from ilmek.jobs.plc.connection import PlcAddress

F = TypeVar("F", bound=Callable[..., Any])

_OPTIONS = (
    click.option(
        "--target",
        type=click.Choice([name for name, target in TARGETS.items() if target.node]),
        default="codesys",
        help="Controller, for the names of its variables; default: codesys.",
    ),
    text_option(
        "--node", "TEXT", "Node of a variable with {} for its name, like ns=4;s=Main.{}; default: by --target."
    ),
    text_option("--user", "NAME", "User of the PLC's server; asks for the password.", "plc_user"),
    file_option("--plc-certificate", "FILE", "The PLC's certificate; default: the one that its server shows."),
    click.option("--unsecured", is_flag=True, help="Without signature and encryption; default: Basic256Sha256."),
)


def plc_options(command: F) -> F:
    """How a PLC is reached: names of its variables, user, security."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def plc_address(
    url: str,
    *,
    target: str,
    node: str | None,
    plc_user: str | None,
    plc_certificate: Path | None,
    unsecured: bool,
) -> PlcAddress:
    """The address from the options."""
    password = "" if plc_user is None else typed_password("nothing was done")
    return PlcAddress(url, target, node, plc_user, password, plc_certificate, unsecured)
