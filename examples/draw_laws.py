"""Draws docs/_static/motion-laws.svg and residual-vibration.svg: motion laws, and the residual vibration after each.

Run it as `python examples/draw_laws.py`; it ends with the least time ratio for 1 % of residual vibration by 4-5-6-7.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ilmek.cams.laws import LAWS, Law
from ilmek.cams.vibration import least_ratio, residual
from ilmek.report import Axis, Plot, Series
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"

DRAWN = ("parabolic", "cubic", "harmonic", "cycloidal", "3-4-5", "4-5-6-7", "modified-sine", "modified-trapezoid")
COMPARED = ("harmonic", "modified-sine", "3-4-5", "cycloidal", "4-5-6-7")
WIDE, HIGH, GAP = 420, 229, 12


def spectrum_plot(
    laws: Mapping[str, Law], most: float = 6.0, damping: float = 0.0, count: int = 601, *, decibels: bool = False
) -> Plot:
    """Plot of the residual amplitude over the time ratio [-] up to `most`, for laws by name.

    count     of points      damping  ratio to the critical damping [-]
    decibels  plot 20 log10 of the amplitude over the lift, at least -100, to show small lobes
    """
    ratios = np.linspace(most / count, most, count)
    sizes = {name: residual(law, ratios, damping) for name, law in laws.items()}
    if decibels:
        sizes = {name: 20 * np.log10(np.maximum(size, 1e-5)) for name, size in sizes.items()}
    series = tuple(Series(name, ratios, size) for name, size in sizes.items())
    x = Axis("time of the rise over natural period of the follower")
    y = Axis("amplitude over lift, dB" if decibels else "amplitude over lift")
    note = f"damping {100 * damping:g} % of the critical" if damping else "without damping"
    return Plot("residual-vibration", "Residual vibration after the rise", x, y, series, (), note)


def curves() -> tuple[Plot, ...]:
    """Displacement, velocity, acceleration and jerk of the laws over a rise of 1 in a time of 1."""
    # A point on either side of the middle shows the step of the parabolic law upright.
    u = np.sort(np.append(np.linspace(0, 1, 400), [0.5 - 1e-9, 0.5 + 1e-9]))
    kinds = {name: LAWS[name].motion(u) for name in DRAWN}
    return tuple(
        Plot(
            kind,
            kind.capitalize(),
            Axis("u"),
            Axis(kind),
            tuple(Series(name, u, np.asarray(motion[order])) for name, motion in kinds.items()),
        )
        for order, kind in enumerate(("displacement s", "velocity v", "acceleration a", "jerk j"))
    )


def sheet(plots: tuple[Plot, ...]) -> str:
    """Four plots on one sheet, two in a row."""
    places = ((0, 0), (1, 0), (0, 1), (1, 1))
    inner = "".join(
        svg(plot).replace(
            "<svg ", f'<svg x="{x * (WIDE + GAP)}" y="{y * (HIGH + GAP)}" width="{WIDE}" height="{HIGH}" ', 1
        )
        for i, (plot, (x, y)) in enumerate(zip(plots, places, strict=True))
    )
    size = f"0 0 {2 * WIDE + GAP} {2 * HIGH + GAP}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox="{size}" aria-label="Motion laws">{inner}</svg>\n'
    )


if __name__ == "__main__":
    (OUT / "motion-laws.svg").write_text(sheet(curves()), encoding="utf-8")
    spectra = spectrum_plot({name: LAWS[name] for name in COMPARED}, 8.0, count=801, decibels=True)
    (OUT / "residual-vibration.svg").write_text(svg(spectra), encoding="utf-8")
    print(f"{least_ratio(LAWS['4-5-6-7'], 0.01):.3f}")
