"""What a design reports: results, checks, tables, figures, parts and plates, as plain data.

A machine returns a `Report`; the command line, the web page and the JSON are made from it and know nothing else of the
machine. Values are SI; the unit beside a value is the one to show it in.
"""

from ilmek.records import DeclaredResult, computed, declared_results, group, record, result
from ilmek.report.bill import NOT_WEIGHED, BillLine, Joints, ProcessStep, Work
from ilmek.report.check import Check, at_least, at_most, in_words, must, shown_value, snap_to_limit
from ilmek.report.choice import Alternative, Choice, choose, failing
from ilmek.report.document import BUILDABLE, NEAREST, Report
from ilmek.report.figure import (
    Animation,
    Axis,
    DesignCloud,
    Dot,
    Drawing,
    Figure,
    Gantt,
    GanttLane,
    Lane,
    Link,
    Mark,
    Move,
    MovingDot,
    MovingStroke,
    Plot,
    Reading,
    Series,
    Shade,
    StackedBars,
    Stroke,
    Timing,
)
from ilmek.report.json import Json, plain
from ilmek.report.paper import NO_PAPERS, IndexEntry, Paper, Papers, PaperSection
from ilmek.report.results import Result, result_text, results_of
from ilmek.report.rounding import rounded
from ilmek.report.table import Column, Table, columns
from ilmek.report.verdict import reason_json, reasons, verdict_json
from ilmek.report.workshop import CamTable, Contour, Hole, Plate, RoundSolid, WorkPiece

__all__ = [
    "BUILDABLE",
    "NEAREST",
    "NOT_WEIGHED",
    "NO_PAPERS",
    "Alternative",
    "Animation",
    "Axis",
    "BillLine",
    "CamTable",
    "Check",
    "Choice",
    "Column",
    "Contour",
    "DeclaredResult",
    "DesignCloud",
    "Dot",
    "Drawing",
    "Figure",
    "Gantt",
    "GanttLane",
    "Hole",
    "IndexEntry",
    "Joints",
    "Json",
    "Lane",
    "Link",
    "Mark",
    "Move",
    "MovingDot",
    "MovingStroke",
    "Paper",
    "PaperSection",
    "Papers",
    "Plate",
    "Plot",
    "ProcessStep",
    "Reading",
    "Report",
    "Result",
    "RoundSolid",
    "Series",
    "Shade",
    "StackedBars",
    "Stroke",
    "Table",
    "Timing",
    "Work",
    "WorkPiece",
    "at_least",
    "at_most",
    "choose",
    "columns",
    "computed",
    "declared_results",
    "failing",
    "group",
    "in_words",
    "must",
    "plain",
    "reason_json",
    "reasons",
    "record",
    "result",
    "result_text",
    "results_of",
    "rounded",
    "shown_value",
    "snap_to_limit",
    "verdict_json",
]
