"""`python -m kills.child CALL HANDLE ARGUMENTS...`: `python -m ilmek`, which waits in a call of the write protocol.

When the CALL-th call of a function of `ilmek.io.output.disk` begins, and when it has ended, a line is written to HANDLE
and the thread waits for `PAUSE`, so that a signal arrives just then. At the end the number of calls is written.
"""

import atexit
import importlib
import os
import runpy
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from power_cut import functions

PAUSE = 0.1
"""Pause before and after the call [s]; it delays the answer to the signal where the call belongs to a commit."""


def main() -> None:
    """Patch the calls, then be ilmek."""
    wanted, handle = int(sys.argv[1]), int(sys.argv[2])
    lock, number = threading.Lock(), [0]

    def wrap(function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **settings: Any) -> Any:
            with lock:
                number[0] += 1
                here = number[0] == wanted
            if here:
                os.write(handle, f"{function.__name__}\n".encode())
                time.sleep(PAUSE)
            value = function(*arguments, **settings)
            if here:
                time.sleep(PAUSE)
            return value

        return call

    disk = importlib.import_module("ilmek.io.output.disk")
    for name, function in functions(disk).items():
        setattr(disk, name, wrap(function))
    atexit.register(lambda: os.write(handle, f"{number[0]}\n".encode()))
    sys.argv[1:] = sys.argv[3:]
    runpy.run_module("ilmek", run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
