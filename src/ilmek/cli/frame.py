"""The frame of every command: lazy loading, and error messages of one line.

    exit 0    done
    exit 1    the reader of the output closed it
    exit 2    bad input, or an output that cannot be written: one line on the error stream, nothing written
    exit 130  Ctrl-C (129: the terminal closed; 143: terminated): one line, nothing half-written

Errors of ilmek (IlmekError) and of click are shown alike. A defect of the program keeps its traceback.
"""

import contextlib
import importlib
import math
import os
import signal
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from types import FrameType
from typing import Any, NoReturn, cast

import click

from ilmek.errors import IlmekError, did_you_mean, printable, shortened


class LazyGroup(click.Group):
    """A group whose commands are loaded from their modules when they are needed.

    modules  command name -> (module that defines `command`, one line of help)
    """

    def __init__(self, *, modules: Mapping[str, tuple[str, str]], **settings: Any) -> None:
        super().__init__(invoke_without_command=True, callback=_help_alone, **settings)
        self.modules = modules

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """The commands, in the order of use."""
        return list(self.modules)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        """The command, loaded from its module; None for an unknown name."""
        if cmd_name not in self.modules:
            return None
        return cast(click.Command, importlib.import_module(self.modules[cmd_name][0]).command)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command of the first argument. Raises UsageError for an unknown one, with the nearest name."""
        name = args[0]
        command = self.get_command(ctx, name)
        if command is None:
            hint = did_you_mean(name, self.modules, otherwise=f"commands: {', '.join(self.modules)}")
            raise click.UsageError(f"no such command {name!r}; {hint}", ctx)
        return name, command, args[1:]

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002 - click's
        """Write the list of commands without loading them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, line) for name, (_, line) in self.modules.items()])

    def main(
        self,
        args: Sequence[str] | None = None,
        prog_name: str | None = None,
        complete_var: str | None = None,
        standalone_mode: bool = True,
        windows_expand_args: bool = True,
        **extra: Any,
    ) -> Any:
        """Run the command. Standalone, every error that a user can correct becomes one line and an exit code."""
        settings = dict(extra, complete_var=complete_var, windows_expand_args=windows_expand_args)
        run = partial(super().main, args, prog_name or "ilmek", standalone_mode=False, **settings)
        if not standalone_mode:
            return run()
        _open_streams()
        _write_any_character()
        with _unwinding() as stopped:
            try:
                status: object = run()
            except (_Stopped, KeyboardInterrupt, click.Abort):
                _leave(_INTERRUPTED, 128 + (stopped or [signal.SIGINT])[0])
            except click.ClickException as error:
                _leave(_usage(error), 2)
            except IlmekError as error:
                _leave(str(error), 2)
            except MemoryError:
                _leave("out of memory; try a smaller picture, size or quality", 2)
            except OSError as error:
                _leave(f"{error.filename or 'the output'} cannot be read or written: {error.strerror or error}", 2)
            except Exception:
                # A library may turn Ctrl-C inside its callback into an error of its own.
                if not stopped:
                    raise
                _leave(_INTERRUPTED, 128 + stopped[0])
        sys.exit(status if isinstance(status, int) else 0)


_INTERRUPTED = "interrupted; nothing was written"
_IMPATIENCE = 2.0
"""Time after the first signal in which further ones are ignored [s]: temporary files are being removed."""


class _Stopped(BaseException):
    """A signal that ends the program. It is no KeyboardInterrupt: click would print an empty line for that."""


def _help_alone() -> None:
    """Show the help if no command is given."""
    context = click.get_current_context()
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def _usage(error: click.ClickException) -> str:
    """A usage error in one line, with a reference to the help."""
    message = error.format_message().rstrip(".")
    context = getattr(error, "ctx", None)
    return f"{message}; see '{context.command_path} --help'" if context is not None else message


_LONGEST = 2000
"""Largest number of characters of an error line; the longest list of parameters has 1,200."""


def _leave(message: str, status: int) -> NoReturn:
    """Print one line on the error stream and exit with `status`."""
    line = " ".join(printable(shortened(message, _LONGEST)).split())
    with contextlib.suppress(OSError):
        if message is _INTERRUPTED and sys.stderr.isatty():
            click.echo(err=True)  # behind the ^C that the terminal shows
        click.echo(f"ilmek: {line}", err=True)
    sys.exit(status)


def _open_streams() -> None:
    """Open closed standard streams (`>&-`) on the null device, so that no output file gets their numbers."""
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        if getattr(sys, name) is None:
            nowhere = os.open(os.devnull, os.O_RDWR)
            if nowhere != number:  # the stream's own number was taken by another file
                os.dup2(nowhere, number)
                os.close(nowhere)
            setattr(sys, name, os.fdopen(number, "w" if number else "r", encoding="utf-8", closefd=False))


def _write_any_character() -> None:
    """Replace characters that the terminal cannot show, such as × or °, by a question mark."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="replace")


@contextlib.contextmanager
def _unwinding() -> Iterator[list[int]]:
    """Let Ctrl-C, SIGTERM and SIGHUP unwind the stack, which removes temporary files; yields the signals received."""
    stopped: list[int] = []
    since = -math.inf

    def stop(number: int, _frame: FrameType | None) -> None:
        nonlocal since
        now, last = time.monotonic(), since
        since = now
        if now - last > _IMPATIENCE:
            stopped.append(number)
            raise _Stopped

    def unraisable(found: Any) -> None:
        if not isinstance(found.exc_value, _Stopped):  # a library's callback cannot pass it on
            hook(found)

    hook = sys.unraisablehook
    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    usual = (signal.SIG_DFL, signal.default_int_handler)
    try:
        before = {n: signal.signal(n, stop) for n in numbers if signal.getsignal(n) in usual}
    except ValueError:  # not the main thread: the program around us handles signals
        before = {}
    sys.unraisablehook = unraisable
    try:
        yield stopped
        _flush()
    finally:
        sys.unraisablehook = hook
        for number, handler in before.items():
            signal.signal(number, handler)


def _flush() -> None:
    """Flush standard output. If its reader has closed it, discard the rest and exit with 1."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
