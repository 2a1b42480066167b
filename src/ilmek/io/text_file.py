"""Reading of text files."""

from pathlib import Path

from ilmek.errors import IlmekError


def read_text(path: Path, *, noun: str, largest: int, error: type[IlmekError], do: str) -> str:
    """The text of a UTF-8 file of at most `largest` bytes.

    noun  the expected kind of file, in messages
    do    remedy for a missing file
    Raises `error`; the caller adds the file's name.
    """
    if path.is_dir():
        raise error("is a folder", do=f"give a {noun}")
    if not path.exists():
        raise error("does not exist", do=do)
    if not path.is_file():
        raise error("is not a file", do=f"give a {noun}")
    try:
        data = path.read_bytes() if path.stat().st_size <= largest else None
    except OSError as failed:
        raise error(f"cannot be read ({failed.strerror})") from None
    if data is None:
        raise error(f"is too large for a {noun}", allowed=f"at most {largest // 1000} kB")
    if not data.strip():
        raise error("is empty", do=f"give a {noun}")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as failed:
        line = data.count(b"\n", 0, failed.start) + 1
        raise error(f"line {line} is not UTF-8 text", do="save the file as UTF-8") from None
