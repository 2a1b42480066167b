"""Tasks of synthesis that are not finished: fewer points, poses or samples than any method takes."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from ilmek.errors import IlmekError
from ilmek.io.schema import Table
from ilmek.machines.motion_four_bar.params import TAKEN
from ilmek.machines.path_four_bar.params import EXACT
from ilmek.params.text_lists import read_pairs, read_points, read_poses
from ilmek.synthesis.path.task import FEWEST


class TaskList(NamedTuple):
    """The setting that holds the points of a task, how many a text holds, and the least number that is searched."""

    setting: str
    number: Callable[[str, str], int]
    least: int


LISTS: Mapping[str, TaskList] = {
    "path-four-bar": TaskList("points", lambda name, text: len(read_points(name, text)), FEWEST),
    "motion-four-bar": TaskList("poses", lambda name, text: len(read_poses(name, text).points), min(TAKEN)),
    "function-four-bar": TaskList("samples", lambda name, text: len(read_pairs(name, text)), 2),
}


def is_unfinished(data: Table) -> bool:
    """Whether the file of a task states its points, and too few of them."""
    task, settings = LISTS.get(str(data.get("machine"))), data.get("settings")
    if task is None or not isinstance(settings, dict):
        return False
    text = settings.get(task.setting)
    if not isinstance(text, str):
        return False
    least = min(EXACT) if is_exact(settings) else task.least
    try:
        return not text.strip() or task.number(task.setting, text) < least
    except IlmekError:
        return False


def is_exact(settings: Table) -> bool:
    """Whether the points are to be met exactly."""
    return settings.get("exact") in (True, "yes", "true", "on")
