"""Carpets: picture to knot chart, chart to files, the whole job."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from ilmek.arrays import Rgb
from ilmek.carpet import chart as charting
from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality, carpet_quality
from ilmek.carpet.sizes import CarpetSize, carpet_size
from ilmek.carpet.yarn import Yarn, yarn_list
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError, shortened
from ilmek.io import picture as pictures
from ilmek.io import yarn_file
from ilmek.io.chart import formats
from ilmek.io.output import Outputs
from ilmek.io.picture import Picture
from ilmek.jobs import weave as weaving
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_groups, read_order
from ilmek.jobs.weave import WeaveResult
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress


def read_picture(path: str | Path) -> Picture:
    """The picture in a file as sRGB: `rgb` of shape rows x columns x 3, and `notes` on conversions.

    Raises PictureError where there is no picture that can be read.
    """
    return pictures.read_picture(Path(path))


def read_yarns(path: str | Path | None = None) -> tuple[Yarn, ...]:
    """The yarns of a TOML or CSV list; default: the wool list that is built in. Raises YarnError."""
    return yarn_file.default_yarns() if path is None else yarn_file.read_yarns(Path(path))


def make_chart(
    picture: str | Path | Picture | Rgb,
    size: str | CarpetSize,
    quality: str | Quality,
    yarns: str | Path | Sequence[Yarn] | None = None,
    *,
    knot: str = "symmetric",
    progress: Progress = SILENT,
    **settings: Setting,
) -> Chart:
    """The knot chart of a picture.

    picture  a path, a picture, or its pixels: rows x columns x 3, 0 to 255
    size     like "120x180cm" or "seccade"      quality  like "40x40/dm"
    yarns    a path or a list; default: the wool list that is built in      knot  "symmetric" or "asymmetric"
    settings  of the fit, the reading, the palette and the counts of the yarns, by the names of the command line's
              options: colours=8

    Raises PictureError, CarpetError or YarnError; Cancelled.
    """
    groups = read_groups(settings)
    density, knot = carpet_quality(quality), parse_knot(knot)
    listed = read_yarns(yarns) if yarns is None or isinstance(yarns, str | Path) else yarn_list(yarns, 2)
    chart = charting.make_chart(
        _pixels(picture),
        carpet_size(size),
        density,
        groups["plan"].counted(listed, density, knot),
        knot=knot,
        fit=groups["fit"],
        reading=groups["reading"],
        palette=groups["palette"],
        progress=progress,
    )
    return charting.used_first(chart)


def _pixels(picture: str | Path | Picture | Rgb) -> Rgb:
    if isinstance(picture, str | Path):
        return read_picture(picture).rgb
    return picture.rgb if isinstance(picture, Picture) else pictures.pixels_of(picture)


def write_chart(path: str | Path, chart: Chart) -> None:
    """Write a chart in the format of the ending: .png (one pixel one knot, with all facts), .pdf (with symbols and row
    numbers), or one for other programs; another ending is an error that names them all.

    An existing file is replaced, whole or not at all.
    Raises OutputError for another ending, and if the file cannot be written; CarpetError for what is no chart, and for
    more knots than the format has.
    """
    path = Path(path)
    if not isinstance(chart, Chart):
        raise CarpetError(f"the chart is {shortened(repr(chart))}", allowed="a Chart")
    chosen = formats.format_by_ending(path)
    with Outputs(force=True) as outputs, outputs.file(path) as work:
        chosen.save(work, chart)


def read_chart(path: str | Path) -> Chart:
    """The chart of a file that `write_chart` or a job wrote with all facts, as it was, or of a chart program.

    Raises PictureError for what is no chart, and CarpetError for a grid that no carpet of the usual quality has.
    """
    return formats.read_chart(Path(path))[0]


def weave(
    picture: str | Path,
    out: str | Path,
    *,
    size: str | None = None,
    quality: str | None = None,
    knot: str | None = None,
    yarns: str | Path | None = None,
    heads: int | None = None,
    deadline: str | None = None,
    aim: str | None = None,
    warp_pitch: Setting = None,
    loom: Mapping[str, Setting] = MappingProxyType({}),
    loom_file: str | Path | None = None,
    force: bool = False,
    progress: Progress = SILENT,
    **settings: Setting,
) -> WeaveResult:
    """Picture to chart, yarn, loom, programme and report in the folder `out`, whole or not at all.

    size, quality, knot, yarns  as of `make_chart`; `yarns` is a path; default: those of a chart, else 120 x 180 cm, 25
                     knots/dm, symmetric and the wool list
    heads, deadline  knotting heads; time for the whole carpet, like "72h"; default: chosen by aim; any time
    aim              "price" or "time": what is least in the choice of all that is left open; default: price
    warp_pitch       distance of two warps; default: that of the quality
    loom             parameters of the loom by name, those of its machines dotted: {"shedding.law": "modified-sine"}
    loom_file        of a loom that exists, written by `weave` as machine.json or by `ilmek design --json`
    force            replace a folder that ilmek made

    settings         further options of the command line by name: colours=8, pile_height="6mm"

    Settings are texts with units or numbers in SI. Where the loom cannot weave the carpet, `weaves` of the result is
    False, its `checks` have the reasons, and there is no programme. Raises any IlmekError; then nothing is written;
    Cancelled.
    """
    order = read_order(
        Path(picture),
        size=size,
        quality=quality,
        knot=knot,
        yarn_file=None if yarns is None else Path(yarns),
        pdf=None,
        **settings,
    )
    wanted = read_loom_order(
        order,
        heads=heads,
        deadline=deadline,
        aim=aim,
        warp_pitch=warp_pitch,
        loom=loom,
        loom_file=None if loom_file is None else Path(loom_file),
    )
    return weaving.weave(order, wanted, Path(out), force=force, progress=progress)
