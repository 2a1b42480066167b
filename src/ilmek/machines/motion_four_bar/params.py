"""Parameters of a four-bar for a motion."""

import math
from dataclasses import dataclass

from ilmek.arrays import ComplexArray
from ilmek.errors import ParameterError
from ilmek.params import kind
from ilmek.params.text_lists import BodyPoses, Bounds, read_bounds, read_poses, read_region, read_two_points
from ilmek.synthesis.burmester.constant_distance import require_task
from ilmek.synthesis.motion.limits import NOWHERE, MotionLimits
from ilmek.synthesis.motion.search import LINKS
from ilmek.synthesis.selection import FourBarTaskParams
from ilmek.units import counted

KNOTTING = "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
"""The knotting report's poses of the gripper."""

TAKEN = (3, 4, 5)
"""Poses that are met exactly."""

OVER, DRIVEN = ("motion", "task"), ("either", "first", "second")


@dataclass(frozen=True, slots=True)
class MotionFourBarParams(FourBarTaskParams):
    """Task of a four-bar for a motion: poses, and limits of the four-bar."""

    poses: str = kind.text(KNOTTING, doc="three to five poses of the body: x and y of one of its points, and its angle")
    pivots: str | None = kind.text(
        None, doc="both pivots, for three poses: (0,0) (40mm,0); default: the best of all in their regions"
    )
    pins: str | None = kind.text(
        None, doc="both pins of the body at the first pose, for three poses, instead of pivots"
    )
    driven: str = kind.choice("either", DRIVEN, doc="which of the given pivots or pins is the crank's")
    pivot_x: str | None = kind.text(None, doc="bounds on x of both pivots, like -20mm..60mm, or ..0mm")
    pivot_y: str | None = kind.text(None, doc="bounds on y of both pivots")
    pivot_region: str | None = kind.text(
        None, doc="region of both pivots: two opposite corners of a rectangle, or the corners of a polygon"
    )
    crank_region: str | None = kind.text(None, doc="region of the crank's pivot; default: pivot_region")
    rocker_region: str | None = kind.text(None, doc="region of the rocker's pivot; default: pivot_region")
    keep_out: str | None = kind.text(
        None, doc="region that crank, coupler and rocker keep clear of over the motion, written like pivot_region"
    )
    crank_swing: str | None = kind.text(
        None, doc="bounds on the rotation of the crank from the first to the last pose, like ..120deg"
    )
    rocker_swing: str | None = kind.text(None, doc="bounds on the swing of the rocker over the motion")
    transmission_over: str = kind.choice(
        "motion",
        OVER,
        doc="transmission angle over the motion (the whole turn of a crank that turns fully), or over the task alone",
    )
    samples: int = kind.count(
        400, at_least=8, at_most=1000, doc="links tried on each closed part of the curves of four poses"
    )
    links: int = kind.count(
        LINKS, at_least=30, at_most=LINKS, doc="links of three poses that are paired with each other"
    )
    loosen: bool = kind.flag(
        True, doc="without a solution: search the single limits that give one if they are loosened"
    )

    def check_together(self) -> None:
        """Raise ParameterError where the poses or regions cannot be read, or no method takes their number."""
        poses = self.task()
        given = [name for name in ("pivots", "pins") if getattr(self, name) is not None]
        if len(given) == 2:
            raise ParameterError("pivots and pins are given", allowed="one of them, or neither", do="leave pins out")
        if given:
            if len(poses.points) != 3:
                raise ParameterError(
                    f"{given[0]} are given for {counted(len(poses.points), 'pose')}",
                    allowed="three poses leave them free",
                    do=f"leave {given[0]} out, or a pose",
                )
            self.both(given[0])
        elif self.driven != "either":
            allowed = "the first or second of them"
            do = "give pivots, or crank_region to state where the driven link is"
            raise ParameterError(f"driven={self.driven}, and neither pivots nor pins are given", allowed=allowed, do=do)
        self.limits()

    def task(self) -> BodyPoses:
        """The poses. Raises ParameterError where no method takes them."""
        poses = read_poses("poses", self.poses)
        count = len(poses.points)
        if count not in TAKEN:
            more = "path-four-bar comes near any number of points" if count > max(TAKEN) else "give three at least"
            raise ParameterError(
                f"motion-four-bar was given {counted(count, 'pose')}", allowed="3, 4 or 5 are met exactly", do=more
            )
        require_task("pose", *poses, count, "motion-four-bar")
        return poses

    def both(self, name: str) -> ComplexArray | None:
        """Both pivots, or both pins [m]; None where they are not given."""
        text = getattr(self, name)
        return None if text is None else read_two_points(name, text)

    @property
    def task_only(self) -> bool:
        """Whether the transmission angle is that from the first to the last pose alone."""
        return self.transmission_over == "task"

    def limits(self) -> MotionLimits:
        """All limits [SI]. Raises ParameterError where one cannot be read."""
        box = self._bounds("pivot_x", "mm", -math.inf), self._bounds("pivot_y", "mm", -math.inf)
        both = self._region("pivot_region")
        return MotionLimits(
            filters=self.filters(),
            boxes=(box, box),
            crank_region=both if self.crank_region is None else self._region("crank_region"),
            rocker_region=both if self.rocker_region is None else self._region("rocker_region"),
            keep_out=self._region("keep_out"),
            crank_swing=self._bounds("crank_swing", "deg", 0.0),
            rocker_swing=self._bounds("rocker_swing", "deg", 0.0),
            task_only=self.task_only,
        )

    def _bounds(self, name: str, unit: str, least: float) -> Bounds:
        text = getattr(self, name)
        return (least, math.inf) if text is None else read_bounds(name, text, unit, least=least)

    def _region(self, name: str) -> ComplexArray:
        text = getattr(self, name)
        return NOWHERE if text is None else read_region(name, text)
