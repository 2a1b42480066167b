"""Compile the kernels once after installing: `python -m ilmek.jobs.warm`.

A kernel is compiled at its first call and kept in the user's cache folder (`ilmek.num.machine_code`). This job weaves a
carpet of a few knots into a temporary folder, simulates it, converts and checks it, and searches a four-bar for a path
and one for a motion, so that the first real job does not wait.
"""

import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

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


def warm() -> float:
    """Search a four-bar for one path and one motion, and weave 16 x 16 knots of noise. Returns the weaving time [s]."""
    path_four_bar(PathFourBarParams(starts=1))
    motion_four_bar(MotionFourBarParams(keep_out="(200mm,200mm) (300mm,300mm)"))
    noise = np.random.default_rng(1).integers(0, 256, (24, 24, 3), dtype=np.uint8)
    with tempfile.TemporaryDirectory() as folder:
        picture, out = Path(folder) / "noise.png", Path(folder) / "out"
        Image.fromarray(noise).save(picture)
        Image.fromarray(noise).save(Path(folder) / "noise.jpg")
        read_picture(Path(folder) / "noise.jpg")
        order = read_order(picture, size="16x16cm", quality="10x10/dm", colours=8)
        woven = weave(order, read_loom_order(order, deadline="100h"), out)
        made, setup = woven.loomed.programme, woven.loomed.setup
        assert made is not None
        assert setup is not None
        # The loom's own is written only where it weaves.
        write_programme(out / "again.ilmek", CompiledProgramme(setup, made))
        simulate(SimulationOrder(out / "again.ilmek", StopParams(gripper_miss=0.1, weft_break=0.1), seeds=5))
        with Outputs() as outputs:
            convert_programme(out / "again.ilmek", out / "again.txt", outputs=outputs)
        check_programme(out / "again.txt")
        with open_programme(out / "again.ilmek") as programme:
            return programme.totals.duration


if __name__ == "__main__":
    warm()
