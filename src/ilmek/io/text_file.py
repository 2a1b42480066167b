"""Reading of text files of a user or of others: the file is checked before it is read."""

import os
import stat
from pathlib import Path

from ilmek.errors import IlmekError

_CONTROL = bytes({*range(32), 127} - {*b"\t\n\r"})
"""Control characters that no text file of ilmek needs."""


def read_text(path: Path, *, noun: str, largest: int, error: type[IlmekError], do: str) -> str:
    """The text of a UTF-8 file of at most `largest` bytes without control characters.

    noun  the expected kind of file, in messages
    do    remedy for a missing file
    Only a regular file is opened, and its size is that of the opened file. Raises `error`; the caller adds the file's
    name.
    """
    try:
        data = _bounded(path, noun, largest, error)
    except (FileNotFoundError, ValueError):  # ValueError: a null character in the path
        raise error("does not exist", do=do) from None
    except OSError as failed:
        raise error(f"cannot be read ({failed.strerror})") from None
    if not data.strip():
        raise error("is empty", do=f"give a {noun}")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as failed:
        raise error(f"line {_line(data, failed.start)} is not UTF-8 text", do="save the file as UTF-8") from None
    if len(data.translate(None, _CONTROL)) < len(data):
        at = next(index for index, byte in enumerate(data) if byte in _CONTROL)
        raise error(f"line {_line(data, at)} has the control character {data[at]:#04x}", do="remove it")
    return text


def _bounded(path: Path, noun: str, largest: int, error: type[IlmekError]) -> bytes:
    """The content of a regular file of at most `largest` bytes; OSError as the system."""
    _check_regular(path.stat(), noun, error)
    # Between the two checks the path may become a pipe, which would block without O_NONBLOCK.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    with os.fdopen(os.open(path, flags), "rb") as file:
        status = os.fstat(file.fileno())
        _check_regular(status, noun, error)
        data = file.read(largest + 1) if status.st_size <= largest else None
    if data is None or len(data) > largest:
        raise error(f"is too large for a {noun}", allowed=f"at most {largest // 1000} kB")
    return data


def _check_regular(status: os.stat_result, noun: str, error: type[IlmekError]) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise error("is a folder" if stat.S_ISDIR(status.st_mode) else "is not a file", do=f"give a {noun}")


def _line(data: bytes, at: int) -> int:
    return data.count(b"\n", 0, at) + 1
