"""The drawings of the page on the weft are those of the machine as it is."""

from examples.draw_weft import MADE, STATIC, drawings

from ilmek.viz.svg import svg


def test_the_drawings_of_the_page_are_the_machine() -> None:
    for drawing in drawings():
        assert (STATIC / f"{drawing.name}.svg").read_text(encoding="utf-8") == svg(drawing)


def test_the_example_ends_with_the_rows_of_a_bobbin() -> None:
    assert [bobbin.rows for bobbin in MADE.bobbins] == [23, 43]
    assert len(MADE.checks) == sum(check.ok for check in MADE.checks)
