"""Settings of parameters on the command line: NAME=VALUE, or NAME=@FILE to read the value from a file."""

from collections.abc import Iterable
from pathlib import Path

from ilmek.errors import ParameterError, restated
from ilmek.io.text_file import read_text

LARGEST = 1_000_000
"""Largest size of a value in a file [bytes]."""

LOOM_FILES = (".json", ".toml")
"""Endings of the file of a loom."""


def read_settings(settings: Iterable[str]) -> dict[str, str]:
    """Texts by parameter name.

    Raises ParameterError for a setting without a name or value, one given twice, or a file that cannot be read.
    """
    read: dict[str, str] = {}
    for setting in settings:
        name, equals, value = (part.strip() for part in setting.partition("="))
        if not equals or not name or not value:
            raise ParameterError(f"{setting!r} is no setting", do="write NAME=VALUE, like swing=30deg")
        if name in read:
            raise ParameterError(f"{name} is set twice: {read[name]} and {value}", do="set it once")
        read[name] = _in_file(name, Path(value[1:])) if value.startswith("@") else value
    return read


def setting_files(settings: Iterable[str]) -> dict[str, Path]:
    """The files from which values are read, by setting as written."""
    parts = ((setting, setting.partition("=")[2].strip()) for setting in settings)
    return {setting: Path(value[1:]) for setting, value in parts if value.startswith("@")}


def loom_settings(given: Iterable[str]) -> tuple[Path | None, tuple[str, ...]]:
    """The file of a loom among settings, if there is one, and the settings. Raises ParameterError for two files."""
    given = tuple(given)
    files = [text for text in given if "=" not in text]
    for text in files:
        if Path(text).suffix.lower() not in LOOM_FILES:
            raise ParameterError(f"{text!r} is neither a setting nor a loom file", do="write NAME=VALUE, or FILE.json")
    if len(files) > 1:
        raise ParameterError(f"two looms: {files[0]} and {files[1]}", do="give one loom file")
    return (Path(files[0]) if files else None), tuple(text for text in given if "=" in text)


def _in_file(name: str, path: Path) -> str:
    wording = dict(noun="text file with the value", do="check its name")
    with restated(ParameterError, f"{name}=@{path}: ", of=ParameterError):
        return read_text(path, largest=LARGEST, error=ParameterError, **wording)
