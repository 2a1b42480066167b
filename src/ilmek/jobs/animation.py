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
from ilmek.viz.looks import looked


def write_animation(
    report: Report, path: Path, outputs: Outputs, progress: Progress, *, motion: str | None = None
) -> None:
    """Stage a motion that a report shows.

    motion  name of the figure; default: the first one of the machine itself, else of the machines in it
    Raises ParameterError where nothing moves, and for an unknown motion; OutputError; Cancelled.
    """
    found = {animation.name: animation for animation in reversed(list(_moving(report)))}
    if not found:
        raise ParameterError(f"--animation {path}: {report.title} shows no motion", do="leave --animation out")
    name = motion or list(found)[-1]
    if name not in found:
        raise ParameterError(f"--motion {name}", allowed=f"one of {', '.join(reversed(found))}")
    frames = _counted(pictures(found[name]), progress)
    if path.suffix.lower() == GIF:
        outputs.write(path, gif(frames, RATE, COLOURS))
        return
    with outputs.file(path) as staged:
        write_mp4(staged, frames, RATE)


def _moving(report: Report) -> Iterator[Animation]:
    """The figures that move, with the looks that they have in their report; those of the machine itself first."""
    yield from (figure for figure in looked(report.figures) if isinstance(figure, Animation))
    for child in report.children:
        yield from _moving(child)


def _counted(frames: Iterator[Image.Image], progress: Progress) -> Iterator[Image.Image]:
    for number, frame in enumerate(frames):
        progress(number / PICTURES)
        yield frame
