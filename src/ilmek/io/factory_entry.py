"""Tables of the files of a factory: quantities with units, money, dates and times of day.

Dates and times are local, without an offset: `2026-12-18`, `2026-12-18T16:00`, as a TOML date or as text.
"""

import re
from datetime import date, datetime, time
from pathlib import Path

from ilmek.errors import IlmekError, ParameterError
from ilmek.io.file_entry import FileEntry
from ilmek.io.schema import shown
from ilmek.units import format_number, from_si, has_unit, parse_quantity, parse_unit

LARGEST = 2_000_000
"""Largest file of orders, and of looms [bytes]."""

MOST_MONEY = 1e9
"""Largest amount of money of an entry, in its currency."""

FIRST_YEAR, LAST_YEAR = 1900, 2200

_UNIT = r"[a-z]{1,4}(?:\^?[23]|[²³])?"
_MONEY = re.compile(rf"\s*(\d{{1,12}}(?:\.\d{{1,6}})?)\s*([^\W\d_]{{1,12}}|[€$£¥₺₹﷼])(?:\s*/\s*({_UNIT}))?\s*")
_CURRENCY = re.compile(r"[^\W\d_]{1,12}|[€$£¥₺₹﷼]")
_CLOCK = re.compile(r"([01]?\d|2[0-4]):([0-5]\d)")


class FactoryEntry(FileEntry):
    """A table of a factory's file."""

    __slots__ = ()

    def measured(self, key: str, unit: str, default: float | None = None, *, most: float = 1e9) -> float:
        """A quantity with its unit [SI], 0 to `most`; 0 needs no unit. Without a default it is required."""
        value = self.data.get(key)
        if value is None and default is not None:
            return default
        if value is None:
            self.refuse(ParameterError(f"has no {key!r}", allowed=f"a quantity in {unit}"))
        example = f'like "{format_number(min(2.0, from_si(most, unit)))}{unit}"'
        plain = isinstance(value, int | float) and not isinstance(value, bool)
        if plain and value == 0:
            return 0.0
        if not isinstance(value, str) or not has_unit(value):
            given = f"{shown(value)} has no unit" if plain else f"{shown(value)} is not a quantity with its unit"
            self.refuse(ParameterError(given, allowed=f"text in {unit}", do=f"write it {example}"), key)
        try:
            number = parse_quantity(value, unit)
        except IlmekError as error:
            self.refuse(error, key)
        if not 0 <= number <= most:
            allowed = f"0 to {format_number(from_si(most, unit))} {unit}"
            self.refuse(ParameterError(f"{shown(value)} is out of bounds", allowed=allowed), key)
        return number

    def money(self, key: str, currency: str, per: str = "") -> float | None:
        """An amount in a currency, or an amount per unit of the dimension of `per` [per SI unit]; None if missing.

        Refuses another currency, a missing one, and an amount per anything else.
        """
        value = self.data.get(key)
        if value is None:
            return None
        example = f'like "50 {currency}{f"/{per}" if per else ""}"'
        found = _MONEY.fullmatch(value) if isinstance(value, str) else None
        if found is None:
            error = ParameterError(
                f"{shown(value)} is not money", allowed="amount and currency", do=f"write it {example}"
            )
            self.refuse(error, key)
        if found[2] != currency:
            allowed = f"the currency of the file: {currency}"
            given = f"{shown(value)} is in another currency, or in none"
            self.refuse(ParameterError(given, allowed=allowed, do=f"write it {example}"), key)
        try:
            unit, needed = parse_unit(found[3] or ""), parse_unit(per)
        except IlmekError as error:
            self.refuse(error, key)
        if unit.dimension != needed.dimension:
            self.refuse(
                ParameterError(f"{shown(value)} has the wrong unit", allowed=f"{currency}/{per}" if per else currency),
                key,
            )
        amount = float(found[1])
        if amount > MOST_MONEY:
            self.refuse(ParameterError(f"{shown(value)} is too much", allowed=f"at most {MOST_MONEY:g}"), key)
        return amount / unit.factor

    def currency(self, default: str) -> str:
        """The currency of the file: a code of letters, or a sign."""
        text = self.text("currency", default)
        if not _CURRENCY.fullmatch(text):
            self.refuse(
                ParameterError(f"{shown(text)} is no currency", allowed="a code or sign like EUR or €"), "currency"
            )
        return text

    def instant(self, key: str, default: datetime | None = None, *, late: bool = False) -> datetime:
        """A local date and time, to the minute; a date alone is its begin, or with `late` its end.

        Without a default it is required.
        """
        value = self.data.get(key)
        if value is None:
            if default is None:
                self.refuse(ParameterError(f"has no {key!r}", allowed="a date and time, like 2026-12-18T16:00:00"))
            return default
        try:
            found = datetime_of(value, late=late)
        except ParameterError as error:
            self.refuse(error, key)
        return found

    def dates(self, key: str, most: int) -> list[date]:
        """A list of dates; empty if it is missing."""
        values = self.data.get(key, [])
        if not isinstance(values, list) or len(values) > most:
            self.refuse(ParameterError(f"{shown(values)} is no list of at most {most} dates"), key)
        try:
            return [datetime_of(value).date() for value in values]
        except ParameterError as error:
            self.refuse(error, key)

    def hours(self, key: str, text: str) -> tuple[int, int]:
        """Begin and end of a time of day, `06:00-14:00` [min]; an end before the begin is on the next day."""
        parts = [_CLOCK.fullmatch(part.strip()) for part in text.split("-")]
        clocks = [60 * int(part[1]) + int(part[2]) for part in parts if part is not None]
        if len(parts) != 2 or len(clocks) != 2 or clocks[0] == clocks[1] or max(clocks) > 1440 or clocks[0] == 1440:
            error = ParameterError(f"{shown(text)} are no hours", allowed='begin and end, like "06:00-14:00"')
            self.refuse(error, key)
        start, end = clocks
        return start, end if end > start else end + 1440

    def label(self, key: str) -> str:
        """A name: text that is not empty, of at most 60 characters."""
        text = self.text(key, "" if key not in self.data else None).strip()
        if not text or len(text) > 60:
            self.refuse(ParameterError(f"{shown(text)} is no name", allowed="1 to 60 characters"), key)
        return text

    def count(self, key: str, default: int, least: int, most: int) -> int:
        """A whole number within bounds."""
        value = self.data.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            error = ParameterError(f"{shown(value)} cannot be used", allowed=f"a whole number, {least} to {most}")
            self.refuse(error, key)
        return value


def datetime_of(value: object, *, late: bool = False) -> datetime:
    """A local instant, from a TOML date or a text; seconds are left out. Raises ParameterError.

    late  a date without a time is its end, else its begin
    """
    found = value
    if isinstance(value, str):
        try:
            found = (
                date.fromisoformat(value) if re.fullmatch(r"\d{4}-\d\d-\d\d", value) else datetime.fromisoformat(value)
            )
        except ValueError:
            found = None
    if isinstance(found, date) and not isinstance(found, datetime):
        found = datetime.combine(found, time(23, 59) if late else time())
    if not isinstance(found, datetime):
        raise ParameterError(f"{shown(value)} is no date", do="write it like 2026-12-18 or 2026-12-18T16:00:00")
    if found.tzinfo is not None:
        raise ParameterError(f"{shown(str(value))} has an offset", allowed="local time", do="leave the offset out")
    if not FIRST_YEAR <= found.year <= LAST_YEAR:
        raise ParameterError(f"the year {found.year}", allowed=f"{FIRST_YEAR} to {LAST_YEAR}")
    return found.replace(second=0, microsecond=0)


def file_beside(folder: Path, text: str, noun: str) -> Path:
    """The file of a relative path below a folder. Raises ParameterError for one outside, also through a link."""
    path = Path(text)
    if not text.strip() or "\0" in text:
        raise ParameterError(f"{text!r} names no file", do='give one, like "carpet.png"')
    if path.is_absolute() or ".." in path.parts or "\\" in text or path.drive:
        given = f"{shown(text)} reaches outside the folder of the {noun}"
        raise ParameterError(given, allowed="a path below it, with /", do="copy the file into that folder")
    try:
        inside = (folder / path).resolve(strict=True)
        base = folder.resolve(strict=True)
    except OSError:
        raise ParameterError(f"{shown(text)} is not there", do=f"put it into the folder of the {noun}") from None
    if not inside.is_relative_to(base) or not inside.is_file():
        raise ParameterError(f"{shown(text)} is no file in the folder of the {noun}", do="copy the file into it")
    return folder / path
