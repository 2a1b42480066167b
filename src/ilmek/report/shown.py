"""Records that show themselves: as a picture in a notebook, in a file.

Who draws and writes stands above the records. So a record looks its writer up when it is asked for a picture: it needs
none to exist (record 0038).
"""

from importlib import import_module
from pathlib import Path

WRITER = "ilmek.api.shown"
"""The module that draws and writes records."""


class Shown:
    """A record with a picture: a notebook shows it, `save` writes it."""

    __slots__ = ()

    def _repr_html_(self) -> str | None:
        """The picture and what stands beside it, for a notebook; None where there is no picture: it shows the text."""
        page: str | None = import_module(WRITER).html(self)
        return page

    def save(self, path: str | Path) -> None:
        """Write the record to a file, in the form of its ending.

        .svg a picture, .html a page, .csv columns, .json, .png; not every record has every form.
        Raises ParameterError for another ending, with those that it has; OutputError where the file cannot be written.
        """
        import_module(WRITER).save(self, path)
