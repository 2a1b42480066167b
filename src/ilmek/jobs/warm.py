"""Compile the kernels before the first real job: `python -m ilmek.jobs.warm`.

A kernel is compiled at its first call and kept in the user's cache folder (`ilmek.num.machine_code`). After installing
from a checkout this job weaves a carpet of a few knots, so that the first carpet does not wait. When the package is
built, `python -m ilmek.jobs.warm --into ARCHIVE` does all jobs that use kernels, for the oldest processor that is
served, and packs the machine code for the wheel (`ilmek.num.installed_kernels`).
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageOps

from ilmek.io.output import Outputs
from ilmek.io.picture import read_picture
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.jobs.check import check_programme
from ilmek.jobs.convert import convert_programme
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_order
from ilmek.jobs.simulate import SimulationOrder, simulate
from ilmek.jobs.weave import weave
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.twin.faults import StopParams
from ilmek.machines.motion_four_bar import MotionFourBarParams
from ilmek.machines.motion_four_bar import design as motion_four_bar
from ilmek.machines.path_four_bar import PathFourBarParams
from ilmek.machines.path_four_bar import design as path_four_bar
from ilmek.num.compiled import COMPILATIONS
from ilmek.num.installed_kernels import compiler_settings, pack
from ilmek.num.machine_code import INNER
from ilmek.num.private_files import ENTRY

EACH = 50
"""Kernels from line to line."""

COLOURS = (
    *("#8f1d21", "#5c1218", "#1f2a52", "#3e5c94", "#86a8c8", "#efe6d0"),
    *("#23201f", "#d8b24a", "#b9862f", "#77875a", "#c98a86", "#b5613c"),
)
"""Of the drawing: as many as the example's, so that more yarns than tubes are planned."""


def warm() -> float:
    """Weave a drawing of 48 x 48 knots. Returns the weaving time [s]."""
    with tempfile.TemporaryDirectory() as folder:
        picture, file = Path(folder) / "drawing.png", Path(folder) / "again.ilmek"
        drawing().save(picture)
        _weave_into(file, picture, "48x48cm")
        with open_programme(file) as programme:
            return programme.totals.duration


def warm_all() -> None:
    """Do each kind of job that uses kernels, on small input: weave, simulate, convert, check, search four-bars."""
    warm()
    path_four_bar(PathFourBarParams(starts=1))
    motion_four_bar(MotionFourBarParams(keep_out="(200mm,200mm) (300mm,300mm)"))
    noise = np.random.default_rng(1).integers(0, 256, (24, 24, 3), dtype=np.uint8)
    with tempfile.TemporaryDirectory() as folder:
        picture, photo = Path(folder) / "noise.png", Path(folder) / "noise.jpg"
        file, text = Path(folder) / "again.ilmek", Path(folder) / "again.txt"
        for path in (picture, photo):
            Image.fromarray(noise).save(path)
        read_picture(photo)
        _weave_into(file, picture, "16x16cm", colours=8)
        simulate(SimulationOrder(file, StopParams(gripper_miss=0.1, weft_break=0.1), seeds=5))
        with Outputs() as outputs:
            convert_programme(file, text, outputs=outputs)
        check_programme(text)


def show_compilations() -> None:
    """Write a line on every EACH-th kernel that is compiled: all of them take minutes."""

    def show(number: int) -> None:
        if number % EACH == 0:
            sys.stdout.write(f"  {number} kernels compiled\n")
            sys.stdout.flush()

    COMPILATIONS.listener = show


def drawing() -> Image.Image:
    """A drawing in flat colours with mixed edges, symmetric about both axes: stripes, discs, dots and thin lines."""
    side = 16 * 48
    picture = Image.new("RGB", (side, side), COLOURS[0])
    pen = ImageDraw.Draw(picture)
    for index, colour in enumerate(COLOURS[1:]):
        inset = 28 * index
        shape = pen.ellipse if index % 2 else pen.rectangle
        shape((inset, inset, side - 1 - inset, side - 1 - inset), fill=colour, outline=COLOURS[5], width=10)
    half = picture.crop((0, 0, side // 2, side // 2))
    pen = ImageDraw.Draw(half)
    for step in range(6):
        pen.line((8, 60 * step, 300, 60 * step + 42), fill=COLOURS[step], width=12)
        pen.rectangle((60 * step + 18, 300, 60 * step + 33, 315), fill=COLOURS[-1 - step])
    for turned in (half, ImageOps.mirror(half)):
        left = 0 if turned is half else side // 2
        picture.paste(turned, (left, 0))
        picture.paste(ImageOps.flip(turned), (left, side // 2))
    return picture.resize((side // 2, side // 2), Image.Resampling.BOX)


def _weave_into(file: Path, picture: Path, size: str, colours: int | None = None) -> None:
    """Weave a picture into a folder beside it, and write the programme; the job does so only where the loom weaves."""
    order = read_order(picture, size=size, quality="10x10/dm", colours=colours)
    loom = weave(order, read_loom_order(order, deadline="100h"), picture.parent / "out").loomed
    assert loom.programme is not None
    assert loom.setup is not None
    write_programme(file, CompiledProgramme(loom.setup, loom.programme))


def compile_into(archive: Path) -> int:
    """Compile every kernel for the baseline processor in a new process, into an archive. Returns their number.

    Raises KeyError for an architecture without installed kernels.
    """
    import llvmlite.binding

    settings = compiler_settings(llvmlite.binding.get_default_triple())
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, **settings, "XDG_CACHE_HOME": folder, "ILMEK_INSTALLED_KERNELS": "no"}
        subprocess.run([sys.executable, "-m", "ilmek.jobs.warm", "--all"], env=environment, check=True)
        return pack((entry for entry in Path(folder).rglob(f"*{ENTRY}") if not entry.name.endswith(INNER)), archive)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--all", action="store_true", help="every kind of job, not weaving alone")
    parser.add_argument("--into", type=Path, metavar="ARCHIVE", help="pack the kernels for the wheel")
    options = parser.parse_args()
    if options.into:
        sys.stdout.write(f"{compile_into(options.into)} kernels in {options.into}\n")
    elif options.all:
        show_compilations()
        warm_all()
    else:
        warm()
