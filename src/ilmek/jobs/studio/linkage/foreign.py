"""A file of another program that is dropped into the linkage view, as the text of a mechanism file."""

from dataclasses import dataclass
from pathlib import Path

from ilmek.errors import MechanismError, restated, shortened
from ilmek.io.imports.reading import LARGEST, mechanism_of_text
from ilmek.io.mechanism_file import writer_for
from ilmek.jobs.studio.answers import Context


@dataclass(frozen=True, slots=True)
class ForeignRequest:
    """A file of another program: its name, and its bytes."""

    name: str
    content: bytes


@dataclass(frozen=True, slots=True)
class ForeignAnswer:
    """Its mechanism as the TOML text of a mechanism file, and what has no equivalent."""

    text: str
    left_out: tuple[str, ...]


def foreign_mechanism(request: ForeignRequest, context: Context) -> ForeignAnswer:
    """The mechanism of a file of another program. Raises MechanismError as `ilmek import`."""
    with restated(MechanismError, f"{shortened(request.name)}: "):
        if len(request.content) > LARGEST:
            raise MechanismError(f"has {len(request.content):,} bytes", allowed=f"at most {LARGEST:,}")
        try:
            text = request.content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = request.content.decode("latin-1")
        file, left_out = mechanism_of_text(text)
    return ForeignAnswer(writer_for(Path("mechanism.toml"))(file.machine), left_out)
