"""The JSON of an earlier plan, and an instant as an option gives it."""

from datetime import datetime
from pathlib import Path

from ilmek.errors import ParameterError
from ilmek.io.data_text import read_data
from ilmek.io.factory_entry import datetime_of

LARGEST = 30_000_000
"""Largest plan [bytes]; a carpet takes 5 kB."""


def read_ends(path: Path) -> dict[str, datetime]:
    """When each order of a plan ends, by its name; those that are not woven are left out.

    Raises ParameterError for a file that `ilmek plan` has not written.
    """
    data = read_data(path, "plan", ParameterError, largest=LARGEST).data
    orders = data.get("orders") if isinstance(data, dict) and data.get("job") == "plan" else None
    if not isinstance(orders, list):
        raise ParameterError(f"{path} is no plan", allowed="plan.json of `ilmek plan --out`", do="give one")
    try:
        return {order["name"]: datetime.fromisoformat(order["end"]) for order in orders if order["end"]}
    except (KeyError, TypeError, ValueError):
        raise ParameterError(f"{path}: its orders have no name and end", do="plan again with --out") from None


def read_instant(option: str, text: object) -> datetime:
    """A local date and time. Raises ParameterError, with the option."""
    try:
        return datetime_of(text)
    except ParameterError as error:
        raise ParameterError(f"{option}: {error.given}", allowed=error.allowed, do=error.do) from None
