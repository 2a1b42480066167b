"""Format of numbers and names on a page."""

import math
from dataclasses import replace
from typing import TypeGuard

from ilmek.report import Check, Json, Table, in_words, rounded, shown_value
from ilmek.report.table import Cell
from ilmek.units import POWERS, format_number, parse_unit
from ilmek.viz.style import shown_unit

_MINUS = str.maketrans("-", "−")
_SIGNS = {"<=": "≤", ">=": "≥", "==": "="}
_NOISE = 1e-9
NARROW_SPACE = "\u202f"


def number(value: Json, unit: str = "", digits: int = 4) -> str:
    r"""An SI number in `unit`, without the unit. A text stays as it is, True and False become yes and no, None a dash.

    Numbers are rounded to the resolution of their unit (`report.rounding`).

    >>> number(0.0597375, "mm"), number(-2.0), number(135000), number(True), number(None), number(4.857e-5)
    ('59.74', '−2', '135\u202f000', 'yes', '–', '4.857·10⁻⁵')
    >>> number(1.735e-17, "mm"), number(0.00512345, "mm"), number(0.0017453292, "deg")
    ('0', '5.123', '0.1')
    """
    if value is None or isinstance(value, str | bool):
        return "–" if value is None else value if isinstance(value, str) else "yes" if value else "no"
    if not isinstance(value, int | float):
        return str(value)
    if isinstance(value, int) and unit in ("", "1"):
        return count(value)
    if not math.isfinite(value):
        return "–" if math.isnan(value) else "∞" if value > 0 else "−∞"
    return _printed(rounded(float(value), unit) / parse_unit(unit).factor, digits)


def _printed(value: float, digits: int) -> str:
    """A finite number with a power of ten, true minus signs and its thousands separated."""
    written = format_number(value, digits)
    if "e" in written:
        mantissa, power = written.split("e")
        return f"{mantissa}·10{str(int(power)).translate(POWERS)}".replace("-", "−")
    head, point, tail = written.partition(".")
    if head.lstrip("-").isdigit() and len(head.lstrip("-")) > 4:
        head = f"{int(head):,}".replace(",", NARROW_SPACE)
    return (head + point + tail).translate(_MINUS)


def cells(table: Table) -> list[list[Cell]]:
    """A table's rows as printed, without rounding noise.

    >>> from ilmek.report import Column
    >>> shown = cells(Table("t", "", (Column("x", "mm"),), ((0.1,), (1e-17,))))
    >>> [row[0].text for row in shown]
    ['100', '0']
    """
    return [
        [Cell(number(v, c.unit, c.digits), isinstance(v, int | float)) for v, c in zip(row, table.columns, strict=True)]
        for row in quiet(table).rows
    ]


def quiet(table: Table) -> Table:
    """A table in which numbers below 1e-9 of the largest in their column are 0.

    >>> quiet(Table("t", "", (), ((0.1, "a"), (1e-17, "b")))).rows
    ((0.1, 'a'), (0.0, 'b'))
    """
    noise = [
        _NOISE * max((abs(v) for v in column if _measured(v)), default=0.0) for column in zip(*table.rows, strict=True)
    ]
    return replace(
        table,
        rows=tuple(
            tuple(0.0 if _measured(v) and abs(v) < least else v for v, least in zip(row, noise, strict=True))
            for row in table.rows
        ),
    )


def _measured(value: float | int | str) -> TypeGuard[float]:
    return isinstance(value, float) and math.isfinite(value)


def compared(check: Check) -> tuple[str, str]:
    """Value and limit of a check in its unit, the limit with its relation; of a plain yes or no, these words.

    >>> from ilmek.report import at_most
    >>> compared(at_most("closure", 1.7e-19, 1e-12, "mm", ""))
    ('0', '≤ 1·10⁻⁹')
    """
    value, limit = in_words(check)
    if limit == "yes":
        return value, limit
    shown, digits = shown_value(check)
    printed = [
        _printed(one / parse_unit(check.unit).factor, digits) if math.isfinite(one) else number(one)
        for one in (shown, check.limit)
    ]
    return printed[0], f"{sign(check.relation)} {printed[1]}"


def beside(check: Check) -> str:
    r"""The unit of a check as it follows its value; nothing after a yes or no.

    >>> from ilmek.report import at_most
    >>> beside(at_most("angle", 0.1, 0.2, "deg", "")), beside(at_most("sag", 0.1, 0.2, "mm", ""))
    ('°', '\xa0mm')
    """
    printed = "" if in_words(check)[1] == "yes" else shown_unit(check.unit)
    return printed if printed in ("", "°", "%") else f"\u00a0{printed}"


def quantity(value: Json, unit: str = "") -> str:
    """An SI number in `unit`, with the unit; other values as `number`.

    >>> quantity(0.5, "deg"), quantity(9.81, "m/s^2"), quantity("cycloidal", "")
    ('28.65°', '9.81 m/s²', 'cycloidal')
    """
    written, printed = number(value, unit), shown_unit(unit)
    if not printed or value is None or isinstance(value, str | bool):
        return written
    return f"{written}{'' if printed in ('°', '%') else ' '}{printed}"


def count(value: int) -> str:
    """A whole number with its thousands separated.

    >>> count(1234567) == "1 234 567".replace(" ", NARROW_SPACE)
    True
    """
    return f"{value:,}".replace(",", NARROW_SPACE).translate(_MINUS)


def fixed(value: float, factor: float, decimals: int) -> str:
    """The value divided by a factor, with the given number of decimals.

    >>> fixed(1.23456, 0.001, 1).replace(NARROW_SPACE, " ")
    '1 234.6'
    """
    return f"{value / factor:,.{decimals}f}".replace(",", NARROW_SPACE).translate(_MINUS)


def amount(value: float, factor: float) -> str:
    """The value divided by a factor: a whole number, one decimal below 10; zero is a dash.

    >>> amount(0.1234, 0.001), amount(0.0024, 0.001), amount(0.0, 1.0)
    ('123', '2.4', '–')
    """
    return fixed(value, factor, 0 if value >= 10 * factor else 1) if value else "–"


def share(part: int, whole: int) -> str:
    """A part of a whole in per cent; a small one is printed as < 0.1 %.

    >>> share(1, 3), share(1, 5000)
    ('33.3 %', '< 0.1 %')
    """
    return "< 0.1 %" if 0 < part / whole < 0.0005 else f"{100 * part / whole:.1f} %"


def words(name: str) -> str:
    """A name of an interface as words.

    >>> words("drive_torque")
    'drive torque'
    """
    return name.replace("_", " ")


def sign(relation: str) -> str:
    """A relation as it is printed.

    >>> sign("<=")
    '≤'
    """
    return _SIGNS.get(relation, relation)
