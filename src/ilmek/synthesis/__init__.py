"""From a task to link lengths: closed-form synthesis of linkages.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "function_approximations": "ilmek.synthesis.approximation.function_generator",
    "complete_four_bars": "ilmek.synthesis.alt_burmester.four_bars",
    "PosesAndPoints": "ilmek.synthesis.alt_burmester.task",
    "burmester_curve": "ilmek.synthesis.burmester.curve",
    "arms_through_five_poses": "ilmek.synthesis.burmester.links",
    "Candidate": "ilmek.synthesis.candidate",
    "TwoLinkArm": "ilmek.synthesis.dyad",
    "arms_through_poses": "ilmek.synthesis.dyad",
    "Filters": "ilmek.synthesis.filters",
    "FourBar": "ilmek.synthesis.four_bar",
    "LinkLengths": "ilmek.synthesis.four_bar",
    "function_generators": "ilmek.synthesis.freudenstein",
    "Function": "ilmek.synthesis.function",
    "PathFit": "ilmek.synthesis.path.fit",
    "path_four_bars": "ilmek.synthesis.path.search",
    "PathTask": "ilmek.synthesis.path.task",
    "PrecisionTask": "ilmek.synthesis.task",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.synthesis.alt_burmester.four_bars import complete_four_bars as complete_four_bars
    from ilmek.synthesis.alt_burmester.task import PosesAndPoints as PosesAndPoints
    from ilmek.synthesis.approximation.function_generator import function_approximations as function_approximations
    from ilmek.synthesis.burmester.curve import burmester_curve as burmester_curve
    from ilmek.synthesis.burmester.links import arms_through_five_poses as arms_through_five_poses
    from ilmek.synthesis.candidate import Candidate as Candidate
    from ilmek.synthesis.dyad import TwoLinkArm as TwoLinkArm
    from ilmek.synthesis.dyad import arms_through_poses as arms_through_poses
    from ilmek.synthesis.filters import Filters as Filters
    from ilmek.synthesis.four_bar import FourBar as FourBar
    from ilmek.synthesis.four_bar import LinkLengths as LinkLengths
    from ilmek.synthesis.freudenstein import function_generators as function_generators
    from ilmek.synthesis.function import Function as Function
    from ilmek.synthesis.path.fit import PathFit as PathFit
    from ilmek.synthesis.path.search import path_four_bars as path_four_bars
    from ilmek.synthesis.path.task import PathTask as PathTask
    from ilmek.synthesis.task import PrecisionTask as PrecisionTask
