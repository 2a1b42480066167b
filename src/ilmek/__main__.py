"""`python -m ilmek` is `ilmek`."""

import importlib
import signal


def run() -> None:
    """Run the command line as a program: Ctrl-C ends it without a traceback, also while it starts and ends."""
    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        importlib.import_module("ilmek.cli").main(prog_name="ilmek")  # after the signals
    finally:
        for number in numbers:  # the outcome is settled
            signal.signal(number, signal.SIG_IGN)


if __name__ == "__main__":
    run()
