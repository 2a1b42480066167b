"""Carpets by a tufting machine or a tufting gun, kilims, and measurements of machines."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType

from ilmek.api.carpets import Settings
from ilmek.arguments import Arguments, Quantity
from ilmek.jobs import compare as comparing
from ilmek.jobs.gun import GunResult, read_gun_order, weave_by_gun
from ilmek.jobs.kilim import KilimResult, read_kilim_order, weave_kilim
from ilmek.jobs.order import CarpetOrder, read_order
from ilmek.jobs.tufting import TuftingResult, read_tufting_order, weave_by_tufting
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import Report

TECHNIQUES = ("tufting", "gun")


def tuft(
    picture: str | Path,
    out: str | Path,
    *,
    technique: str = "tufting",
    size: str | None = None,
    yarns: str | Path | None = None,
    deadline: Quantity | None = None,
    machine: Settings = MappingProxyType({}),
    force: bool = False,
    progress: Progress = SILENT,
    **settings: Setting,
) -> TuftingResult | GunResult:
    """Picture to a tufting machine and its programme, or to the path of a tufting gun, in the folder `out`.

    technique        "tufting": needles in a bar, tufted by a twin; "gun": a gun on a gantry
    size, yarns      as of `weave`                           deadline  time for the whole carpet [s], like "2h"
    machine          parameters of the machine, or of gun and gantry, by name: {"pattern.selection": "needles"}
    force            replace a folder that ilmek made
    settings         further options of the command line by name: colours=5

    Settings are texts with units or numbers in SI. Where it cannot be tufted, the `checks` of the result have the
    reasons, and there is no programme. Raises any IlmekError; then nothing is written; Cancelled.

    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp()) / "carpet"
    >>> made = tuft("examples/medallion.png", folder, technique="gun", size="40x60cm", colours=2)
    >>> made.tufted.row_length >= made.tufted.row_bound > 0
    True
    """
    given = Arguments("a carpet")
    order, limit = _order(given, picture, size, yarns, settings), _limit(given, deadline)
    own = given.mapping("machine", machine, lambda _, value: value)
    folder, replace = given.path("out", out), given.flag("force", force)
    on = given.record("progress", progress, Progress)
    if given.one_of("technique", technique, TECHNIQUES) == "gun":
        return weave_by_gun(order, read_gun_order(order, own, limit), folder, force=replace, progress=on)
    return weave_by_tufting(order, read_tufting_order(order, own, limit), folder, force=replace, progress=on)


def kilim(
    picture: str | Path,
    out: str | Path,
    *,
    size: str | None = None,
    yarns: str | Path | None = None,
    deadline: Quantity | None = None,
    cloth: Settings = MappingProxyType({}),
    force: bool = False,
    progress: Progress = SILENT,
    **settings: Setting,
) -> KilimResult:
    """Picture to a kilim, woven by hand of wefts that turn back at their colours, in the folder `out`.

    cloth            its parameters by name: {"warps": "50/dm", "picks": "200/dm", "join": "dovetail"}
    others           as of `tuft`

    Where a slit is too long, the `checks` of the result name it, and there are no rows. Raises any IlmekError; then
    nothing is written; Cancelled.

    >>> import tempfile
    >>> made = kilim("examples/medallion.png", Path(tempfile.mkdtemp()) / "kilim", size="40x60cm", colours=2)
    >>> made.cloth.chart.rows * made.cloth.chart.columns > 10_000
    True
    """
    given = Arguments("a kilim")
    order, limit = _order(given, picture, size, yarns, settings), _limit(given, deadline)
    wanted = read_kilim_order(order, given.mapping("cloth", cloth, lambda _, value: value), limit)
    folder, replace = given.path("out", out), given.flag("force", force)
    return weave_kilim(order, wanted, folder, force=replace, progress=given.record("progress", progress, Progress))


def _order(
    given: Arguments, picture: str | Path, size: str | None, yarns: str | Path | None, settings: Settings
) -> CarpetOrder:
    further: JsonObject = dict(settings)
    return read_order(
        given.path("picture", picture),
        size=None if size is None else given.text("size", size),
        yarn_file=None if yarns is None else given.path("yarns", yarns),
        **further,
    )


def _limit(given: Arguments, deadline: Quantity | None) -> str | None:
    if deadline is None or isinstance(deadline, str):
        return deadline
    return f"{given.number('deadline', deadline, 's')!r}s"


def compare(
    file: str | Path,
    machine: str,
    *,
    settings: Settings = MappingProxyType({}),
    fit: Sequence[str] = (),
    align: bool = False,
    within: float | None = None,
    progress: Progress = SILENT,
) -> Report:
    """Measured curves of a CSV file beside those of a machine's figures: differences, and parameters fitted.

    settings  of the machine by name      fit  names of parameters to fit, from their values
    align     find the shift of the first column too      within  allowed rms difference over a curve's range; a check

    Raises ParameterError for a file, a curve or a parameter that is none; errors of the design; Cancelled.

    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "measured.csv"
    >>> rows = ["crank angle [deg], main shaft [N*m]", "30, 13.9", "60, 10.8", "90, 4.4", "150, 9.3", "210, -0.6"]
    >>> written = path.write_text(chr(10).join(rows))
    >>> report = compare(path, "tufting", fit=["friction_force"])
    >>> 750 < report["fitted"]["friction_force"]["value"] < 850
    True
    """
    given = Arguments("a comparison")
    order = comparing.read_compare_order(
        given.path("file", file),
        given.text("machine", machine),
        given.mapping("settings", settings, lambda _, value: value),
        fit=given.sequence("fit", fit, str),
        align=given.flag("align", align),
        within=None if within is None else given.not_negative("within", within, "1"),
    )
    return comparing.compare(order, given.record("progress", progress, Progress))
