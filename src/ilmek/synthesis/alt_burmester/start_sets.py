"""Shipped solutions of one general complex task of each kind, computed once by monodromy.

`python -m benchmarks four_bar_starts` computes them again.
"""

import hashlib
import io
from functools import cache
from importlib import resources

import numpy as np

from ilmek.errors import ParameterError
from ilmek.synthesis.alt_burmester.homotopy import SolvedTask, rotations_of, track

FILE = "four_bar_starts.npz"

CHECKSUM = "24340c2f7d693028de3af91eefd313e06bd5b2792b483815b486d3c657945cf0"
"""SHA-256 of the file."""

CLASSES = {5: 6, 4: 30, 3: 201, 2: 1112, 1: 1442}
"""Solutions by the number of poses; of one pose, nine points, one of each class of three cognates."""


@cache
def start_set(poses: int) -> SolvedTask:
    """The solutions for a number of poses, 1 to 5, to full accuracy.

    Raises ParameterError where the installed file is damaged.
    """
    content = resources.files("ilmek.data").joinpath(FILE).read_bytes()
    if hashlib.sha256(content).hexdigest() != CHECKSUM:
        raise ParameterError(f"the installed file {FILE} is damaged", do="install ilmek again")
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        task, unknowns = arrays[f"task{poses}"], arrays[f"unknowns{poses}"].astype(complex)
    pose = pose_mask(poses)
    begin = SolvedTask(pose, task, unknowns, rotations_of(unknowns, task, pose))
    return track(begin, task).solved  # the file has single precision: Newton's method gives the rest


def pose_mask(poses: int) -> np.ndarray:
    """Whether each position but the reference is a pose: poses come first."""
    points = 10 - 2 * poses
    return np.arange(poses - 1 + points) < poses - 1
