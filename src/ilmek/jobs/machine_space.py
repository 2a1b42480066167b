"""A machine's parts in space as files: GLB, moved by its drive; a STEP assembly at a pose; a model for MuJoCo."""

from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType

from ilmek.errors import ParameterError
from ilmek.io.glb import glb_bytes
from ilmek.io.mjcf import mjcf_text
from ilmek.part.bolting import bolted
from ilmek.part.space import frames_of, parts_of
from ilmek.part.tree import Tree
from ilmek.report import Report
from ilmek.report.scene import Assembly
from ilmek.units import parse_quantity

PERIOD = 4.0
"""Time of a turn of every drive in the file [s]: slow enough to be watched."""


def machine_glb(tree: Tree, report: Report) -> bytes:
    """A machine's parts as GLB, in the axes of its tree, with an animation for each drive of its bodies."""
    frames = frames_of(tree, "")
    drives = dict.fromkeys(frame.motion.drive for frame in frames if frame.motion is not None)
    parts = parts_of(tree, report.machine, checks=report.checks)
    return glb_bytes(Assembly(report.title, frames, parts, dict.fromkeys(drives, PERIOD)))


def machine_file(option: str, tree: Tree, report: Report, pose: str | None = None) -> bytes | str:
    """The content of the file of an option: `--glb`, `--step` or `--mjcf`; pose  as of `solids`."""
    tree = bolted(tree)
    return machine_glb(tree, report) if option == "--glb" else bodies_file(option, tree, report, pose)


def bodies_file(
    option: str,
    tree: Tree,
    report: Report,
    pose: str | None = None,
    periods: Mapping[str, float] = MappingProxyType({}),
) -> bytes | str:
    """A tree as a STEP assembly at a pose, or as a model for MuJoCo with the times of a turn of its drives [s].

    Raises ParameterError for a pose that is not DRIVE=ANGLE with a drive of the tree.
    """
    if option == "--mjcf":
        return mjcf_text(tree, report.title, periods)
    content: bytes = import_module("ilmek.io.step_assembly").assembly_bytes(tree, report.title, *_pose(tree, pose))
    return content


def _pose(tree: Tree, pose: str | None) -> tuple[str, float]:
    """A drive and its angle [rad]."""
    if pose is None:
        return "", 0.0
    drive, _, angle = pose.partition("=")
    drives = sorted({body.joint.motion.drive for body in tree.bodies if body.joint.motion is not None})
    if drive not in drives:
        allowed = " or ".join(f"{able}=ANGLE" for able in drives) or "no pose: nothing moves the parts"
        raise ParameterError(f"pose {pose!r}", allowed=allowed)
    return drive, parse_quantity(angle, "deg")
