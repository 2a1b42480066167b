"""The record of a format of cam tables, and the notation of numbers and names that all formats share."""

import re
from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.records import record
from ilmek.report import CamTable
from ilmek.units import deg, parse_unit, turn


@record
class TablePoints:
    """A table's points in the units of a controller.

    x     master angle [deg]
    y     position of the slave, in the table's unit
    v, a  first and second derivative of y with respect to x
    """

    x: Float[np.ndarray, " nodes"]
    y: Float[np.ndarray, " nodes"]
    v: Float[np.ndarray, " nodes"]
    a: Float[np.ndarray, " nodes"]


Remarks: TypeAlias = tuple[str, ...]
"""Lines of text."""


def no_more(table: CamTable, sampled: SampledTable) -> dict[str, float]:  # noqa: ARG001 - one of many
    """The `settings` of most formats: none."""
    return {}


@record
class Format:
    """A format of cam tables.

    name, suffix  of its files: NAME.name.suffix
    title         description
    rule          interpolation of the controller, and the number of points that it accepts
    write         the file's text, with the remarks at its head
    advice        what must be set in the controller, in words
    settings      settings of the controller, as numbers by name
    better        name of the better setting of `rule.better`
    headless      the format has no comments: the remarks stand in a file of their own
    """

    name: str
    suffix: str
    title: str
    rule: SamplingRule
    write: Callable[[CamTable, SampledTable, Remarks], str]
    advice: str
    settings: Callable[[CamTable, SampledTable], dict[str, float]] = no_more
    better: str = ""
    headless: bool = False

    def text(self, table: CamTable, sampled: SampledTable) -> str:
        """The file of a table."""
        return self.write(table, sampled, self.remarks(table, sampled))

    def remarks(self, table: CamTable, sampled: SampledTable) -> Remarks:
        """What the table is, what must be set in the controller, and the errors that follow, in lines for a comment."""
        factor = parse_unit(table.unit).factor
        advance = f"; it advances {number(table.revolves / factor)} {table.unit} per turn" if table.revolves else ""
        scales = "".join(f"; {name} {number(value)}" for name, value in self.settings(table, sampled).items())
        error = f"error at most {sampled.error / factor:.3g} {table.unit}"
        lines = (
            f"{table.title} ({table.name}) for {self.title}",
            f"set: {self.advice}",
            f"set: master modulo 360 deg, a turn in {table.period:.6g} s; slave in {table.unit}, scale 1{scales}",
            f"master 0 to 360 deg, slave from 0{advance}",
            f"position 0 of the table is {number(sampled.offset / factor)} {table.unit} of the axis",
            f"{len(sampled.nodes.angle)} points, {sampled.interpolation} interpolation: {error}",
        )
        if sampled.better is None:
            return lines
        return (*lines, f"with {self.better}: error at most {sampled.better / factor:.3g} {table.unit}")


def rows(table: CamTable, sampled: SampledTable) -> TablePoints:
    """The points in the units of a controller."""
    nodes, factor = sampled.nodes, parse_unit(table.unit).factor
    x = nodes.angle / deg
    x[-1] = turn / deg
    return TablePoints(x, nodes.s / factor, nodes.ds * deg / factor, nodes.dds * deg**2 / factor)


def number(value: float) -> str:
    """A number as a real literal in every language: with a decimal point, without a negative zero.

    >>> number(1.0), number(-0.0), number(1e-7), number(2 / 3)
    ('1.0', '0.0', '1.0E-07', '0.666666666667')
    """
    text = f"{value + 0.0:.12g}"
    digits, exponent, power = text.partition("e")
    return (digits if "." in digits else f"{digits}.0") + (f"E{power}" if exponent else "")


def identifier(name: str, kind: str) -> str:
    """A name as an identifier of programming languages; `kind` ends it, so that files of all kinds can be imported.

    >>> identifier("side-gripper motion", "xyva"), identifier("2nd cam", "block")
    ('side_gripper_motion_xyva', 'cam_2nd_cam_block')
    """
    text = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_") or "cam"
    return f"{text if text[0].isalpha() else f'cam_{text}'}_{kind}"


def comment(lines: Sequence[str]) -> str:
    """Lines as comments of IEC 61131-3."""
    return "".join(f"(* {line.replace('*)', '* )')} *)\n" for line in lines)


def wrapped(items: Sequence[str], count: int = 8) -> str:
    """Items separated by commas, `count` per line."""
    lines = [", ".join(items[start : start + count]) for start in range(0, len(items), count)]
    return ",\n    ".join(lines)
