"""Which form a file of another program has, and its mechanism."""

from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree as ET

from ilmek.errors import MechanismError, restated, shortened
from ilmek.io.data_text import parse_data
from ilmek.io.imports.foreign import Foreign
from ilmek.io.imports.mjcf import mjcf_data
from ilmek.io.imports.pylinkage import pylinkage_data
from ilmek.io.imports.urdf import urdf_data
from ilmek.io.mechanism_file import MechanismFile, mechanism_of_data
from ilmek.io.text_file import read_text

LARGEST = 1_000_000
"""Largest size of a file [bytes]."""

XML_FORMS = {"robot": urdf_data, "mujoco": mjcf_data}
"""Root element -> the reader of its form."""


class ImportedMechanism(NamedTuple):
    """A mechanism of another program's file, and what of it has no equivalent."""

    file: MechanismFile
    left_out: tuple[str, ...]


def imported_mechanism(path: Path) -> ImportedMechanism:
    """The mechanism of a URDF, MJCF or pylinkage file.

    Raises MechanismError with the file for one that is damaged, of another form, or cannot be solved.
    """
    noun = "mechanism of another program"
    with restated(MechanismError, f"{noun} {path} ", of=MechanismError):
        text = read_text(path, noun=noun, largest=LARGEST, error=MechanismError, do="check the path")
    with restated(MechanismError, f"{path}: "):
        data, left_out = _xml(text) if text.lstrip().startswith("<") else _json(text)
        file = mechanism_of_data(data)
        file.plan()
    return ImportedMechanism(file, left_out)


def _xml(text: str) -> Foreign:
    if "<!" in text.replace("<!--", ""):
        raise MechanismError("has a document type or CDATA", allowed="plain elements and comments")
    try:
        root = ET.fromstring(text)
    except (ET.ParseError, RecursionError) as error:
        raise MechanismError(f"is no XML: {error}", do="correct that line") from None
    reader = XML_FORMS.get(root.tag)
    if reader is None:
        raise MechanismError(f"begins with <{shortened(root.tag)}>", allowed="<robot> of URDF, or <mujoco>")
    return reader(root)


def _json(text: str) -> Foreign:
    data = parse_data(text, name="JSON", toml=False, error=MechanismError).data
    if not isinstance(data, dict) or not isinstance(data.get("joints"), list):
        raise MechanismError("has no list of joints", allowed="URDF, MJCF, or JSON of pylinkage")
    return pylinkage_data(data)
