"""The example that draws what a bend uses of the limits of its axes."""

import numpy as np
from examples.draw_path_speed import LIMITS, figure, path

from ilmek.timing.path_speed.solve import quickest_motion


def test_some_limit_is_used_up_nearly_always_and_none_overstepped() -> None:
    shares = np.array([series.y for series in figure(quickest_motion(path(), LIMITS)).series])
    assert shares.max() <= 1 + 1e-3
    assert (shares.max(axis=0) > 0.95).mean() > 0.9
