"""Draws docs/_static/gear-pair.svg: two gears with shifted profiles in mesh, to scale.

Run it as `python examples/draw_gears.py`; it ends with their contact ratio.
"""

import math
from pathlib import Path

import numpy as np

from ilmek.elements.gear_pair import GearPair, pair_at
from ilmek.elements.involute import outline
from ilmek.report import Dot, Drawing, Stroke
from ilmek.units import mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"


def pair() -> GearPair:
    """14 and 32 teeth of module 3 mm on axes 70 mm apart instead of the standard 69: 14 teeth are not undercut."""
    return pair_at(70 * mm, 3 * mm, (14, 32), 30 * mm, share=0.7)


def gear_drawing(pair: GearPair) -> Drawing:
    """Two gears in mesh, to scale: outlines, rolling circles, line of action."""
    circle = np.exp(1j * np.linspace(0.0, 2 * math.pi, 181))
    tips, rolling, distance = pair.tip_radii, pair.rolling_radii, pair.distance
    turn = math.pi / pair.second.teeth + math.pi
    strokes = [
        Stroke(outline(pair.first, tips[0]), "outline", closed=True),
        Stroke(distance + outline(pair.second, tips[1]) * np.exp(1j * turn), "outline", closed=True),
        *(
            Stroke(centre + r * circle, "construction", closed=True)
            for centre, r in zip((0.0, distance), rolling, strict=True)
        ),
    ]
    reach = 0.35 * rolling[0] * np.exp(1j * (math.pi / 2 + pair.pressure_angle))
    strokes.append(Stroke(rolling[0] + np.array([-reach, reach]), "path", "line of action"))
    note = f"contact ratio {pair.contact_ratio:.3f}; root fillets are not drawn"
    dots = (Dot(0j, "", "point"), Dot(distance + 0j, "", "point"))
    return Drawing("gears", "Gears, to scale", tuple(strokes), dots, note=note)


if __name__ == "__main__":
    (OUT / "gear-pair.svg").write_text(svg(gear_drawing(pair())) + "\n", encoding="utf-8")
    print(f"contact ratio {pair().contact_ratio:.4f}")
