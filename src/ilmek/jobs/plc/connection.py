"""How a host or a simulated loom reaches the program of a PLC: address, names of its variables, security."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Protocol
from urllib.parse import urlsplit

from ilmek.errors import ParameterError, shortened
from ilmek.io.plc.targets import TARGETS
from ilmek.io.secret_file import read_bounded
from ilmek.jobs.plc.feeder import PlcValue
from ilmek.jobs.serve import is_loopback, kept_credentials, require_extra
from ilmek.records import value_record

if TYPE_CHECKING:
    from ilmek.drivers.opcua.plc_variables import PlcVariables

CLIENT = "urn:ilmek:plc-client"
"""URI of this application as a client."""


class Variables(Protocol):
    """The variables of a program by their names: of its block, or those that a program has for its signals."""

    def read(self, names: Iterable[str]) -> dict[str, PlcValue]:
        """Values by name."""

    def write(self, values: Mapping[str, PlcValue]) -> None:
        """Write values, in their order."""


@value_record
class PlcAddress:
    """A PLC's server.

    url          opc.tcp://host:port                      target  a name of `TARGETS`
    node         identifier of a variable's node, with {} for its name; None: as the target has it
    user         of the server, with `password`           certificate  file of the server's; None: the one that it shows
    unsecured    without signature and encryption
    """

    url: str
    target: str = "codesys"
    node: str | None = None
    user: str | None = None
    password: str = ""
    certificate: Path | None = None
    unsecured: bool = False

    def identifier(self, name: str) -> str:
        """The node of a variable of the program."""
        target = TARGETS[self.target]
        return (self.node or target.node).format(target.named(name))


def checked_address(address: PlcAddress) -> PlcAddress:
    """The address, if it can be one. Raises ParameterError."""
    parts = urlsplit(address.url)
    if parts.scheme != "opc.tcp" or not parts.hostname:
        raise ParameterError(f"--plc {shortened(address.url)!r}", allowed="opc.tcp://HOST:PORT")
    if address.node is None and not TARGETS[address.target].node:
        raise ParameterError(
            f"--target {address.target}, which has no OPC UA server of its own", do="give --node for the one it has"
        )
    if address.node is not None and (address.node.count("{}"), address.node.count("{")) != (1, 1):
        raise ParameterError(f"--node {shortened(address.node)!r}", allowed="an identifier with one {} for the name")
    if address.unsecured and address.user is not None and not is_loopback(parts.hostname):
        raise ParameterError("--user with --unsecured", do="leave --unsecured out: a password needs a secured channel")
    require_extra()
    return address


def connection(address: PlcAddress) -> "PlcVariables":
    """The variables at an address, not connected yet. Raises PlcUnreachableError."""
    from ilmek.drivers.opcua.certificate import parse_certificate
    from ilmek.drivers.opcua.plc_variables import PlcVariables

    given = address.certificate
    return PlcVariables(
        address.url,
        address.identifier,
        user=address.user,
        password=address.password,
        credentials=None if address.unsecured else kept_credentials("client", CLIENT, "ilmek as a client of a PLC"),
        server=None if given is None else parse_certificate(read_bounded(given, "certificate", secret=False)),
    )
