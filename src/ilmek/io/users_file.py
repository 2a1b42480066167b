"""The users of an OPC UA server as TOML, with salted hashes of their passwords; only its owner reads it.

[anna]
right = "operator"                          # or viewer
password = "scrypt$32768$8$1$...$..."       # written by ilmek serve --add-user anna
"""

from pathlib import Path

from ilmek.errors import LoomError, ParameterError, restated, shortened
from ilmek.io.data_text import parse_data
from ilmek.io.file_entry import FileEntry
from ilmek.io.schema import SourceText
from ilmek.io.secret_file import read_bounded, write_secret
from ilmek.io.toml_text import toml_text
from ilmek.records import value_record

MOST_USERS = 200
"""Largest number of users."""

LONGEST_USER = 60
"""Largest length of a user's name."""


@value_record
class StoredUser:
    """An entry of the file."""

    right: str
    password: str


def read_users(path: Path, rights: tuple[str, ...]) -> dict[str, StoredUser]:
    """The users by name. Raises LoomError, for an error in the text with the line."""
    data = read_bounded(path, "users")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        raise LoomError(f"the users file {path} is not UTF-8 text", do="write it with ilmek serve --add-user") from None
    found = parse_data(text, name=str(path), toml=True, error=LoomError)
    source = SourceText(str(path), found.lines)
    users: dict[str, StoredUser] = {}
    with restated(LoomError):
        for name, entry in FileEntry(found.data, (), source).entries():
            with entry.located():
                check_user_name(name)
            entry.keys("right", "password", needs=("right", "password"))
            values = {key: entry.data[key] for key in ("right", "password")}
            if values["right"] not in rights:
                entry.refuse(
                    ParameterError(f"right {shortened(repr(values['right']))}", allowed=", ".join(rights)), "right"
                )
            if not isinstance(values["password"], str):
                entry.refuse(
                    ParameterError("the password is not a hash", do="write it with ilmek serve --add-user"), "password"
                )
            users[name] = StoredUser(**values)
    if len(users) > MOST_USERS:
        raise LoomError(f"{path} has {len(users)} users", allowed=f"at most {MOST_USERS}")
    return users


def write_users(path: Path, users: dict[str, StoredUser]) -> None:
    """Write the users. Raises OutputError."""
    if len(users) > MOST_USERS:
        raise LoomError(f"{len(users)} users", allowed=f"at most {MOST_USERS}")
    tables = {name: {"right": user.right, "password": user.password} for name, user in users.items()}
    write_secret(path, toml_text(tables).encode())


def check_user_name(name: str) -> None:
    """Raises ParameterError for a name that no user can have."""
    if not 0 < len(name) <= LONGEST_USER or not name.isprintable() or name != name.strip():
        raise ParameterError(f"user name {shortened(name)!r}", allowed=f"1 to {LONGEST_USER} printable characters")
