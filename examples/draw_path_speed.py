"""Draws docs/_static/path-speed.svg: two axes lead a point round a bend, and what they use of their limits meanwhile.

Run it as `python examples/draw_path_speed.py`; it ends with the time that the way takes in s.
"""

from pathlib import Path

import numpy as np

from ilmek.report import Axis, Plot, Series
from ilmek.timing.path_speed.solve import AxesLimits, JointPath, PathMotion, quickest_motion
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "path-speed.svg"

LIMITS = AxesLimits(np.array([1.0, 1.0]), np.array([4.0, 4.0]), np.array([60.0, 60.0]))
"""Of both axes: 1 m/s, 4 m/s², 60 m/s³."""


def path(nodes: int = 400) -> JointPath:
    """A parabola's bend of about a metre: straight, round a corner, straight."""
    x = np.linspace(-0.35, 0.35, nodes)[:, None]
    along, bend, twice = np.hstack([x, 4 * x**2]), np.hstack([0 * x + 1, 8 * x]), np.hstack([0 * x, 0 * x + 8])
    return JointPath(x[:, 0], along, bend, twice)


def figure(motion: PathMotion) -> Plot:
    """The greatest use of each limit by either axis, over time."""
    course = motion.even(600)
    shares = {
        "speed": course.speed / LIMITS.speed,
        "acceleration": course.acceleration / LIMITS.acceleration,
        "jerk": course.jerk / LIMITS.jerk,
    }
    series = tuple(Series(name, course.time, np.abs(share).max(axis=1)) for name, share in shares.items())
    axes = Axis("time", "s"), Axis("greatest over its limit")
    return Plot("path-speed", "A limit is used up at every moment", *axes, series)


if __name__ == "__main__":
    found = quickest_motion(path(), LIMITS)
    OUT.write_text(svg(figure(found)), encoding="utf-8")
    print(f"{found.duration:.3f}")
