"""Carpets: picture to knot chart, chart to files, the whole job."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from ilmek.arguments import Arguments, Quantity
from ilmek.arrays import Rgb
from ilmek.carpet import chart_making
from ilmek.carpet.chart import Chart, used_first
from ilmek.carpet.quality import Quality, carpet_quality
from ilmek.carpet.sizes import AUTO, CarpetSize
from ilmek.carpet.yarn import Yarn, yarn_list
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError, OutputError, ParameterError, PictureError, YarnError
from ilmek.io import picture as pictures
from ilmek.io import yarn_file
from ilmek.io.chart import formats
from ilmek.io.output import Outputs
from ilmek.io.picture import Picture
from ilmek.jobs import weave as weaving
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import QUALITY, read_groups, read_order, read_size
from ilmek.jobs.weave import WeaveResult
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject

T = TypeVar("T")

PictureLike = str | Path | Picture | Rgb
"""A picture, its path, or its pixels: rows x columns x 3, 0 to 255."""

YarnsLike = str | Path | Sequence[Yarn] | None
"""Yarns, the path of their list, or "wool": the list that is built in; None: the picture's own shades."""

Settings = Mapping[str, Setting]
"""Values by name: texts with units, or numbers in SI."""


def read_picture(path: str | Path) -> Picture:
    """The picture in a file as sRGB: `rgb` of shape rows x columns x 3, and `notes` on conversions.

    Raises PictureError where there is no picture that can be read.

    >>> read_picture("examples/medallion.png").rgb.shape[2]
    3
    """
    return pictures.read_picture(Arguments("a picture", PictureError).path("path", path))


def read_yarns(path: str | Path | None = None) -> tuple[Yarn, ...]:
    """The yarns of a TOML or CSV list; default: the wool list that is built in. Raises YarnError.

    >>> len({yarn.name for yarn in read_yarns()}) == len(read_yarns())
    True
    """
    if path is None:
        return yarn_file.default_yarns()
    return yarn_file.read_yarns(Arguments("a yarn list", YarnError).path("path", path))


def make_chart(
    picture: PictureLike,
    size: str | CarpetSize = AUTO,
    quality: str | Quality = QUALITY,
    yarns: YarnsLike = None,
    *,
    knot: str = "symmetric",
    progress: Progress = SILENT,
    **settings: Setting,
) -> Chart:
    """The knot chart of a picture.

    picture  a path, a picture, or its pixels: rows x columns x 3, 0 to 255
    size     like "120x180cm", "seccade" or "120cmxauto"; "auto": in the shape of the picture
    quality  like "40x40/dm"
    yarns    a path, a list, or "wool": the list that is built in; default: the picture's own shades, which are wools of
             that list where one is near      knot  "symmetric" or "asymmetric"
    settings  of the fit, the reading, the palette and the counts of the yarns, by the names of the command line's
              options: colours=8, read="photo"

    Raises PictureError, CarpetError or YarnError; Cancelled.

    >>> chart = make_chart("examples/medallion.png", "30x40cm", "10x10/dm", colours=4)
    >>> chart.rows, chart.columns, chart.colours, sum(chart.counts)
    (40, 30, 4, 1200)
    """
    stated, sides = read_size(size, settings)
    groups = read_groups({**settings, **sides})
    density, knot = carpet_quality(quality), parse_knot(knot)
    listed = read_yarns(yarns) if yarns is None or isinstance(yarns, str | Path) else yarn_list(yarns, 2)
    chart = chart_making.make_chart(
        _pixels(picture, groups["fit"].ground),
        stated,
        density,
        groups["plan"].counted(listed, density, knot),
        dyed=yarns is None,
        knot=knot,
        fit=groups["fit"],
        reading=groups["reading"],
        palette=groups["palette"],
        progress=Arguments("a chart", CarpetError).record("progress", progress, Progress),
    )
    return used_first(chart)


def _pixels(picture: PictureLike, ground: str | None) -> Rgb:
    if isinstance(picture, str | Path):
        path = Arguments("a picture", PictureError).path("path", picture)
        return pictures.read_picture(path, ground=ground).rgb
    return picture.rgb if isinstance(picture, Picture) else pictures.pixels_of(picture)


def write_chart(path: str | Path, chart: Chart) -> None:
    """Write a chart in the format of the ending: .png (one pixel one knot, with all facts), .pdf (with symbols and row
    numbers), or one for other programs; another ending is an error that names them all.

    An existing file is replaced, whole or not at all.
    Raises OutputError for another ending, and if the file cannot be written; CarpetError for what is no chart, and for
    more knots than the format has.

    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "chart.oxs"
    >>> chart = make_chart("examples/medallion.png", "30x40cm", "10x10/dm", colours=4)
    >>> write_chart(path, chart)
    >>> read_chart(path).counts == chart.counts
    True
    """
    path = Arguments("a chart file", OutputError).path("path", path)
    Arguments("a chart file", CarpetError).record("chart", chart, Chart)
    chosen = formats.format_by_ending(path)
    with Outputs(force=True) as outputs, outputs.file(path) as work:
        chosen.save(work, chart)


def read_chart(path: str | Path, *, ground: str | None = None) -> Chart:
    """The chart of a file that `write_chart` or a job wrote with all facts, as it was, or of a chart program.

    ground  colour of the knots in cells without a stitch, like #e8dfc8; default: such a chart is refused
    Raises PictureError for what is no chart, and CarpetError for a grid that no carpet of the usual quality has.

    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "chart.png"
    >>> write_chart(path, make_chart("examples/medallion.png", "30x40cm", "10x10/dm", colours=4))
    >>> read_chart(path).colours
    4
    """
    return formats.read_chart(Arguments("a chart file", PictureError).path("path", path), ground=ground)[0]


def weave(
    picture: str | Path,
    out: str | Path,
    *,
    size: str | None = None,
    quality: str | None = None,
    knot: str | None = None,
    yarns: str | Path | None = None,
    heads: int | None = None,
    deadline: Quantity | None = None,
    aim: str | None = None,
    warp_pitch: Setting = None,
    loom: Settings = MappingProxyType({}),
    loom_file: str | Path | None = None,
    force: bool = False,
    progress: Progress = SILENT,
    **settings: Setting,
) -> WeaveResult:
    """Picture to chart, yarn, loom, programme and report in the folder `out`, whole or not at all.

    size, quality, knot, yarns  as of `make_chart`; `yarns` is a path; default: those of a chart, else a size in the
                     shape of the picture, 25 knots/dm, symmetric and the picture's own shades
    heads, deadline  knotting heads; time for the whole carpet [s], like "72h"; default: chosen by aim; any time
    aim              "cost" of a carpet, "price" of the loom or "time": what is least in the choice of all that is left
                     open; default: cost
    warp_pitch       distance of two warps; default: that of the quality
    loom             parameters of the loom by name, those of its machines dotted: {"shedding.law": "modified-sine"}
    loom_file        of a loom that exists, written by `weave` as machine.json or by `ilmek design --json`
    force            replace a folder that ilmek made

    settings         further options of the command line by name: colours=8, pile_height="6mm"

    Settings are texts with units or numbers in SI. Where the loom cannot weave the carpet, `weaves` of the result is
    False, its `checks` have the reasons, and there is no programme. Raises any IlmekError; then nothing is written;
    Cancelled.

    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp()) / "carpet"
    >>> small = {"size": "30x40cm", "quality": "10x10/dm", "least_detail": "40%"}  # 1,200 knots lose half of the detail
    >>> woven = weave("examples/medallion.png", folder, heads=1, **small)
    >>> woven.weaves, (folder / "programme.ilmek").exists()
    (True, True)
    """
    given = Arguments("a carpet")
    if "yarn_file" in settings:
        raise ParameterError("unknown parameter 'yarn_file' of a carpet", do="did you mean 'yarns'?")
    further: JsonObject = settings
    order = read_order(
        given.path("picture", picture),
        size=_optional(given.text, "size", size),
        quality=_optional(given.text, "quality", quality),
        knot=_optional(given.text, "knot", knot),
        yarn_file=_optional(given.path, "yarns", yarns),
        **further,
    )
    wanted = read_loom_order(
        order,
        heads=_optional(given.whole, "heads", heads),
        deadline=deadline if deadline is None or isinstance(deadline, str) else _seconds(given, deadline),
        aim=_optional(given.text, "aim", aim),
        warp_pitch=warp_pitch,
        loom=given.mapping("loom", loom, lambda _, value: value),
        loom_file=_optional(given.path, "loom_file", loom_file),
    )
    folder, replace = given.path("out", out), given.flag("force", force)
    return weaving.weave(order, wanted, folder, force=replace, progress=given.record("progress", progress, Progress))


def _optional(read: Callable[[str, object], T], name: str, value: object) -> T | None:
    return None if value is None else read(name, value)


def _seconds(given: Arguments, deadline: object) -> str:
    return f"{given.number('deadline', deadline, 's')!r}s"
