"""Pictures of a project: taken by their content, deleted."""

from dataclasses import dataclass
from itertools import count
from pathlib import Path, PurePosixPath

from ilmek.errors import ParameterError, shortened
from ilmek.io.chart.formats import FORMATS
from ilmek.io.output import disk
from ilmek.io.rendered.kind import drawing_endings, rendered
from ilmek.io.rendered.resolution import Rendering
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.folder import PICTURES, ProjectFolder, cannot, check_name, read_bytes, write_bytes
from ilmek.jobs.studio.project.tasks import Changed, PathRequest, PictureSummary

LARGEST_PICTURE = 45_000_000
"""Largest size of a picture that the studio takes [bytes]; a larger one is copied into the folder."""

BEGINS = {
    b"\x89PNG\r\n\x1a\n": (".png",),
    b"\xff\xd8\xff": (".jpg", ".jpeg"),
    b"GIF8": (".gif",),
    b"BM": (".bmp",),
    b"II*\0": (".tif", ".tiff"),
    b"MM\0*": (".tif", ".tiff"),
    b"\x0a\x05\x01": (".pcx",),
    b"\x0a\x03\x01": (".pcx",),
    b"qoif": (".qoi",),
}
"""Begins of the pictures that are taken, and the endings of their names."""

_SMALL = (64, 64)
"""Knots for which a drawing is rendered to see whether it can be."""

CHART_BEGIN = 65_536
"""Bytes by which a chart that is no picture is recognised."""


@dataclass(frozen=True, slots=True)
class UploadRequest:
    """A picture: the name of its file, and its bytes."""

    name: str
    content: bytes


def upload_picture(request: UploadRequest, context: Context) -> PictureSummary:
    """Put a picture into pictures/; its type is that of its content. A name that is taken gets a number.

    Raises ParameterError for what is no picture, or is too large; PictureError for a drawing that is damaged, or whose
    reader is not installed; OutputError.
    """
    folder = ProjectFolder(context.folder.resolve())
    content, name = request.content, PurePosixPath(request.name.replace("\\", "/")).name
    if len(content) > LARGEST_PICTURE:
        given = f"{shortened(name)} has {len(content):,} bytes"
        raise ParameterError(given, allowed=f"at most {LARGEST_PICTURE:,}", do=f"copy it into {PICTURES}/ yourself")
    endings = _endings(content)
    if not endings:
        given = f"{shortened(name) or 'the file'} is no picture that can be read"
        raise ParameterError(given, do="use a PNG, JPEG, TIFF, WebP, BMP, GIF, SVG, PDF or PSD file")
    # Refuses a damaged drawing, and one whose reader is not installed.
    rendered(Path(shortened(name)), content, Rendering(knots=_SMALL))
    stem, suffix = PurePosixPath(name).stem, PurePosixPath(name).suffix.lower()
    stem = "".join(sign if sign.isalnum() or sign in "_-" else "-" for sign in stem).strip("-_")[:60] or "picture"
    ending = suffix if suffix in endings else endings[0]
    with folder.locked():
        for number in count(1):
            path = f"{PICTURES}/{check_name(stem + (f'-{number}' if number > 1 else '') + ending)}"
            file = folder.path(path)
            if not file.exists():
                write_bytes(file, content)
                break
            if file.stat().st_size == len(content) and read_bytes(file, LARGEST_PICTURE) == content:
                break
    return PictureSummary(path, len(content))


def _endings(content: bytes) -> tuple[str, ...]:
    """The endings of a picture by its content; none: it is no picture."""
    if content[:4] == b"RIFF" and content[8:12] == b"WEBP":
        return (".webp",)
    if content[4:8] == b"ftyp" and content[8:12] in (b"avif", b"avis"):
        return (".avif",)
    if content.startswith(b"\0\0\0\x0cjP  \r\n\x87\n"):
        return (".jp2",)
    for begin, endings in BEGINS.items():
        if content.startswith(begin):
            return endings
    if drawn := drawing_endings(content):
        return drawn
    charts = (row for row in FORMATS.values() if row.read is not None and row.begins(content[:CHART_BEGIN]))
    return tuple(row.suffix for row in charts)[:1]


def delete_picture(request: PathRequest, context: Context) -> Changed:
    """Delete a picture. Raises ParameterError for another file, or where there is none."""
    folder = ProjectFolder(context.folder.resolve())
    path = folder.path(request.path)
    if path.parent != folder.base / PICTURES or not path.is_file():
        raise ParameterError(f"{request.path} is no file of {PICTURES}/")
    with folder.locked():
        try:
            disk.unlink(path)
        except OSError as error:
            raise cannot("be deleted", path, error) from None
    return Changed((request.path,))
