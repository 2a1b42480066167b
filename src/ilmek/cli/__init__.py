"""The command line: `ilmek weave`, `chart`, `design`, `mechanism`, `cyclogram`, `knot` and the others below.

Nothing heavy is imported here: a command's module is loaded when the command is run, so that `ilmek --help` is fast.
"""

import click

from ilmek import __version__
from ilmek.cli.frame import LazyGroup
from ilmek.cli.language import language_option

main = LazyGroup(
    name="ilmek",
    help="Design a loom for a carpet picture: knot chart, yarn to buy, machines and loom programme.",
    epilog=(
        "\b\n"
        "Examples:\n"
        "  ilmek weave photo.jpg --size 120x180cm --quality 40x40/dm --deadline 72h --out carpet\n"
        "  ilmek machines beat-up\n"
        "  ilmek design beat-up --set swing=30deg --json -\n"
        "\n"
        "\b\n"
        "Exit codes:\n"
        "  0  done, and every check holds\n"
        "  2  bad input, or an output that cannot be written: nothing is written\n"
        "  3  done, but a check fails: weave, chart, design, cyclogram, check, run, replay\n"
        "\n"
        "Each command has its own help: ilmek COMMAND --help"
    ),
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    modules={
        "weave": ("ilmek.cli.weave", "Turn a picture into a chart, a yarn bill, a loom and its programme."),
        "chart": ("ilmek.cli.chart", "Make only the knot chart of a picture and the yarn bill."),
        "call": ("ilmek.cli.call", "Call a chart row by row on a terminal, for the weaver."),
        "machines": ("ilmek.cli.machines", "List the machines, or the parameters of one machine."),
        "design": ("ilmek.cli.design", "Design one machine and report it."),
        "compare": ("ilmek.cli.compare", "Compare measured curves with a machine's model, and fit parameters."),
        "study": ("ilmek.cli.study", "Sweep, sensitivity, tolerances, optimum of a machine or a mechanism."),
        "mechanism": ("ilmek.cli.mechanism", "Analyse a mechanism from a file: structure, mobility, motion, report."),
        "import": ("ilmek.cli.import_mechanism", "Write a mechanism of another program as a mechanism file."),
        "cyclogram": ("ilmek.cli.cyclogram", "Check, optimise, tabulate and draw a cyclogram."),
        "knot": ("ilmek.cli.knot", "Prove which knot the motion of a gripper ties."),
        "reproduce": ("ilmek.cli.reproduce", "Recompute four published papers and compare, number by number."),
        "studio": ("ilmek.cli.studio", "Open a project in the browser: carpet, machines, linkages and loom."),
        "mcp": ("ilmek.cli.mcp", "Serve tools to an agent: machines, mechanisms, synthesis, knots, programmes."),
        "plan": ("ilmek.cli.plan", "Plan several carpets on looms that exist: which loom weaves what when."),
        "order": ("ilmek.cli.order", "Work a customer's order: quotation, approval, workshop folders, records."),
        "verify": ("ilmek.cli.verify", "Verify the record of a carpet, or the code of its label."),
        "simulate": ("ilmek.cli.simulate", "Weave a programme in time: stops, utilisation, when it is done."),
        "run": ("ilmek.cli.run", "Weave a loom programme on the simulated loom, with a journal."),
        "serve": ("ilmek.cli.serve", "Weave a loom programme as `run` does, with an OPC UA server beside it."),
        "status": ("ilmek.cli.status", "Show the state of a run, from another terminal."),
        "hold": ("ilmek.cli.hold", "Hold a run, from another terminal."),
        "resume": ("ilmek.cli.resume", "Have a run go on, from another terminal."),
        "mode": ("ilmek.cli.mode", "Choose the mode of a run, from another terminal."),
        "jog": ("ilmek.cli.jog", "Move an axis of a run by hand, from another terminal."),
        "stop": ("ilmek.cli.stop", "Stop and end a run, from another terminal."),
        "replay": ("ilmek.cli.replay", "Replay a recorded run, and compare its digest."),
        "inspect": ("ilmek.cli.inspect", "Show a loom programme: rows, colours, statistics."),
        "check": ("ilmek.cli.check", "Prove a loom programme: each knot once, no heads meet, yarn enough."),
        "plc": ("ilmek.cli.plc", "Write the loom's control as structured text and PLCopen XML, with its I/O."),
        "plant": ("ilmek.cli.plant", "Be the loom of a PLC over OPC UA, with faults."),
        "convert": ("ilmek.cli.convert", "Turn a loom programme into text, one operation a line, and back."),
    },
)
main.params.append(language_option())
click.version_option(__version__, "-V", "--version", prog_name="ilmek", message="%(prog)s %(version)s")(main)
