"""A measured curve beside that of a machine's model: what differs by how much, and parameters fitted to it.

    e_i = y_i - f(x_i)      rms sqrt(mean e²), and that over the range of y
    explained 1 - sum e² / sum (y - mean y)²                  share of the variance

The curves of a machine are those of its figures: a column is named as one of them is labelled, in a unit of its kind.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import IlmekError, ParameterError, did_you_mean
from ilmek.io.measured_file import MeasuredCurve, read_measured
from ilmek.machines.catalogue import find_machine
from ilmek.machines.component import AnyComponent
from ilmek.num.least_squares import fitted
from ilmek.params import Parameter, Params, Setting, listed
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import Check, Json, Plot, Report, Result, Series, Table, at_most, columns
from ilmek.report.left_out import made_figures
from ilmek.units import format_quantity, parse_unit, turn

MOST_EVALUATIONS = 400
"""Expected number of designs of a fit, for its progress."""


@dataclass(frozen=True, slots=True)
class CompareOrder:
    """What is compared: a file with measured curves, a machine with its settings, parameters to fit by name.

    align   find the shift of what is measured over too, as of an encoder whose zero is not known
    within  allowed rms difference over the range of a measured curve; None: it is not judged
    """

    file: Path
    machine: AnyComponent
    params: Params
    fit: tuple[str, ...] = ()
    align: bool = False
    within: float | None = None


def read_compare_order(
    file: Path,
    machine: str,
    settings: Mapping[str, Setting],
    *,
    fit: Sequence[str] = (),
    align: bool = False,
    within: float | None = None,
) -> CompareOrder:
    """The order from texts. Raises ParameterError for an unknown machine or parameter, or one that is no number."""
    component, params = find_machine(machine).ordered(settings)
    known, values = {one.name: one for one in listed(type(params))}, params.as_dict()
    for name in fit:
        if name not in known:
            raise ParameterError(f"unknown parameter {name!r} of {machine}", do=did_you_mean(name, known))
        if known[name].kind is not float or not isinstance(values[name], float | int):
            raise ParameterError(f"--fit {name}, which is no number in force", do="fit lengths, masses, forces ...")
    return CompareOrder(file, component, params, tuple(dict.fromkeys(fit)), align, within)


@record
class ComparedCurve:
    """A measured curve, and the model's at its samples."""

    measured: MeasuredCurve
    plot: Plot
    series: Series
    shift: float

    @property
    def at(self) -> FloatArray:
        """Where the model is evaluated: what is measured over, shifted, and in the model's turn where it has one."""
        x = self.measured.x + self.shift
        first, last = float(self.series.x[0]), float(self.series.x[-1])
        return np.asarray(first + np.mod(x - first, turn)) if abs(last - first - turn) < 1e-6 else x

    @property
    def model(self) -> FloatArray:
        """The model at the samples; NaN where it has none."""
        return np.asarray(np.interp(self.at, self.series.x, self.series.y, left=np.nan, right=np.nan))

    @property
    def difference(self) -> FloatArray:
        """Measured less model, of samples where the model has a value."""
        difference = self.measured.y - self.model
        return np.asarray(difference[np.isfinite(difference)])

    @property
    def range(self) -> float:
        """Range of the measured curve."""
        return float(np.ptp(self.measured.y))

    @property
    def rms(self) -> float:
        """Root mean square of the difference."""
        return float(np.sqrt(np.mean(self.difference**2)))

    @property
    def explained(self) -> float:
        """Share of the measured variance that the model explains; at most 1."""
        mean = float(np.mean(self.measured.y))
        return 1 - float(np.sum(self.difference**2) / np.sum((self.measured.y - mean) ** 2))

    @property
    def row(self) -> tuple[int | float, ...]:
        """Samples; rms of the difference, and that over the range; its mean, its greatest value and where that is; the
        greatest of the measured curve and of the model.
        """
        difference = self.measured.y - self.model
        worst = int(np.nanargmax(np.abs(difference)))
        spread = float(difference[worst]), float(self.at[worst])
        tops = float(np.max(self.measured.y)), float(np.nanmax(self.model))
        share = self.rms / self.range if self.range else 0.0
        return (int(self.difference.size), self.rms, share, float(np.mean(self.difference)), *spread, *tops)

    def as_json(self) -> dict[str, Json]:
        """By JSON names, SI."""
        return {"curve": f"{self.plot.name}: {self.series.label}", **dict(zip(KEYS, self.row, strict=True))}


KEYS = ("samples", "rms", "rms_over_range", "mean", "greatest", "greatest_at", "measured_max", "model_max")
"""JSON names of a row."""


def compare(order: CompareOrder, progress: Progress = SILENT) -> Report:
    """The report: curve by curve what differs, before and after the fit. Raises any IlmekError of file or design."""
    measured = read_measured(order.file)
    before = compared(order, measured, order.params, 0.0)
    report = _report(order, before, None, ())
    if not order.fit and not order.align:
        return report
    known, given = {one.name: one for one in listed(type(order.params))}, order.params.as_dict()
    bounds = np.array([_bounds(known[name]) for name in order.fit] + [(-turn, turn)] * order.align)
    start = np.array([given[name] for name in order.fit] + [0.0] * order.align, dtype=float)
    spans = [one.range or 1.0 for one in before]
    calls = 0

    def residuals(values: FloatArray) -> FloatArray:
        nonlocal calls
        calls += 1
        progress(min(0.99, calls / MOST_EVALUATIONS))
        try:
            curves = compared(order, measured, *_changed(order, values))
        except IlmekError:
            return np.full(sum(one.measured.x.size for one in before), 10.0)
        return np.concatenate(
            [
                np.nan_to_num((one.measured.y - one.model) / span, nan=0.0)
                for one, span in zip(curves, spans, strict=True)
            ]
        )

    found = fitted(residuals, start, (bounds[:, 0], bounds[:, 1]))
    params, shift = _changed(order, found.values)
    after = compared(order, measured, params, shift)
    names = (*order.fit, *(("shift",) if order.align else ()))
    rows = [
        (name, own, value, deviation, known[name].unit if name in known else before[0].measured.units[0].symbol)
        for name, own, value, deviation in zip(
            names, start.tolist(), found.values.tolist(), found.deviations.tolist(), strict=True
        )
    ]
    return _report(order, before, after, rows)


def _bounds(parameter: Parameter) -> tuple[float, float]:
    """Between which values of a parameter a fit looks."""
    low = [bound for bound in (parameter.above, parameter.at_least) if bound is not None]
    high = [bound for bound in (parameter.below, parameter.at_most) if bound is not None]
    return max(low, default=-np.inf), min(high, default=np.inf)


def _changed(order: CompareOrder, values: FloatArray) -> tuple[Params, float]:
    """The parameters with values of those that are fitted, and the shift."""
    numbers = values.tolist()
    settings = dict(zip(order.fit, numbers, strict=False))
    return order.params.with_values(settings), numbers[-1] if order.align else 0.0


def compared(
    order: CompareOrder, measured: Sequence[MeasuredCurve], params: Params, shift: float
) -> tuple[ComparedCurve, ...]:
    """The curves beside those of the machine with parameters. Raises ParameterError for one that it does not have."""
    machine = order.machine
    figures = made_figures(lambda: machine.figures(machine.analysis(machine.designed(params))), [])
    plots = [figure for figure in figures if isinstance(figure, Plot)]
    return tuple(_compared(own, plots, machine.name, shift) for own in measured)


def _compared(own: MeasuredCurve, plots: Sequence[Plot], machine: str, shift: float) -> ComparedCurve:
    x_unit, y_unit = own.units
    fits = [
        (plot, series)
        for plot in plots
        for series in plot.series
        if parse_unit(plot.y.unit).dimension == y_unit.dimension
        and parse_unit(plot.x.unit).dimension == x_unit.dimension
    ]
    named = [(plot, one) for plot, one in fits if own.name in {one.label, f"{plot.name}: {one.label}"}]
    if len(named) != 1:
        known = "; ".join(f"{plot.name}: {one.label} [{plot.y.unit}] over {plot.x.label}" for plot, one in fits)
        many = "is the name of several curves" if named else "is no curve"
        raise ParameterError(
            f"{own.name!r} [{y_unit.symbol}] over [{x_unit.symbol}] {many} of {machine}",
            allowed=known or "; ".join(f"{plot.name} [{plot.y.unit}]" for plot in plots),
            do="name the column as one of them, with a unit of its kind",
        )
    ((plot, series),) = named
    curve = ComparedCurve(own, plot, series, shift)
    if not curve.difference.size:
        given = f"{own.name!r} has no sample where the model has a value"
        ends = " to ".join(format_quantity(float(end), plot.x.unit) for end in (series.x[0], series.x[-1]))
        raise ParameterError(given, allowed=f"{plot.x.label} {ends}", do="check the unit of the first column")
    return curve


def _report(
    order: CompareOrder,
    before: Sequence[ComparedCurve],
    after: Sequence[ComparedCurve] | None,
    rows: Sequence[tuple[str, float, float, float, str]],
) -> Report:
    judged = after or before
    results = (
        Result(
            "explained",
            {one.measured.name: one.explained if one.range else None for one in judged},
            "%",
            "share of the measured variance that the model explains; null: it has none",
        ),
        Result("compared", [one.as_json() for one in before], "", "measured less model, curve by curve", shown=False),
        Result(
            "compared_fitted",
            None if after is None else [one.as_json() for one in after],
            "",
            "the same with the fitted parameters",
            shown=False,
            absent="nothing was fitted",
        ),
        Result(
            "fitted",
            {name: {"before": own, "value": value, "deviation": deviation if np.isfinite(deviation) else None}
             for name, own, value, deviation, _ in rows},
            "",
            "fitted parameters: before, value, standard deviation (null: the curves do not depend on it)",
            shown=False,
        ),
    )  # fmt: skip
    machine = order.machine
    return Report(
        machine.name,
        f"{machine.title}: measured and model",
        order.params.as_dict(),
        results,
        tuple(_checks(order, judged)),
        tables=tuple(_tables(before, after, rows)),
        figures=tuple(_figure(one, None if after is None else after[k]) for k, one in enumerate(before)),
        headline=("compared", "fitted"),
    )


def _checks(order: CompareOrder, curves: Sequence[ComparedCurve]) -> Iterator[Check]:
    for one in curves if order.within is not None else ():
        assert order.within is not None
        name = f"rms difference of {one.measured.name} over its range"
        check = at_most(name, one.rms / (one.range or 1.0), order.within, "%", "option --within")
        yield check.with_cure("fit parameters that are not known well, by --fit")


def _tables(
    before: Sequence[ComparedCurve],
    after: Sequence[ComparedCurve] | None,
    rows: Sequence[tuple[str, float, float, float, str]],
) -> Iterator[Table]:
    for number, one in enumerate(before, 1):
        unit, over = one.plot.y.unit, one.plot.x.unit
        heads = columns(
            f"model | samples | rms [{unit}] | rms over range [%] 3 | mean [{unit}] | greatest [{unit}]",
            f"at [{over}] | measured max [{unit}] | model max [{unit}]",
        )
        lines = {"as set": one} | ({} if after is None else {"fitted": after[number - 1]})
        shown = ((name, *curve.row) for name, curve in lines.items())
        name = "compared" if len(before) == 1 else f"compared-{number}"
        yield Table(name, f"{one.measured.name}: measured less model", heads, tuple(shown), brief=True)
    if rows:
        heads = columns("parameter | before | fitted | standard deviation")
        shown_rows = tuple(
            (name, *(format_quantity(value, unit) if np.isfinite(value) else "not determined" for value in values))
            for name, *values, unit in rows
        )
        yield Table("fitted", "Fitted parameters", heads, shown_rows, brief=True)


def _figure(before: ComparedCurve, after: ComparedCurve | None) -> Plot:
    """Measured points, the model as set, and fitted."""
    last = after or before
    order = np.argsort(last.at)
    series = [
        Series("measured", last.at[order], last.measured.y[order]),
        Series("model", before.series.x, before.series.y, dashed=True),
    ]
    if after is not None:
        series.append(Series("model, fitted", after.series.x, after.series.y, dashed=True))
    name = f"compared-{before.plot.name}"
    return replace(before.plot, name=name, title=f"{before.plot.title}: measured", series=tuple(series), marks=())
