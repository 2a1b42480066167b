"""The motion that a report shows, as a GIF or an MP4 file."""

from collections.abc import Iterator
from pathlib import Path

from PIL import Image

from ilmek.errors import ParameterError
from ilmek.io.moving_picture import gif, write_mp4
from ilmek.io.output import Outputs
from ilmek.jobs.animation_order import GIF
from ilmek.progress import Progress
from ilmek.report import Animation, Report
from ilmek.viz.animation_frames import COLOURS, PICTURES, RATE, pictures
from ilmek.viz.looks import looks_of


def write_animation(report: Report, path: Path, outputs: Outputs, progress: Progress) -> None:
    """Stage the first motion that a report shows, that of the machine itself before those of the machines in it.

    Raises ParameterError where nothing moves; OutputError; Cancelled.
    """
    found = _first(report)
    if found is None:
        raise ParameterError(f"--animation {path}: {report.title} shows no motion", do="leave --animation out")
    owner, animation = found
    frames = _counted(pictures(animation, looks_of(owner.figures)), progress)
    if path.suffix.lower() == GIF:
        outputs.write(path, gif(frames, RATE, COLOURS))
        return
    with outputs.file(path) as staged:
        write_mp4(staged, frames, RATE)


def _first(report: Report) -> tuple[Report, Animation] | None:
    """The first figure that moves, and the report that shows it."""
    for figure in report.figures:
        if isinstance(figure, Animation):
            return report, figure
    return next((found for child in report.children if (found := _first(child))), None)


def _counted(frames: Iterator[Image.Image], progress: Progress) -> Iterator[Image.Image]:
    for number, frame in enumerate(frames):
        progress(number / PICTURES)
        yield frame
