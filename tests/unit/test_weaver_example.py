"""The drawings of the pages on the weaver and on warp tension are those of the machines as they are."""

from examples.draw_weaver import HEAD, STATIC, drawings

from ilmek.units import mm
from ilmek.viz.svg import svg


def test_the_drawings_of_the_pages_are_the_machines() -> None:
    for drawing in drawings():
        assert (STATIC / f"{drawing.name}.svg").read_text(encoding="utf-8") == svg(drawing)


def test_the_example_ends_with_the_yarn_that_the_head_draws() -> None:
    assert round(HEAD.drawn / mm, 3) == 36.773
