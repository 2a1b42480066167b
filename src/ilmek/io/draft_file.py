"""Drafts in files of weaving programs: Weaving Information File 1.1, 1997 (Nielsen, Keates, Sinkler)."""

import configparser
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ilmek.arrays import BoolArray, Rgb
from ilmek.errors import LoomError, restated
from ilmek.io.text_file import read_text
from ilmek.units import cm, mm
from ilmek.weaving.draft import Draft

LARGEST_FILE, MOST_THREADS, MOST_SHAFTS = 10_000_000, 5_000, 1_000
"""Bytes of a file; warps or picks, and shafts or treadles of a draft."""

_UNITS = {"centimeters": cm, "inches": 25.4 * mm, "decipoints": 25.4 * mm / 720}
_BLACK = (0, 0, 0)


def is_draft(path: Path) -> bool:
    """Whether a file is one by its ending, .wif."""
    return path.suffix.lower() == ".wif"


def read_draft(path: Path) -> Draft:
    """The draft of a WIF file. Raises LoomError for a file that is none, with the section and the key at fault."""
    with restated(LoomError, f"{path}: "):
        text = read_text(path, noun="WIF file", largest=LARGEST_FILE, error=LoomError, do="give a WIF file")
        parser = configparser.ConfigParser(
            strict=False, interpolation=None, delimiters=("=",), comment_prefixes=(";",), empty_lines_in_values=False
        )
        try:
            parser.read_string(text)
        except configparser.Error as failed:
            raise LoomError(f"is no WIF file: {str(failed).splitlines()[0]}", do="save it as WIF 1.1") from None
        return _Reader({name.lower(): dict(parser[name]) for name in parser.sections()}).draft()


class _Reader:
    """The sections of a file."""

    def __init__(self, sections: Mapping[str, Mapping[str, str]]) -> None:
        self.sections = sections
        if "wif" not in sections:
            raise LoomError("has no section [WIF]", do="save it as WIF 1.1")

    def draft(self) -> Draft:
        """What the sections say."""
        warps, picks = (self.whole(name, "threads", MOST_THREADS) for name in ("warp", "weft"))
        shafts = self.whole("weaving", "shafts", MOST_SHAFTS)
        threading = self.matrix("threading", warps, shafts)
        if "liftplan" in self.sections:
            treadles, lifted = 0, self.matrix("liftplan", picks, shafts)
        else:
            treadles = self.whole("weaving", "treadles", MOST_SHAFTS)
            treadling = self.matrix("treadling", picks, treadles).astype(np.float32)
            lifted = treadling @ self.matrix("tieup", treadles, shafts) > 0
        up = lifted.astype(np.float32) @ threading.T > 0
        if self.value("weaving", "rising shed", "true").lower() in {"false", "no", "off", "0"}:
            up = ~up
        warp, weft = self.colours("warp", warps), self.colours("weft", picks)
        return Draft(up, shafts, treadles, warp, weft, self.pitch("warp"), self.pitch("weft"))

    def value(self, section: str, key: str, usual: str | None = None) -> str:
        found = self.sections.get(section, {}).get(key, usual)
        if found is None:
            raise LoomError(f"[{section.upper()}] has no key {key.title()}", do="save it as WIF 1.1 with its draft")
        return found

    def whole(self, section: str, key: str, most: int) -> int:
        """A count, 1 to `most`."""
        return self.number(section, key, self.value(section, key), 1, most)

    def number(self, section: str, key: str, text: str, least: int, most: int) -> int:
        """A whole number in bounds."""
        if not (text.strip().isascii() and text.strip().isdigit() and least <= int(text) <= most):
            raise LoomError(f"[{section.upper()}] {key}={text[:40]}", allowed=f"a whole number, {least} to {most}")
        return int(text)

    def matrix(self, section: str, lines: int, most: int) -> BoolArray:
        """What each line names, of 1 to `most`; 0 is nothing: (lines, most)."""
        made = np.zeros((lines, most + 1), dtype=bool)
        if section not in self.sections:
            raise LoomError(f"has no section [{section.upper()}]", do="save it as WIF 1.1 with its draft")
        for key, text in self.sections[section].items():
            line = self.number(section, "line", key, 1, lines)
            for part in text.split(","):
                made[line - 1, self.number(section, key, part, 0, most)] = True
        matrix: BoolArray = made[:, 1:]
        return matrix

    def colours(self, name: str, count: int) -> Rgb:
        """The colour of each thread: its own, or that of all; without a table all are black."""
        table = self.sections.get("color table", {})
        of_all = self.value(name, "color", "").partition(",")[0]
        usual = self.colour(table, of_all) if of_all.strip() else _BLACK
        made = np.full((count, 3), usual, dtype=np.uint8)
        section = f"{name} colors"
        for key, text in self.sections.get(section, {}).items():
            made[self.number(section, "line", key, 1, count) - 1] = self.colour(table, text)
        return made

    def colour(self, table: Mapping[str, str], place: str) -> tuple[int, ...]:
        """The colour at a place of the table, with its range made that of sRGB codes."""
        if place.strip() not in table:
            raise LoomError(f"[COLOR TABLE] has no colour {place.strip()[:40]!r}", do="save it with its colours")
        first, _, last = self.value("color palette", "range", "0,255").partition(",")
        low, high = (self.number("color palette", "range", part, 0, 65_535) for part in (first, last))
        parts = [self.number("color table", place, part, low, high) for part in table[place.strip()].split(",")]
        if len(parts) != 3 or high <= low:
            given = f"[COLOR TABLE] {place}={table[place.strip()][:40]}"
            raise LoomError(given, allowed=f"red, green and blue, {low} to {high}")
        return tuple(round(255 * (part - low) / (high - low)) for part in parts)

    def pitch(self, name: str) -> float | None:
        """The distance of two threads [m]; None: it is not given."""
        text, unit = self.value(name, "spacing", ""), self.value(name, "units", "").strip().lower()
        try:
            distance = float(text) * _UNITS[unit]
        except (KeyError, ValueError):
            return None
        return distance if 0 < distance < 1 else None
