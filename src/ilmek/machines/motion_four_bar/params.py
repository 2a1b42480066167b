"""What may be asked of a four-bar for a motion."""

import math
from dataclasses import dataclass

from ilmek.arrays import ComplexArray
from ilmek.errors import ParameterError
from ilmek.machines.four_bars import filter_params
from ilmek.machines.text_lists import BodyPoses, read_bounds, read_points, read_poses
from ilmek.params import Params, param
from ilmek.synthesis.burmester.constant_distance import require_task

KNOTTING = "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
"""The knotting report's poses of the gripper."""

TAKEN = (3, 4, 5)
"""Poses that are met exactly."""

Bounds = tuple[float, float]


@dataclass(frozen=True, slots=True)
class MotionFourBarParams(Params):
    """What may be asked of a four-bar for a motion: poses, and where its pivots may be."""

    poses: str = param(KNOTTING, doc="three to five poses of the body: x and y of one of its points, and its angle")
    pivots: str | None = param(None, doc="both pivots, for three poses: (0,0) (40mm,0); unsaid: the best of a grid")
    pins: str | None = param(None, doc="both pins of the body at the first pose, for three poses, in place of pivots")
    pivot_x: str | None = param(None, doc="bounds on x of both pivots, like -20mm..60mm, or ..0mm")
    pivot_y: str | None = param(None, doc="bounds on y of both pivots")
    samples: int = param(90, at_least=8, at_most=1000, doc="links looked at on each closed part of the curves of four")
    one_circuit: bool = filter_params.one_circuit()
    one_branch: bool = filter_params.one_branch()
    in_order: bool = filter_params.in_order()
    full_turn: bool = filter_params.full_turn()
    transmission_min: float = filter_params.transmission_min()
    link_ratio_max: float | None = filter_params.link_ratio_max(10.0)
    size_max: float | None = filter_params.size_max()
    count: int = filter_params.count()
    chosen: int = filter_params.chosen()

    def check_together(self) -> None:
        """The poses can be read, and a method takes so many."""
        poses = self.task()
        given = [name for name in ("pivots", "pins") if getattr(self, name) is not None]
        if len(given) == 2:
            raise ParameterError("pivots and pins are given", allowed="one of them, or neither", do="leave pins out")
        if given:
            if len(poses.points) != 3:
                raise ParameterError(
                    f"{given[0]} are given for {len(poses.points)} poses",
                    allowed="three poses leave them free",
                    do=f"leave {given[0]} out, or a pose",
                )
            self.given(given[0])
        self.room()

    def task(self) -> BodyPoses:
        """The poses. Raises ParameterError where they are no task."""
        poses = read_poses("poses", self.poses)
        count = len(poses.points)
        if count not in TAKEN:
            more = "path-four-bar comes near any number of points" if count > max(TAKEN) else "give three at least"
            raise ParameterError(
                f"motion-four-bar was given {count} poses", allowed="3, 4 or 5 are met exactly", do=more
            )
        require_task("pose", *poses, count, "motion-four-bar")
        return poses

    def given(self, name: str) -> ComplexArray | None:
        """Both pivots, or both pins [m]; None where they are not given."""
        text = getattr(self, name)
        if text is None:
            return None
        found = read_points(name, text)
        if len(found) != 2:
            raise ParameterError(f"{name} holds {len(found)} points", allowed="two, one for each link")
        if found[0] == found[1]:
            raise ParameterError(f"both {name} are one point", do="give two that differ")
        return found

    def room(self) -> tuple[Bounds, Bounds]:
        """Least and most of x and of y of the pivots [m]."""
        return self._bounds("pivot_x"), self._bounds("pivot_y")

    def _bounds(self, name: str) -> Bounds:
        text = getattr(self, name)
        if text is None:
            return -math.inf, math.inf
        least, most = read_bounds(name, text)
        return -math.inf if least is None else least, math.inf if most is None else most
