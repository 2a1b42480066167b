"""A loom at work that others see and command over OPC UA: `run` with a server beside it."""

import ipaddress
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from ilmek import __version__
from ilmek.errors import LoomError, ParameterError, restated
from ilmek.io.programme_file import open_programme
from ilmek.io.secret_file import alone_in, config_folder, read_bounded, write_secret
from ilmek.io.users_file import StoredUser, check_user_name, read_users, write_users
from ilmek.loom.control.view import ControllerView
from ilmek.loom.operations import LoomProgramme
from ilmek.records import value_record

if TYPE_CHECKING:
    from ilmek.drivers.opcua.certificate import Credentials
    from ilmek.drivers.opcua.model import LoomNameplate
    from ilmek.drivers.opcua.server import LoomServer
    from ilmek.drivers.opcua.users import LoomUser

RIGHTS = ("operator", "viewer")
"""What a user may do: read and command, or read."""

PORT = 4840
"""The port that OPC UA is registered for."""

_SERIAL = 12


@value_record
class ServeOrder:
    """Where a server listens, and for whom.

    users        file; default: users.toml in the folder of settings
    certificate  file, with `key`; default: made by itself and kept in the folder of settings
    anonymous    clients without a name may read
    """

    host: str = "127.0.0.1"
    port: int = PORT
    users: Path | None = None
    certificate: Path | None = None
    key: Path | None = None
    anonymous: bool = False

    @property
    def users_file(self) -> Path:
        """The file of the users."""
        return self.users or config_folder("opcua") / "users.toml"


def require_extra() -> None:
    """Raises LoomError where the extra `control` is missing."""
    if find_spec("asyncua") is None:
        raise LoomError("OPC UA needs asyncua, which is not installed", do='pip install "ilmek[control]"')


def add_user(path: Path, name: str, right: str, password: str) -> bool:
    """Write a user to the file, or a new password of one who is there; whether the user was there."""
    from ilmek.drivers.opcua.users import hashed

    check_user_name(name)
    users = read_users(path, RIGHTS) if path.exists() else {}
    there = name in users
    write_users(path, {**users, name: StoredUser(right, hashed(password))})
    return there


def checked_order(order: ServeOrder) -> ServeOrder:
    """The order, if a server may be opened for it. Raises ParameterError or LoomError otherwise."""
    if not 0 < order.port < 1 << 16:
        raise ParameterError(f"--port {order.port}", allowed="1 to 65535")
    if (order.certificate is None) != (order.key is None):
        raise ParameterError("one of --certificate and --key", do="give both, or neither")
    if not is_loopback(order.host) and order.certificate is None:
        raise ParameterError(
            f"--host {order.host} without a certificate",
            allowed="127.0.0.1; any other with --certificate and --key",
            do="give the certificate that the clients trust",
        )
    if not order.users_file.exists():
        raise LoomError(f"there is no users file {order.users_file}", do="ilmek serve --add-user NAME writes one")
    _users(order)
    return order


def _users(order: ServeOrder) -> "dict[str, LoomUser]":
    from ilmek.drivers.opcua.users import LoomUser, UserRight, parse_hash

    stored = read_users(order.users_file, RIGHTS)
    for name, one in stored.items():
        try:
            parse_hash(one.password)
        except ParameterError as error:
            raise LoomError(f"{order.users_file}, {name}: {error.given}", do=error.do) from None
    if not stored:
        raise LoomError(f"{order.users_file} has no users", do="ilmek serve --add-user NAME writes one")
    return {name: LoomUser(name, UserRight(one.right), one.password) for name, one in stored.items()}


def loom_server(
    view: ControllerView, programme: LoomProgramme, title: str, order: ServeOrder, log: Callable[[str], None]
) -> "LoomServer":
    """The server of a loom at work on a programme; it is not started.

    title  what people call the programme     order  one of `checked_order`
    """
    from ilmek.drivers.opcua.server import LoomServer
    from ilmek.drivers.opcua.users import UserList

    plate = nameplate(programme, title)
    credentials = _credentials(order, plate)
    known = UserList(_users(order), anonymous=order.anonymous)
    return LoomServer(view, plate, known, credentials, host=order.host, port=order.port, log=log)


def nodeset_text(programme: Path) -> str:
    """The address space of a loom with a programme as a NodeSet of OPC UA, for engineers who write clients."""
    from ilmek.drivers.opcua.export import exported_nodeset

    with open_programme(programme) as opened:
        return exported_nodeset(nameplate(opened, programme.name))


def nameplate(programme: LoomProgramme, title: str) -> "LoomNameplate":
    """What a server states about the loom: its serial number is the beginning of the loom's digest."""
    from ilmek.drivers.opcua.model import LoomNameplate

    setup = programme.setup
    return LoomNameplate(
        manufacturer="ilmek",
        model=f"automated carpet loom of {setup.heads} {'head' if setup.heads == 1 else 'heads'}",
        serial=setup.loom[:_SERIAL],
        software=__version__,
        programme=programme.digest,
        title=title,
        rows=setup.rows,
        columns=setup.columns,
        heads=setup.heads,
        tubes=setup.tubes,
        yarns=tuple(yarn.name for yarn in setup.yarns),
        bobbins=tuple(bobbin.yarn for bobbin in setup.wefts),
    )


def _credentials(order: ServeOrder, plate: "LoomNameplate") -> "Credentials":
    from ilmek.drivers.opcua.certificate import parse_credentials

    if order.certificate is not None and order.key is not None:
        key = read_bounded(order.key, "key")
        with restated(LoomError, f"{order.certificate}: ", of=LoomError):
            return parse_credentials(read_bounded(order.certificate, "certificate", secret=False), key, plate.uri)
    return kept_credentials(plate.serial, plate.uri, f"ilmek loom {plate.serial}")


def kept_credentials(name: str, uri: str, title: str) -> "Credentials":
    """A certificate of this computer, made once and kept in the folder of settings under a name."""
    from ilmek.drivers.opcua.certificate import (
        OtherApplicationError,
        credentials_pem,
        make_credentials,
        parse_credentials,
    )

    folder = config_folder("opcua")
    paths = folder / f"{name}-certificate.pem", folder / f"{name}-key.pem"
    with alone_in(folder):  # a host and a plant that begin at once have one certificate, with its key
        if all(path.exists() for path in paths):
            try:
                kept, private = (read_bounded(path, "certificate") for path in paths)
                return parse_credentials(kept, private, uri)
            except OtherApplicationError:
                pass  # of a loom whose serial number begins alike
        credentials = make_credentials(uri, title, ("127.0.0.1", "::1", "localhost"))
        for path, data in zip(paths, credentials_pem(credentials), strict=True):
            write_secret(path, data)
    return credentials


def is_loopback(host: str) -> bool:
    """Whether an address is this computer's alone."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
