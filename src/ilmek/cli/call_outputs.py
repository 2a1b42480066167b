"""The outputs of a command: files are written all or none; what goes to standard output follows when they are."""

import contextlib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import click

from ilmek.cli.language import language_of_command
from ilmek.cli.terminal import note, progress_bar, say
from ilmek.errors import ParameterError
from ilmek.io.output import Outputs
from ilmek.progress import SILENT, Progress

if TYPE_CHECKING:
    from ilmek.jobs.design import DesignResult
    from ilmek.report import Report

STANDARD = "-"
"""The name of standard output."""


class CallOutputs:
    """The outputs of a command by option.

    outputs   where a job stages its files
    progress  of the whole command
    """

    def __init__(self, outputs: Outputs, progress: Progress, to: Mapping[str, str | Path | None]) -> None:
        self.outputs, self.progress = outputs, progress
        self._to = {option: str(path) for option, path in to.items() if path is not None}
        self._printed: list[str | bytes] = []
        self._left_out: list[str] = []
        if list(self._to.values()).count(STANDARD) > 1:
            both = " and ".join(sorted(option for option, path in self._to.items() if path == STANDARD))
            raise ParameterError(f"both {both} go to standard output", do="give one of them a file")
        for option, path in self._to.items():
            if path != STANDARD:
                outputs.expect_file(Path(path), option)

    def give(self, option: str, content: Callable[[], str | bytes]) -> None:
        """Stage the content of an option's file, or keep it for standard output; nothing if the option is not given."""
        to = self._to.get(option)
        if to == STANDARD:
            self._printed.append(content())
        elif to is not None:
            self.outputs.write(Path(to), content())

    def give_json(self, data: Callable[[], Any]) -> None:
        """Give the data of `--json`, with warnings about what is left out of a page that was given before."""
        if "--json" in self._to:
            from ilmek.io.json_file import json_text  # the results bring numpy

            found = data()
            if self._left_out and isinstance(found, dict):
                found = {**found, "warnings": [*found.get("warnings", ()), *self._left_out]}
            self.give("--json", lambda: json_text(found, self.progress.part(0.0, 1.0, "JSON")))

    def give_page(self, option: str, report: "Report") -> None:
        """Stage the page of a report in the language of the command. What cannot be drawn is left out, and noted."""
        if option in self._to:
            from ilmek.jobs.page import page_text

            page = page_text(report, self._left_out, language_of_command())
            if page is None:
                del self._to[option]
            else:
                self.give(option, lambda: page)

    def give_scene(self, option: str, made: "DesignResult", pose: str | None = None) -> None:
        """Stage a designed loom, or the parts of another machine, in space; pose  of a STEP file, DRIVE=ANGLE.

        A machine without parts, as a synthesis without a solution, is left out, which is noted at the end.
        """
        if option not in self._to:
            return
        if made.loom is not None:
            from ilmek.jobs.loom_space import loom_file

            self.outputs.write(Path(self._to[option]), loom_file(option, made.loom, made.report, pose))
        elif made.tree is not None and made.tree.bodies:
            from ilmek.jobs.machine_space import machine_file

            self.outputs.write(Path(self._to[option]), machine_file(option, made.tree, made.report, pose))
        else:
            self._left_out.append(f"{self._to.pop(option)} was not written: there are no parts")

    def give_animation(self, option: str, report: "Report", motion: str | None = None) -> None:
        """Stage a motion that a report shows, the first or one by name. Raises ParameterError where there is none."""
        if option in self._to:
            from ilmek.jobs.animation import write_animation

            part = self.progress.part(0.0, 1.0, "animation")
            write_animation(report, Path(self._to[option]), self.outputs, part, motion=motion)

    @property
    def files(self) -> dict[str, str]:
        """The files that are written, by option."""
        return {option: path for option, path in self._to.items() if path != STANDARD}

    def show_files(self, nouns: Mapping[str, str]) -> None:
        """Print the paths of the files of some options, each with what it is."""
        for option, noun in nouns.items():
            if option in self.files:
                say(f"{noun}: {self.files[option]}")

    @property
    def quiet(self) -> bool:
        """Whether an output goes to standard output, on which nothing else is then printed."""
        return STANDARD in self._to.values()

    def print(self) -> None:
        """Print what goes to standard output, and notes on what was left out."""
        for text in self._printed:
            click.echo(text, nl=False)
        for text in self._left_out:
            note(text)


@contextlib.contextmanager
def call_outputs(
    to: Mapping[str, str | Path | None],
    *,
    force: bool = False,
    inputs: Mapping[str, Path | None] = MappingProxyType({}),
    bar: bool = True,
) -> Iterator[CallOutputs]:
    """The outputs of a command, committed at the end of the block; only then is anything printed.

    to      option -> file or "-"
    inputs  option -> file that is read
    bar     show a progress bar on a terminal
    Raises OutputError, before any work, where a file cannot be written; ParameterError for two outputs of "-".
    """
    given = {label: path for label, path in inputs.items() if path is not None}
    shown = progress_bar() if bar else contextlib.nullcontext(SILENT)
    with shown as progress, Outputs(force=force, inputs=given, progress=progress) as outputs:
        call = CallOutputs(outputs, progress, to)
        yield call
    call.print()
