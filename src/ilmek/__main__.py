"""`python -m ilmek` is `ilmek`."""

import gc
import importlib
import os
import signal
from types import FrameType

_SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]


def run() -> None:
    """Run the command line as a program: a signal ends it with one line, also while it starts and ends."""
    # The matrices are small: threads of BLAS wait for each other longer than they work. numpy is not imported yet.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    gc.set_threshold(50_000, 20, 50)  # a command ends soon: what its modules hold is not looked through again and again
    usual = (signal.SIG_DFL, signal.default_int_handler)
    numbers = [number for number in _SIGNALS if signal.getsignal(number) in usual]
    for number in numbers:
        signal.signal(number, _end)
    try:
        cli = importlib.import_module("ilmek.cli")  # after the signals
        importlib.import_module("ilmek.cli.interrupts").handle(numbers)
        cli.main(prog_name="ilmek")
    finally:
        for number in numbers:  # the outcome is settled
            signal.signal(number, signal.SIG_IGN)


def _end(number: int, _frame: FrameType | None) -> None:
    os.write(2, b"ilmek: interrupted; nothing was written\n")
    os._exit(128 + number)


if __name__ == "__main__":
    run()
