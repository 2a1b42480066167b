"""The woven carpet of a simulated loom as a file that is mapped to memory: it survives the end of the process.

      0   8  ILMEKWOV       8  4  version     12  4  0x01020304 in the machine's order of bytes
     16  16  rows, columns, heads, tubes      32  32  digest of the programme
     64   8  size of the file [bytes]         72  32  SHA-256 of the bytes before it      104  24  zeros
    128      `loom.twin.woven`

The operating system keeps what is written to the memory even if the process is killed. A power cut ends the simulated
carpet as well as the simulation: the file is synced when it is made and when it is closed, not with every knot.
"""

import hashlib
import io
import mmap
import os
import struct
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ilmek.errors import LoomError, OutputError
from ilmek.io.output import disk
from ilmek.io.regular_file import open_regular
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.model import plant_model
from ilmek.loom.twin.state import first_state
from ilmek.loom.twin.woven import Woven, woven_size

MAGIC, VERSION = b"ILMEKWOV", 1

_HEADER = struct.Struct("=8sII4I32sQ")
_ORDER = 0x01020304
_START = 128
_NEW = "remove it to begin another carpet"


@contextmanager
def open_woven(path: Path, programme: LoomProgramme, *, change: bool = True) -> Iterator[Woven]:
    """The woven carpet of a programme, made if there is none; it is mapped while the context is open.

    change  False: it is only read, and must exist
    Raises LoomError for a file of another programme, damaged or no woven carpet; OutputError if it cannot be made.
    """
    if change and not path.exists():
        _make(path, programme)
    try:
        with _opened(path, change) as file:
            _check(path, file.read(_START), os.fstat(file.fileno()).st_size, programme)
            access = mmap.ACCESS_WRITE if change else mmap.ACCESS_READ
            memory = mmap.mmap(file.fileno(), 0, access=access)
    except OSError as error:
        raise LoomError(f"{path} cannot be opened ({error.strerror})", do="check the path") from error
    view = memoryview(memory)
    woven = Woven(programme.setup, view[_START:])
    try:
        _check_state(path, woven, programme)
        yield woven
    finally:
        woven.release()
        view.release()
        with suppress(OSError, ValueError):
            if change:
                memory.flush()
        with suppress(BufferError):  # an array of a row that the caller still has
            memory.close()


def _opened(path: Path, change: bool) -> io.BufferedIOBase:
    file, _ = open_regular(path, follow=False)
    if not change:
        return file
    file.close()
    return path.open("r+b")


def _header(programme: LoomProgramme) -> bytes:
    setup = programme.setup
    sizes = (setup.rows, setup.columns, setup.heads, setup.tubes)
    size = _START + woven_size(setup)
    found = _HEADER.pack(MAGIC, VERSION, _ORDER, *sizes, bytes.fromhex(programme.digest), size)
    return (found + hashlib.sha256(found).digest()).ljust(_START, b"\0")


def _make(path: Path, programme: LoomProgramme) -> None:
    """A new file, whole under its name or not at all, of blocks that are reserved: the disc cannot be full later."""
    memory = bytearray(woven_size(programme.setup))
    woven = Woven(programme.setup, memory)
    woven.keep(first_state(plant_model(programme.setup)))
    woven.release()
    part = path.with_name(f".{path.name}.part")
    try:
        with suppress(FileNotFoundError):
            disk.unlink(part)
        disk.write(part, _header(programme) + bytes(memory))
        disk.sync(part, 0o600)
        disk.rename(part, path)
        disk.sync(path.parent)
    except OSError as error:
        with suppress(OSError):
            disk.unlink(part)
        raise OutputError(
            f"{path} cannot be written ({error.strerror})", do="make room, or choose another folder"
        ) from error


def _check(path: Path, head: bytes, size: int, programme: LoomProgramme) -> None:
    """Raise LoomError unless the header is that of a woven carpet of this programme."""
    expected = _header(programme)
    if len(head) < _START or head[:8] != MAGIC:
        raise LoomError(f"{path} is no woven carpet", allowed="the file `woven` in a journal's folder", do=_NEW)
    fixed = _HEADER.size
    if hashlib.sha256(head[:fixed]).digest() != head[fixed : fixed + 32]:
        raise LoomError(f"{path} is damaged (its header)", allowed="a whole file", do=_NEW)
    version, order = struct.unpack_from("=II", head, 8)
    if version != VERSION or order != _ORDER:
        other = f"{path} has format {version}" if order == _ORDER else f"{path} is of another kind of computer"
        raise LoomError(other, allowed=f"format {VERSION} of this one", do=_NEW)
    if head != expected:
        raise LoomError(f"{path} is the carpet of another programme", do="give another --journal, or --new")
    if size != _START + woven_size(programme.setup):
        raise LoomError(f"{path} has {size} bytes", allowed=f"{_START + woven_size(programme.setup)} bytes", do=_NEW)


def _check_state(path: Path, woven: Woven, programme: LoomProgramme) -> None:
    try:
        woven.restored(plant_model(programme.setup))
    except LoomError as error:
        raise LoomError(f"{path} is damaged ({error})", allowed="a whole file", do=_NEW) from error
