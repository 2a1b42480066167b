"""Parameters of a four-bar for a motion."""

import math
from dataclasses import dataclass

from ilmek.arrays import ComplexArray
from ilmek.errors import ParameterError
from ilmek.params import kind
from ilmek.params.text_lists import BodyPoses, Bounds, read_bounds, read_poses, read_two_points
from ilmek.synthesis.burmester.constant_distance import require_task
from ilmek.synthesis.selection import FourBarTaskParams

KNOTTING = "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
"""The knotting report's poses of the gripper."""

TAKEN = (3, 4, 5)
"""Poses that are met exactly."""


@dataclass(frozen=True, slots=True)
class MotionFourBarParams(FourBarTaskParams):
    """Task of a four-bar for a motion: poses, and bounds on its pivots."""

    poses: str = kind.text(KNOTTING, doc="three to five poses of the body: x and y of one of its points, and its angle")
    pivots: str | None = kind.text(
        None, doc="both pivots, for three poses: (0,0) (40mm,0); default: the best of a grid"
    )
    pins: str | None = kind.text(
        None, doc="both pins of the body at the first pose, for three poses, instead of pivots"
    )
    pivot_x: str | None = kind.text(None, doc="bounds on x of both pivots, like -20mm..60mm, or ..0mm")
    pivot_y: str | None = kind.text(None, doc="bounds on y of both pivots")
    samples: int = kind.count(
        90, at_least=8, at_most=1000, doc="links tried on each closed part of the curves of four poses"
    )

    def check_together(self) -> None:
        """Raise ParameterError where the poses cannot be read, or no method takes their number."""
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
            self.both(given[0])
        self.pivot_ranges()

    def task(self) -> BodyPoses:
        """The poses. Raises ParameterError where no method takes them."""
        poses = read_poses("poses", self.poses)
        count = len(poses.points)
        if count not in TAKEN:
            more = "path-four-bar comes near any number of points" if count > max(TAKEN) else "give three at least"
            raise ParameterError(
                f"motion-four-bar was given {count} poses", allowed="3, 4 or 5 are met exactly", do=more
            )
        require_task("pose", *poses, count, "motion-four-bar")
        return poses

    def both(self, name: str) -> ComplexArray | None:
        """Both pivots, or both pins [m]; None where they are not given."""
        text = getattr(self, name)
        return None if text is None else read_two_points(name, text)

    def pivot_ranges(self) -> tuple[Bounds, Bounds]:
        """Least and greatest x and y of the pivots [m]."""
        return self._bounds("pivot_x"), self._bounds("pivot_y")

    def _bounds(self, name: str) -> Bounds:
        text = getattr(self, name)
        return (-math.inf, math.inf) if text is None else read_bounds(name, text)
