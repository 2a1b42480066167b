"""The issue of drawings as given on the command line."""

from ilmek.report.sheet import Issue


def issue_of(words: str | None) -> Issue:
    """Revision and date of drawings, as given."""
    revision, _, date = (words or "").partition(",")
    return Issue(date=date.strip() or "—", revision=revision.strip() or "—")
