"""A password from the terminal or a pipe."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

import click

from ilmek.cli.interrupts import before_end


def typed_password(kept: str) -> str:
    """A password from the terminal, which does not show it; from a pipe its first line.

    kept  stated after Ctrl-C
    """
    if not sys.stdin.isatty():
        return sys.stdin.readline().rstrip("\r\n")
    with _echo_restored(kept):
        return str(click.prompt("Password", hide_input=True, confirmation_prompt=True, err=True))


@contextmanager
def _echo_restored(kept: str) -> Iterator[None]:
    """Have Ctrl-C leave the terminal as it is now."""
    try:
        import termios
    except ImportError:  # Windows
        yield
        return
    number = sys.stdin.fileno()
    state = termios.tcgetattr(number)

    def restored() -> str:
        termios.tcsetattr(number, termios.TCSANOW, state)
        return kept

    with before_end(restored):
        yield
