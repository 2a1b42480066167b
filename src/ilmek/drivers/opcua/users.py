"""Users of the server: roles, and passwords kept as salted scrypt hashes (RFC 7914)."""

import hashlib
import hmac
import secrets
import threading
import time
from base64 import b64decode, b64encode
from collections.abc import Mapping
from enum import StrEnum

from ilmek.errors import ParameterError, shortened
from ilmek.records import value_record
from ilmek.units import counted

COST, BLOCK, PARALLEL = 1 << 15, 8, 1
"""Parameters of scrypt: 32 MiB and about 0.1 s for a password."""

SHORTEST, LONGEST = 8, 256
"""Least and largest length of a password."""

_SALT, _HASH = 16, 32
_MEMORY = 64 << 20

TRIES, PAUSE = 5, 60.0
"""Wrong passwords from an address before all of its are refused, and for how long [s]."""


class UserRight(StrEnum):
    """What a user may do: an operator reads and gives commands, a viewer reads."""

    OPERATOR = "operator"
    VIEWER = "viewer"


@value_record
class LoomUser:
    """A user: name, right, and the password's hash as `hashed` writes it."""

    name: str
    right: UserRight
    password: str


def hashed(password: str, salt: bytes | None = None) -> str:
    """The salted hash of a password: scrypt$cost$block$parallel$salt$hash. Raises ParameterError for its length."""
    if not SHORTEST <= len(password) <= LONGEST:
        raise ParameterError(
            f"a password of {counted(len(password), 'character')}", allowed=f"{SHORTEST} to {LONGEST} characters"
        )
    salt = secrets.token_bytes(_SALT) if salt is None else salt
    found = _scrypt(password, salt, COST, BLOCK, PARALLEL)
    return "$".join(
        ["scrypt", f"{COST}", f"{BLOCK}", f"{PARALLEL}", b64encode(salt).decode(), b64encode(found).decode()]
    )


def matches(password: str, stored: str) -> bool:
    """Whether a password is the one of a stored hash. Raises ParameterError for a hash that is not one of `hashed`."""
    salt, found = parse_hash(stored)
    return len(password) <= LONGEST and hmac.compare_digest(_scrypt(password, salt, COST, BLOCK, PARALLEL), found)


def parse_hash(stored: str) -> tuple[bytes, bytes]:
    """Salt and hash of a stored hash. Raises ParameterError for another form."""
    parts = stored.split("$")
    try:
        salt, found = (b64decode(part, validate=True) for part in parts[4:])
    except ValueError:
        salt = found = b""
    if parts[:4] != ["scrypt", f"{COST}", f"{BLOCK}", f"{PARALLEL}"] or (len(salt), len(found)) != (_SALT, _HASH):
        raise ParameterError(
            f"the password's hash {shortened(stored, 20)!r} is not one of ilmek",
            do="write the user again with ilmek serve --add-user",
        )
    return salt, found


def _scrypt(password: str, salt: bytes, cost: int, block: int, parallel: int) -> bytes:
    data = password.encode("utf-8", "replace")
    return hashlib.scrypt(data, salt=salt, n=cost, r=block, p=parallel, maxmem=_MEMORY, dklen=_HASH)


class UserList:
    """The users of a server. Passwords are tried slowly: a name that does not exist takes as long as one that does.

    anonymous  whether clients without a name may read
    """

    def __init__(self, users: Mapping[str, LoomUser], *, anonymous: bool = False) -> None:
        self.anonymous = anonymous
        self._users = dict(users)
        self._other = hashed(secrets.token_hex(_SALT))
        self._failures: dict[str, tuple[int, float]] = {}
        self._key = secrets.token_bytes(_HASH)
        self._known: dict[str, bytes] = {}
        self._lock = threading.Lock()

    def admitted(self, address: str, name: str | None, password: str | None) -> UserRight | None:
        """The right of a user who gives a name and a password, from an address; None: refused."""
        if name is None or password is None:
            return UserRight.VIEWER if self.anonymous else None
        with self._lock:
            return self._right(address, name, password)

    def _right(self, address: str, name: str, password: str) -> UserRight | None:
        seal = hmac.digest(self._key, f"{len(name)}:{name}{password}".encode("utf-8", "replace"), "sha256")
        user = self._users.get(name)
        if user is not None and hmac.compare_digest(self._known.get(name, b""), seal):
            return user.right  # once found right, a password is not hashed again while the server runs
        count, since = self._failures.get(address, (0, 0.0))
        if time.monotonic() - since > PAUSE:
            count = 0
        if count >= TRIES:
            return None
        if matches(password, self._other if user is None else user.password) and user is not None:
            self._known[name] = seal
            self._failures.pop(address, None)
            return user.right
        if len(self._failures) > 1000:
            self._failures.clear()
        self._failures[address] = count + 1, time.monotonic()
        return None
