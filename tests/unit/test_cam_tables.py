"""Cam tables, read as each controller reads them and interpolated as it does, against the exact course."""

import csv
import io
import math
import re
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from scipy.interpolate import BPoly, CubicSpline

from ilmek.cams.laws import LAWS
from ilmek.cams.programme import CamProgramme, dwell, fall, rise
from ilmek.errors import OutputError
from ilmek.io.cam_tables import FORMATS
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule, sample, stroke
from ilmek.report import CamTable
from ilmek.timing.cyclogram import Track
from ilmek.timing.track import TrackSegment
from ilmek.timing.track import sample as track_sample

Course = Callable[[np.ndarray], np.ndarray]


def programme_table(law: str, *, lift: float = 0.03, start: float = 0.7) -> CamTable:
    turn = CamProgramme(
        (rise(1.5, lift, LAWS[law]), dwell(1.0), fall(1.7, lift, LAWS[law]), dwell(math.tau - 4.2)), start
    )
    knots = np.sort(np.mod(turn.knots[:-1], math.tau))
    return CamTable("cam-1", "Cam 1", lambda angle: np.stack(turn.at(angle)[:3]), knots, "mm", 2.0)


def handler_table() -> CamTable:
    """A shaft that turns on: three moves to a whole turn, as the knotting head's pile handler."""
    law = LAWS["modified-sine"]
    ends = (0.0, 0.5 * math.pi, 1.2 * math.pi, math.tau)
    times = ((0.0, 1.1), (1.6, 2.9), (3.5, 5.8))
    moves = tuple(
        TrackSegment(f"move {k}", *times[k], ends[k], ends[k + 1], law)  # type: ignore[arg-type]
        for k in range(3)
    )
    track = Track("pile handler", "cam 5", moves, unit="deg", revolves=math.tau)

    def course(angle: np.ndarray) -> np.ndarray:
        motion = track_sample(track, angle)
        return np.stack([motion.position, motion.slope, motion.bend])

    knots = np.array(sorted({0.0, *(t for pair in times for t in pair), math.tau}))
    return CamTable("handler", "Handler", course, knots, "deg", 2.0, revolves=math.tau)


TABLES = {
    "modified sine": programme_table("modified-sine"),
    "harmonic": programme_table("harmonic"),
    "moving at 0": programme_table("3-4-5", start=-0.7),
    "below 0": programme_table("cycloidal", lift=-0.02),
    "turning on": handler_table(),
}


def numbers(text: str, name: str) -> np.ndarray:
    return np.array([float(value) for value in re.findall(rf"{name} := ([-+.\dE]+)", text)])


def read_neutral(text: str) -> Course:
    heading, *lines = csv.reader(line for line in io.StringIO(text) if not line.startswith("#"))
    assert heading[0] == "master [deg]"
    x, y = np.array(lines, dtype=float).T[:2]
    return lambda at: np.interp(at, x, y)


def read_iec(text: str) -> Course:
    """The function block's own arithmetic, for masters of any turn."""
    steps = int(re.search(r"steps : DINT := (\d+)", text).group(1))  # type: ignore[union-attr]
    gained = float(re.search(r"advance : LREAL := ([-+.\dE]+)", text).group(1))  # type: ignore[union-attr]
    values = re.search(r"OF LREAL := \[(.*?)\]", text, re.DOTALL).group(1)  # type: ignore[union-attr]
    table = np.array([float(value) for value in values.split(",")])
    assert len(table) == steps + 1

    def block(master: np.ndarray) -> np.ndarray:
        turns = np.trunc(master / 360.0)
        turns = np.where(master < 360.0 * turns, turns - 1, turns)
        place = (master / 360.0 - turns) * steps
        index = np.minimum(np.trunc(place).astype(int), steps - 1)
        return table[index] + (place - index) * (table[index + 1] - table[index]) + gained * turns

    return block


def read_polynomials(text: str, names: tuple[str, str, str, str]) -> Course:
    x, y, v, a = (numbers(text, name) for name in names)
    assert len(x) == len(y) == len(v) == len(a) > 2
    assert v[-1] == v[0]
    assert a[-1] == a[0]
    return BPoly.from_derivatives(x, np.stack([y, v, a], axis=1))


def read_positions(text: str) -> Course:
    values = re.search(r"OF LREAL := \[(.*?)\]", text, re.DOTALL).group(1)  # type: ignore[union-attr]
    pairs = np.array([float(value) for value in values.split(",")]).reshape(-1, 2)
    assert f"ARRAY[1..{len(pairs)}, 1..2]" in text
    assert f"NoOfRows := {len(pairs)}," in text
    x, y = pairs.T
    return lambda at: np.interp(at, x, y)


def read_kollmorgen(text: str, sampled: SampledTable, table: CamTable) -> Course:
    first, begin, *rows, end = text.splitlines()
    assert (first, begin, end) == ("CYCLIC;YES;", "TABLE_BEGIN;;", "TABLE_END;;")
    cells = [row.split(";") for row in rows]
    assert {cell[2] for cell in cells} == {"SPLINE"}
    assert len(cells) >= 5
    x, y = np.array([[float(cell[0]), float(cell[1])] for cell in cells]).T
    scales = FORMATS["kollmorgen"].settings(table, sampled)
    return cyclic_spline(scales["master_scale"] * x / x.max(), scales["slave_scale"] * y / y.max())


def read_lenze(text: str) -> Course:
    lines = [line.split("//")[0].split() for line in text.splitlines()]
    x, y = np.array(lines, dtype=float).T
    return lambda at: np.interp(at, x, y)


def cyclic_spline(x: np.ndarray, y: np.ndarray) -> Course:
    gain = (y[-1] - y[0]) / (x[-1] - x[0])
    rest = y - gain * x
    rest[-1] = rest[0]
    course = CubicSpline(x, rest, bc_type="periodic")
    return lambda at: course(at) + gain * at


def read(name: str, text: str, sampled: SampledTable, table: CamTable) -> Course:
    readers: dict[str, Callable[[], Course]] = {
        "neutral": lambda: read_neutral(text),
        "iec": lambda: read_iec(text),
        "codesys": lambda: read_polynomials(text, ("dX", "dY", "dV", "dA")),
        "twincat-positions": lambda: read_positions(text),
        "twincat-motion": lambda: read_polynomials(text, ("MasterPos", "SlavePos", "SlaveVelo", "SlaveAcc")),
        "kollmorgen": lambda: read_kollmorgen(text, sampled, table),
        "lenze": lambda: read_lenze(text),
    }
    assert set(readers) == set(FORMATS)
    return readers[name]()


@cache
def sampled_once(case: str, rule: SamplingRule) -> SampledTable:
    """Formats of one rule share their points."""
    return sample(TABLES[case], rule, 1e-4 * stroke(TABLES[case]))


def exact(table: CamTable, degrees: np.ndarray) -> np.ndarray:
    """What the slave should do from the place where it is coupled, in the table's unit."""
    unit = {"mm": 1e-3, "deg": math.pi / 180}[table.unit]
    return (table.motion(np.radians(degrees))[0] - table.motion(np.zeros(1))[0, 0]) / unit


@pytest.mark.parametrize("case", TABLES)
@pytest.mark.parametrize("name", FORMATS)
def test_a_controller_keeps_the_stated_error_and_runs_on_without_a_jump(name: str, case: str) -> None:
    table, kind = TABLES[case], FORMATS[name]
    unit = {"mm": 1e-3, "deg": math.pi / 180}[table.unit]
    sampled = sampled_once(case, kind.rule)
    course = read(name, kind.text(table, sampled), sampled, table)
    degrees = np.linspace(0.0, 359.999, 7919)
    assert sampled.kept
    wrong = np.abs(course(degrees) - exact(table, degrees)).max() * unit
    assert wrong <= 1.001 * sampled.error + 1e-9 * stroke(table)
    assert wrong >= 0.5 * sampled.error - 1e-9 * stroke(table)  # the bound is the error, no guess
    start, end = course(np.array([0.0, 360.0]))
    assert start == 0.0
    assert end * unit == pytest.approx(table.revolves, abs=1e-9)


@pytest.mark.parametrize("case", ["moving at 0", "turning on"])
def test_the_block_of_structured_text_counts_turns_both_ways(case: str) -> None:
    table = TABLES[case]
    sampled = sample(table, FORMATS["iec"].rule, 1e-4 * stroke(table))
    block = read_iec(FORMATS["iec"].text(table, sampled))
    gained = math.degrees(table.revolves)
    degrees = np.array([0.0, 15.0, 200.0, 359.9])
    for turns in (-2, -1, 1, 3):
        assert block(degrees + 360.0 * turns) == pytest.approx(block(degrees) + turns * gained, abs=1e-6)


def test_joints_are_points_where_steps_are_uneven() -> None:
    table = TABLES["harmonic"]
    for rule in (SamplingRule("linear"), SamplingRule("spline"), SamplingRule("quintic")):
        angle = sample(table, rule, 1e-6).nodes.angle
        assert np.abs(angle[:, None] - table.knots).min(axis=0).max() < 1e-12
        assert (np.diff(angle) > 0).all()


def test_a_controller_with_too_few_points_is_told_the_error_it_reaches() -> None:
    table = programme_table("uniform")
    sampled = sample(table, SamplingRule("quintic", most=20), 1e-9)
    assert len(sampled.nodes.angle) == 20
    assert not sampled.kept
    assert 1e-6 < sampled.error < 1e-3
    assert len(sample(table, SamplingRule("quintic", most=4), 1e-9).nodes.angle) == 4


def test_a_finer_tolerance_is_reached_by_more_points() -> None:
    table = TABLES["modified sine"]
    for rule in (
        SamplingRule("linear"),
        SamplingRule("spline"),
        SamplingRule("quintic"),
        SamplingRule("linear", even=True),
    ):
        coarse, fine = (sample(table, rule, share * stroke(table)) for share in (1e-3, 1e-5))
        assert fine.kept
        assert len(fine.nodes.angle) > len(coarse.nodes.angle)


def test_a_course_that_jumps_at_the_end_of_the_turn_is_refused() -> None:
    ramp = CamTable(
        "ramp", "Ramp", lambda a: np.stack([a, np.ones_like(a), 0 * a]), np.array([0.0, math.tau]), "mm", 1.0
    )
    with pytest.raises(OutputError, match="ramp ends a turn 6283 mm from its beginning; a cam table continues"):
        sample(ramp, SamplingRule("linear"), 1e-6)


def test_a_slave_that_stands_still_is_a_table_of_zeros() -> None:
    still = CamTable("still", "Still", lambda a: np.zeros((3, *a.shape)), np.array([0.0, math.tau]), "mm", 1.0)
    for kind in FORMATS.values():
        sampled = sample(still, kind.rule, 1e-9)
        assert sampled.error == 0.0
        assert kind.text(still, sampled)


def test_the_error_of_a_table_is_that_of_the_default_setting_and_the_better_one_stands_beside() -> None:
    """TwinCAT interpolates a table of positions linearly unless its options set the spline."""
    table, kind = TABLES["modified sine"], FORMATS["twincat-positions"]
    sampled = sample(table, kind.rule, 1e-4 * stroke(table))
    text = kind.text(table, sampled)
    values = re.search(r"OF LREAL := \[(.*?)\]", text, re.DOTALL).group(1)  # type: ignore[union-attr]
    x, y = np.array([float(value) for value in values.split(",")]).reshape(-1, 2).T
    degrees = np.linspace(0.0, 360.0, 50_001)
    linear = np.abs(np.interp(degrees, x, y) - exact(table, degrees)).max() * 1e-3
    spline = np.abs(cyclic_spline(x, y)(degrees) - exact(table, degrees)).max() * 1e-3
    assert sampled.error == pytest.approx(linear, rel=0.02)
    assert sampled.better == pytest.approx(spline, rel=0.02)
    assert spline < 0.1 * linear
    assert f"linear interpolation: error at most {sampled.error * 1e3:.3g} mm" in text
    assert f"with MC_INTERPOLATIONTYPE_SPLINE: error at most {sampled.better * 1e3:.3g} mm" in text


def test_files_of_all_kinds_declare_names_of_their_own() -> None:
    table = TABLES["modified sine"]
    names: list[str] = []
    for kind in FORMATS.values():
        text = kind.text(table, sampled_once("modified sine", kind.rule))
        names += re.findall(r"^\s*(?:FUNCTION_BLOCK )?(cam_1\w*)(?: :|$)", text, re.MULTILINE)
    assert len(names) == 7
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("name", FORMATS)
def test_each_file_begins_with_what_must_be_set(name: str) -> None:
    table, kind = TABLES["modified sine"], FORMATS[name]
    sampled = sampled_once("modified sine", kind.rule)
    head = "\n".join(kind.remarks(table, sampled)) if kind.headless else kind.text(table, sampled)[:1200]
    for part in (kind.advice, "a turn in 2 s", "scale 1"):
        assert part in head


def test_remarks_say_where_the_axis_stands() -> None:
    table = programme_table("3-4-5", start=-0.7)
    sampled = sample(table, FORMATS["lenze"].rule, 1e-6)
    text = FORMATS["lenze"].text(table, sampled)
    assert sampled.offset > 1e-3
    assert f"position 0 of the table is {sampled.offset * 1e3:.12g} mm of the axis" in text
