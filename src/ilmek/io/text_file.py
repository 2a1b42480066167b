"""Reading of text files of a user or of others: the file is checked before it is read."""

import errno
from pathlib import Path

from ilmek.errors import IlmekError
from ilmek.io.regular_file import open_regular

_CONTROL = bytes({*range(32), 127} - {*b"\t\n\r"})
"""Control characters that no text file of ilmek needs."""


def read_text(
    path: Path, *, noun: str, largest: int, error: type[IlmekError], do: str, encoding: str = "utf-8-sig"
) -> str:
    """The text of a file of at most `largest` bytes without control characters, in UTF-8 if no encoding is given.

    noun  the expected kind of file, in messages
    do    remedy for a missing file
    Only a regular file is opened, and its size is that of the opened file. Raises `error`; the caller adds the file's
    name.
    """
    try:
        data = _bounded(path, noun, largest, error)
    except FileNotFoundError:
        raise error("does not exist", do=do) from None
    except IsADirectoryError:
        raise error("is a folder", do=f"give a {noun}") from None
    except OSError as failed:
        if failed.errno == errno.EINVAL:
            raise error("is not a file", do=f"give a {noun}") from None
        raise error(f"cannot be read ({failed.strerror})") from None
    if not data.strip():
        raise error("is empty", do=f"give a {noun}")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as failed:
        raise error(f"line {_line(data, failed.start)} is not UTF-8 text", do="save the file as UTF-8") from None
    if len(data.translate(None, _CONTROL)) < len(data):
        at = next(index for index, byte in enumerate(data) if byte in _CONTROL)
        raise error(f"line {_line(data, at)} has the control character {data[at]:#04x}", do="remove it")
    return text


def _bounded(path: Path, noun: str, largest: int, error: type[IlmekError]) -> bytes:
    """The content of a regular file of at most `largest` bytes; OSError as the system."""
    file, size = open_regular(path)
    with file:
        data = file.read(largest + 1) if size <= largest else None
    if data is None or len(data) > largest:
        raise error(f"is too large for a {noun}", allowed=f"at most {largest // 1000} kB")
    return data


def _line(data: bytes, at: int) -> int:
    return data.count(b"\n", 0, at) + 1
