"""Draws docs/_static/gear-pair.svg: two gears with shifted profiles in mesh, to scale.

Run it as `python examples/draw_gears.py`; it ends with their contact ratio.
"""

from pathlib import Path

from ilmek.elements.figures import gear_drawing
from ilmek.elements.gear_pair import GearPair, pair_at
from ilmek.units import mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"


def pair() -> GearPair:
    """14 and 32 teeth of module 3 mm on axes 70 mm apart instead of the standard 69: 14 teeth are not undercut."""
    return pair_at(70 * mm, 3 * mm, (14, 32), 30 * mm, share=0.7)


if __name__ == "__main__":
    (OUT / "gear-pair.svg").write_text(svg(gear_drawing(pair())) + "\n", encoding="utf-8")
    print(f"contact ratio {pair().contact_ratio:.4f}")
