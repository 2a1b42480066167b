"""The example that draws a four-bar for a path gives what the documentation says."""

from examples.draw_path import TASK, figure

from ilmek.synthesis.path.search import path_four_bars


def test_the_drawn_four_bar_misses_no_point_by_more_than_it_says():
    drawing = figure(path_four_bars(TASK, count=1)[0])
    assert drawing.title == "A four-bar for 16 points: nearest to 0.61 mm"
    assert sum(dot.role == "point" for dot in drawing.dots) == len(TASK.points)
