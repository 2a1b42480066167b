"""The command line: `ilmek weave`, `chart`, `design`, `mechanism`, `cyclogram`, `knot` and the others below.

Nothing heavy is imported here: a command's module is loaded when the command is run, so that `ilmek --help` is quick.
"""

import click

from ilmek import __version__
from ilmek.cli.frame import LazyGroup

main = LazyGroup(
    name="ilmek",
    help="Carpet in, loom out: knot chart, yarn, loom and programme from a carpet picture.",
    epilog=(
        "\b\n"
        "Examples:\n"
        "  ilmek weave photo.jpg --size 120x180cm --quality 40x40/dm --deadline 72h --out carpet\n"
        "  ilmek machines beat-up\n"
        "  ilmek design beat-up --set swing=30deg --json -\n"
        "\n"
        "Each command has its own help: ilmek COMMAND --help"
    ),
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    modules={
        "weave": ("ilmek.cli.weave", "A picture in, everything for weaving it out: chart, yarn, loom, programme."),
        "chart": ("ilmek.cli.chart", "Only the knot chart of a picture and the yarn to buy."),
        "machines": ("ilmek.cli.machines", "The machines, or one machine's parameters."),
        "design": ("ilmek.cli.design", "Design one machine and report it."),
        "mechanism": ("ilmek.cli.mechanism", "A mechanism from a file: how it is built, its motion, a page to read."),
        "cyclogram": ("ilmek.cli.cyclogram", "A cyclogram from a file: judged, solved, tabled, drawn."),
        "knot": ("ilmek.cli.knot", "Which knot the motion of a gripper ties, proved."),
        "reproduce": ("ilmek.cli.reproduce", "Every number of four published papers, computed and judged."),
        "inspect": ("ilmek.cli.inspect", "Look into a loom programme: rows, colours, statistics."),
    },
)
click.version_option(__version__, "-V", "--version", prog_name="ilmek", message="%(prog)s %(version)s")(main)
