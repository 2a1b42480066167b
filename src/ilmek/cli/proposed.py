"""The shades that were proposed from a picture, as a table."""

from ilmek.carpet.chart import Chart
from ilmek.cli.terminal import show_table
from ilmek.jobs.yarn_choice import proposed_shades


def show_proposed(chart: Chart) -> None:
    """Print the shades proposed from the picture, if any."""
    if shades := proposed_shades(chart):
        rows = [
            (one.shade.name, one.shade.hex, f"{one.shade.share:.1%}", one.nearest, f"{one.difference:.1f}")
            for one in shades
        ]
        show_table(("proposed", "colour", "share", "nearest wool", "CIEDE2000"), rows, right=(2, 4))
