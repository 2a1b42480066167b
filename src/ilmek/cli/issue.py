"""The issue of drawings as given on the command line."""

from datetime import date

from ilmek.errors import ParameterError
from ilmek.report.sheet import Issue


def issue_of(words: str | None) -> Issue:
    """Revision, date and owner of drawings as given, the date of ISO 8601; without a comma the revision alone.

    Raises ParameterError for no revision, or for what is no date.

    >>> issue_of("B, 2026-11-30").date
    '2026-11-30'
    >>> issue_of("B,2026-11-30,Loom Works, Izmir").owner
    'Loom Works, Izmir'
    """
    if words is None:
        return Issue()
    revision, *others = (part.strip() for part in words.split(",", 2))
    day, owner = (*others, "", "")[:2]
    if not revision or _date(revision):
        raise ParameterError(f"--issue {words!r} has no revision", do="write it like B,2026-11-30")
    if others and not _date(day):
        raise ParameterError(
            f"--issue {words!r}: {day!r} is no date",
            allowed="a day of ISO 8601",
            do=f"write it like {revision},2026-11-30",
        )
    return Issue(owner or "—", _date(day) or "—", revision)


def _date(text: str) -> str:
    """The day of a text as YYYY-MM-DD; "" for none."""
    try:
        return date.fromisoformat(text).isoformat()
    except ValueError:
        return ""
