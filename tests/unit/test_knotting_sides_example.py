"""The example that draws both sides of the knotting four-bar gives what the documentation says."""

from examples.draw_knotting_sides import figure, machine, tied


def test_the_published_hands_tie_a_symmetric_knot_on_warps_opened_to_30_mm():
    made, sides = machine()
    knot = tied(made, sides)
    assert knot.why == "warps at y = 1.432 mm, the pile below them"
    drawing = figure(made, sides, knot)
    assert drawing.title == "Both sides: symmetric knot over warps 1 and 2"
    assert sum(stroke.filled for stroke in drawing.strokes) == 2
