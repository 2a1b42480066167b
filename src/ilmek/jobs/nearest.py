"""The nearest carpets that a loom could weave, in the report of one that cannot weave what is required."""

from dataclasses import replace

from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams
from ilmek.machines.automated_loom.nearest import nearest_fits
from ilmek.progress import SILENT, Progress
from ilmek.report import NEAREST, Report, Result

_MEANING = "nearest quality, width or knot that the loom could weave, each with all other wishes kept"


def with_nearest(report: Report, params: object, progress: Progress = SILENT) -> Report:
    """A loom's report with the result `nearest`, a list of wish and value; empty where it weaves.

    params  of the loom as the user gave them. The report of any other machine is returned as it is.
    """
    if report.machine != MACHINE.name or not isinstance(params, AutomatedLoomParams):
        return report
    fits = nearest_fits(params, progress) if report.failed else ()
    found = [{"wish": fit.wish, "value": fit.value} for fit in fits]
    results = (*report.results, Result(NEAREST, found, "", _MEANING, shown=False))
    return replace(report, results=results, headline=(*report.headline, NEAREST))
