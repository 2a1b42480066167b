"""The shades that were proposed from a picture, as a table."""

from ilmek.carpet.chart import Chart
from ilmek.cli.terminal import show_table
from ilmek.jobs.yarn_choice import proposed_shades


def show_proposed(chart: Chart) -> None:
    """Print the shades proposed from the picture, if any."""
    if shades := proposed_shades(chart):
        rows = [
            (shade.shade.name, shade.shade.hex, f"{shade.shade.share:.1%}", shade.nearest, f"{shade.difference:.1f}")
            for shade in shades
        ]
        show_table(("proposed", "colour", "share", "nearest wool", "CIEDE2000"), rows, right=(2, 4))
