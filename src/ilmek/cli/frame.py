"""The frame of every command: lazy loading, and error messages of one line.

    exit 0    done, and every check holds
    exit 2    bad input, or an output that cannot be written: one line on the error stream, nothing written
    exit 3    done, but a check fails: results and outputs are complete (ilmek.cli.verdict)
    exit 130  Ctrl-C (129: the terminal closed; 143: terminated): one line that states what has been written
    exit 141  the reader of the output closed it, as `head` does: nothing more is printed

Errors of ilmek (IlmekError) and of click are shown alike. A defect of the program keeps its traceback.
"""

import importlib
import os
import sys
from collections.abc import Mapping, Sequence
from functools import cache, partial
from typing import Any, cast

import click

from ilmek.cli.interrupts import interrupted, leave, supervised
from ilmek.cli.language import error_line, language_option, speak, worded
from ilmek.cli.spoken_help import SpokenContext
from ilmek.errors import IlmekError, did_you_mean

CLOSED = 128 + 13
"""Status of a program that SIGPIPE ends."""


class LazyGroup(click.Group):
    """A group whose commands are loaded from their modules when they are needed.

    modules  command name -> (module that defines `command`, one line of help)
    """

    context_class = SpokenContext

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
        return _speaking(cast(click.Command, importlib.import_module(self.modules[cmd_name][0]).command))

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; an error that a user can correct is in the language of the command."""
        try:
            return super().invoke(ctx)
        except IlmekError as error:
            error.args = (error_line(error),)
            raise

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
        _forget_bad_date()
        _write_any_character()
        try:
            status = supervised(lambda: _flushed(run()))
        except (KeyboardInterrupt, click.Abort):
            interrupted()
        except SystemExit as end:  # click and rich end with 1 where a pipe is closed, and nothing else does
            sys.exit(CLOSED if end.code == 1 else end.code)
        except click.ClickException as error:
            leave(_usage(error), 2)
        except IlmekError as error:
            leave(str(error), 2)
        except MemoryError:
            leave("out of memory; try a smaller picture, size or quality", 2)
        except OSError as error:
            leave(f"{error.filename or 'the output'} cannot be read or written: {error.strerror or error}", 2)
        _note_rebuilt_kernels()
        sys.exit(status if isinstance(status, int) else 0)


@cache
def _speaking(command: click.Command) -> click.Command:
    """The command with --lang; one that has a language for its files speaks it where it has every sentence."""
    command.context_class = SpokenContext
    own = next((one for one in command.params if "--lang" in one.opts), None)
    if own is None:
        command.params.append(language_option(hidden=True))
    else:
        own.callback = speak
    return command


def _help_alone() -> None:
    """Show the help if no command is given."""
    context = click.get_current_context()
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def _note_rebuilt_kernels() -> None:
    """A note where entries of the kernel cache were damaged, in one line for all."""
    kernels = sys.modules.get("ilmek.num.machine_code")
    if kernels is not None and kernels.discarded:
        folder = kernels.discarded[0].parent
        click.echo(f"note: {len(kernels.discarded)} damaged kernels in {folder} were removed and built anew", err=True)
        kernels.discarded.clear()


def _usage(error: click.ClickException) -> str:
    """A usage error in one line, with a reference to the help."""
    context = getattr(error, "ctx", None)
    if context is None:
        return error.format_message().rstrip(".")
    with context.scope(cleanup=False):
        see = worded(f"see '{context.command_path} --help'")
        return f"{worded(error.format_message()).rstrip('.')}; {see}"


def _open_streams() -> None:
    """Open closed standard streams (`>&-`) on the null device, so that no output file gets their numbers."""
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        if getattr(sys, name) is None:
            nowhere = os.open(os.devnull, os.O_RDWR)
            if nowhere != number:  # the stream's own number was taken by another file
                os.dup2(nowhere, number)
                os.close(nowhere)
            setattr(sys, name, os.fdopen(number, "w" if number else "r", encoding="utf-8", closefd=False))


def _forget_bad_date() -> None:
    """Remove a SOURCE_DATE_EPOCH that is no time in seconds: NumPy and SciPy fail on it when they are imported."""
    date = os.environ.get("SOURCE_DATE_EPOCH", "0")
    if not (date.isascii() and date.isdigit() and len(date) <= len(_LAST_DATE)):
        del os.environ["SOURCE_DATE_EPOCH"]


_LAST_DATE = "99999999999"
"""Seconds since 1970, in the year 5138."""


def _write_any_character() -> None:
    """Replace characters that the terminal cannot show, such as × or °, by a question mark."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="replace")


def _flushed(status: object) -> object:
    """Flush standard output; returns `status`. If its reader has closed it, discard the rest and end."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(CLOSED)
    return status
