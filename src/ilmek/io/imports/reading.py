"""Which form a file of another program has, and its mechanism."""

import contextlib
import re
from itertools import combinations, islice
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree as ET

from ilmek.errors import IlmekError, MechanismError, restated, shortened
from ilmek.io.data_text import parse_data
from ilmek.io.imports.foreign import Foreign
from ilmek.io.imports.linkage2 import linkage2_data
from ilmek.io.imports.mjcf import mjcf_data
from ilmek.io.imports.pmks import pmks_data
from ilmek.io.imports.pylinkage import pylinkage_data
from ilmek.io.imports.pyslvs import pyslvs_data
from ilmek.io.imports.skeleton import skeleton_data
from ilmek.io.imports.solvespace import solvespace_data
from ilmek.io.imports.urdf import urdf_data
from ilmek.io.mechanism_file import MechanismFile, mechanism_of_data
from ilmek.io.text_file import read_text
from ilmek.linkage.model import GROUND

LARGEST = 1_000_000
"""Largest size of a file [bytes]."""

XML_FORMS = {"robot": urdf_data, "mujoco": mjcf_data, "linkage2": linkage2_data}
"""Root element -> the reader of its form."""

FORMS = "URDF, MJCF, .linkage2, JSON of pylinkage, an address of PMKS+, an expression of Pyslvs, .slvs, .dxf"
"""What can be read."""

LATIN = {".linkage2", ".slvs", ".dxf"}
"""Ends of names whose files are not in UTF-8."""


MOST_INPUTS, TRIALS = 3, 100
"""Inputs that are sought where a file has none, and combinations of each number of them."""


class ImportedMechanism(NamedTuple):
    """A mechanism of another program's file, and what of it has no equivalent."""

    file: MechanismFile
    left_out: tuple[str, ...]


def imported_mechanism(path: Path) -> ImportedMechanism:
    """The mechanism of another program's file, its form by its content.

    Where the file has no input, the first joint on the ground that can drive the mechanism is its input. Raises
    MechanismError with the file for one that is damaged, of another form, or cannot be solved.
    """
    noun = "mechanism of another program"
    encoding = "latin-1" if path.suffix.lower() in LATIN else "utf-8-sig"
    with restated(MechanismError, f"{noun} {path} ", of=MechanismError):
        text = read_text(path, noun=noun, largest=LARGEST, error=MechanismError, do="check the path", encoding=encoding)
    with restated(MechanismError, f"{path}: "):
        return mechanism_of_text(text)


def mechanism_of_text(text: str) -> ImportedMechanism:
    """The mechanism of another program's text, as `imported_mechanism`."""
    data, left_out = _driven(_foreign(text))
    file = mechanism_of_data(data)
    file.plan()
    return ImportedMechanism(file, left_out)


def _foreign(text: str) -> Foreign:
    start = text.lstrip()
    if start.startswith("<"):
        return _xml(text)
    if "SolveSpace" in start[:20]:
        return solvespace_data(text)
    if text.split(maxsplit=2)[:2] == ["0", "SECTION"] or start.startswith("999"):
        return skeleton_data(text)
    if re.match(r"(#[^\n]*\s*)*M\s*\[", start):
        return pyslvs_data(text)
    if re.fullmatch(r"(\S*\?)?[\w-]+(\.[\w,-]*){5,}", start.rstrip()):
        return pmks_data(start)
    return _json(text)


def _driven(foreign: Foreign) -> Foreign:
    """With inputs: bodies on the ground, as few as drive the mechanism, where the file has none."""
    data, left_out = foreign
    if data.get("inputs"):
        return foreign
    pins = {joint: [body for body in entry.get("pin", []) if body != GROUND] for joint, entry in data["joints"].items()}
    turned = {
        joint if body == bodies[0] else f"{joint}.{body}": body
        for joint, bodies in pins.items()
        if GROUND in data["joints"][joint].get("pin", [])
        for body in bodies
    }
    for count in range(1, MOST_INPUTS + 1):
        for joints in islice(combinations(turned, count), TRIALS):
            driven = {**data, "inputs": {joint: turned[joint] for joint in joints}}
            with contextlib.suppress(IlmekError):
                mechanism_of_data(driven).plan()
                chosen = ", ".join(f"{joint} turns {turned[joint]}" for joint in joints)
                return Foreign(driven, (*left_out, f"the input, which the file does not have: {chosen}"))
    raise MechanismError("has no input, and no joint on the ground drives it", do="complete the drawing")


def _xml(text: str) -> Foreign:
    if "<!" in text.replace("<!--", ""):
        raise MechanismError("has a document type or CDATA", allowed="plain elements and comments")
    try:
        root = ET.fromstring(text)
    except (ET.ParseError, RecursionError) as error:
        raise MechanismError(f"is no XML: {error}", do="correct that line") from None
    reader = XML_FORMS.get(root.tag)
    if reader is None:
        raise MechanismError(f"begins with <{shortened(root.tag)}>", allowed=FORMS)
    return reader(root)


def _json(text: str) -> Foreign:
    data = parse_data(text, name="JSON", toml=False, error=MechanismError).data
    if not isinstance(data, dict) or not isinstance(data.get("joints"), list):
        raise MechanismError("has no list of joints", allowed=FORMS)
    return pylinkage_data(data)
