"""Carpets: picture to knot chart, chart to files, the whole job."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ilmek.arrays import Rgb
from ilmek.carpet import chart as charting
from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality, parse_quality
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.errors import OutputError, PictureError
from ilmek.io import picture as pictures
from ilmek.io import yarn_file
from ilmek.io.chart.bmp import write_chart_bmp
from ilmek.io.chart.oxs import write_chart_oxs
from ilmek.io.chart.oxs_reading import is_oxs, read_chart_oxs
from ilmek.io.chart.pdf import write_chart_pdf
from ilmek.io.chart.png import read_chart_png, write_chart_png
from ilmek.io.output import Outputs
from ilmek.io.picture import Picture
from ilmek.jobs import weave as weaving
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_groups, read_order
from ilmek.jobs.weave import WeaveResult
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress

PNG_CHANNELS = 3


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
    density = parse_quality(quality) if isinstance(quality, str) else quality
    listed = read_yarns(yarns) if yarns is None or isinstance(yarns, str | Path) else tuple(yarns)
    chart = charting.make_chart(
        _pixels(picture),
        parse_size(size) if isinstance(size, str) else size,
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
    if isinstance(picture, Picture):
        return picture.rgb
    if not (isinstance(picture, np.ndarray) and picture.ndim == 3 and picture.shape[2] == PNG_CHANNELS):
        given = f"{picture.shape} pixels" if isinstance(picture, np.ndarray) else f"a {type(picture).__name__}"
        raise PictureError(f"{given} given for a picture", allowed="a path, a picture, or rows x columns x 3 bytes")
    if picture.dtype != np.uint8:
        raise PictureError(
            f"pixels of type {picture.dtype}", allowed="uint8, 0 to 255", do="(255 * rgb).astype('uint8')"
        )
    return picture


def write_chart(path: str | Path, chart: Chart) -> None:
    """Write a chart as .png (one pixel one knot), .bmp (the same, without its facts), .oxs (for cross-stitch programs)
    or .pdf (with symbols and row numbers).

    An existing file is replaced, whole or not at all.
    Raises OutputError for another ending, and if the file cannot be written.
    """
    path = Path(path)
    writers: dict[str, Callable[[Path, Chart], None]] = {
        ".png": write_chart_png,
        ".bmp": write_chart_bmp,
        ".oxs": write_chart_oxs,
        ".pdf": write_chart_pdf,
    }
    if path.suffix.lower() not in writers:
        raise OutputError(f"chart {path} ends in {path.suffix!r}", allowed=f"one of {', '.join(writers)}")
    with Outputs(force=True) as outputs, outputs.file(path) as work:
        writers[path.suffix.lower()](work, chart)


def read_chart(path: str | Path) -> Chart:
    """The chart of a .png or .oxs written by `write_chart` or a job, as it was; an .oxs may be of another program.

    Raises PictureError, and CarpetError for an .oxs that no carpet of the usual quality has the grid of.
    """
    path = Path(path)
    return read_chart_oxs(path)[0] if is_oxs(path) else read_chart_png(path)


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
