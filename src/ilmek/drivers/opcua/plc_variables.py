"""Variables of a PLC's program over OPC UA, as a client of the PLC's own server: OPC 30000, controllers as IEC 61131-3.

Channels are signed and encrypted by Basic256Sha256, or not secured at all where the caller says so. Each variable is
written in the type in which the server has it.
"""

import concurrent.futures
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from types import TracebackType
from typing import Any

from asyncua import ua
from asyncua.crypto.security_policies import SecurityPolicyBasic256Sha256
from asyncua.crypto.uacrypto import CertProperties
from asyncua.sync import Client
from cryptography import x509
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat

from ilmek.drivers.opcua.certificate import Credentials
from ilmek.errors import LoomError
from ilmek.records import JsonObject

TIMEOUT = 4.0
"""Time in which the PLC's server must answer [s]."""

_FAILURES = (OSError, TimeoutError, concurrent.futures.TimeoutError, concurrent.futures.CancelledError, ua.UaError)


class PlcUnreachableError(LoomError):
    """The PLC's server does not answer, or refuses."""


class PlcVariables:
    """The variables of a program, connected while the context lasts.

    url          of the PLC's server, opc.tcp://...       node  identifier of the node of a variable
    credentials  of this client; None: no security        server  certificate of the server; None: the one that it shows
    Raises PlcUnreachableError.
    """

    def __init__(
        self,
        url: str,
        node: Callable[[str], str],
        *,
        user: str | None = None,
        password: str = "",
        credentials: Credentials | None = None,
        server: x509.Certificate | None = None,
    ) -> None:
        self._url, self._node = url, node
        self._kinds: dict[str, ua.VariantType] = {}
        self._client: Any = Client(url, TIMEOUT)
        with self._answers("cannot be reached"):
            if user is not None:
                self._client.set_user(user)
                self._client.set_password(password)
            if credentials is not None:
                self._secure(credentials, server)

    def _secure(self, own: Credentials, server: x509.Certificate | None) -> None:
        self._client.application_uri = own.uri
        key = own.key.private_bytes(Encoding.DER, PrivateFormat.PKCS8, NoEncryption())
        self._client.set_security(
            SecurityPolicyBasic256Sha256,
            CertProperties(own.certificate.public_bytes(Encoding.DER), "DER"),
            CertProperties(key, "DER"),
            server_certificate=None if server is None else CertProperties(server.public_bytes(Encoding.DER), "DER"),
        )

    def read(self, names: Iterable[str]) -> JsonObject:
        """Values of variables by their names. Raises PlcUnreachableError."""
        return {name: data.Value.Value for name, data in self._data(tuple(names)).items()}

    def write(self, values: Mapping[str, Any]) -> None:
        """Write variables, in their order, in one call. Raises PlcUnreachableError."""
        unknown = tuple(name for name in values if name not in self._kinds)
        for name, data in self._data(unknown).items() if unknown else ():
            self._kinds[name] = data.Value.VariantType
        with self._answers("does not take a value"):
            self._client.write_values(
                [self._client.get_node(self._node(name)) for name in values],
                [ua.DataValue(ua.Variant(value, self._kinds[name])) for name, value in values.items()],
            )

    def _data(self, names: tuple[str, ...]) -> JsonObject:
        with self._answers("does not answer"):
            found = self._client.read_attributes([self._client.get_node(self._node(name)) for name in names])
        for name, data in zip(names, found, strict=True):
            if data.Value is None or not data.StatusCode.is_good():
                raise PlcUnreachableError(
                    f"{self._url} has no variable {self._node(name)}",
                    do="release the variables of the program for OPC UA, or give --node",
                )
        return dict(zip(names, found, strict=True))

    @contextmanager
    def _answers(self, what: str) -> Iterator[None]:
        try:
            yield
        except _FAILURES as failed:
            reason = str(failed) or type(failed).__name__
            raise PlcUnreachableError(f"the PLC at {self._url} {what} ({reason})") from None

    def __enter__(self) -> "PlcVariables":
        with self._answers("cannot be reached"):
            self._client.connect()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(*_FAILURES):  # the connection is gone
            self._client.disconnect()
