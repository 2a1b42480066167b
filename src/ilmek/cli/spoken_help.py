"""The help of commands in the language of --lang, where that stands before --help."""

from collections.abc import Iterable

import click

from ilmek.cli.language import worded


class SpokenHelp(click.HelpFormatter):
    """Writes help whose headings, paragraphs and meanings of options are said in the language of the command."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """Write the line of usage; click writes "Usage: " before it where no prefix is given."""
        super().write_usage(prog, args, worded("Usage: ") if prefix is None else prefix)

    def write_heading(self, heading: str) -> None:
        """Write a heading."""
        super().write_heading(worded(heading))

    def write_text(self, text: str) -> None:
        """Write paragraphs; examples are not wrapped, and begin with a backspace."""
        super().write_text("\n\n".join(map(_paragraph, text.split("\n\n"))))

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2) -> None:
        """Write names and what they mean; defaults and bounds stand in brackets behind a meaning."""
        spoken = [(name, "  ".join(map(worded, meaning.split("  ")))) for name, meaning in rows]
        super().write_dl(spoken, col_max, col_spacing)


class SpokenContext(click.Context):
    """A context of a command whose help is spoken."""

    formatter_class = SpokenHelp


def _paragraph(text: str) -> str:
    if text.startswith("\b"):
        return "\n".join(worded(line) if line.endswith(":") else line for line in text.split("\n"))
    return worded(" ".join(text.split()))
