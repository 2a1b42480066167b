"""Messages that a C library writes to the error stream, caught instead of shown."""

import contextlib
import os
import sys
import threading
from collections.abc import Iterator

_LOCK = threading.Lock()


@contextlib.contextmanager
def native_messages() -> Iterator[list[str]]:
    """The lines that are written to file descriptor 2 inside the block, in the list when the block ends.

    At most a pipe's capacity is kept; the rest is lost, and nobody waits. The descriptor is that of the whole process:
    the block should contain the call of the library only. Without an error stream nothing is caught.
    """
    messages: list[str] = []
    with _LOCK, contextlib.ExitStack() as after:
        try:
            kept = os.dup(2)
        except OSError:
            yield messages
            return
        after.callback(os.close, kept)
        if sys.stderr is not None:
            sys.stderr.flush()
        reading, writing = os.pipe()
        after.callback(os.close, reading)
        os.set_blocking(reading, False)
        os.set_blocking(writing, False)
        os.dup2(writing, 2, inheritable=True)
        os.close(writing)
        try:
            yield messages
        finally:
            os.dup2(kept, 2, inheritable=True)
            with contextlib.suppress(BlockingIOError):
                messages += os.read(reading, 1 << 16).decode(errors="replace").splitlines()
