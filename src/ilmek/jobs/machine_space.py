"""A machine's parts in space as a GLB file, moved by its drive."""

from ilmek.io.glb import glb_bytes
from ilmek.part.space import frames_of, parts_of
from ilmek.part.tree import Tree
from ilmek.report import Report
from ilmek.report.scene import Assembly

PERIOD = 4.0
"""Time of a turn of every drive in the file [s]: slow enough to be watched."""


def machine_glb(tree: Tree, report: Report) -> bytes:
    """A machine's parts as GLB, in the axes of its tree, with an animation for each drive of its bodies."""
    frames = frames_of(tree, "")
    drives = dict.fromkeys(frame.motion.drive for frame in frames if frame.motion is not None)
    parts = parts_of(tree, report.machine, checks=report.checks)
    return glb_bytes(Assembly(report.title, frames, parts, dict.fromkeys(drives, PERIOD)))
