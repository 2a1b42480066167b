"""The Python that writes a product of a file of the project, as its command line does."""

from collections.abc import Mapping
from dataclasses import dataclass

from ilmek.jobs.studio.commands import carpet_command


@dataclass(frozen=True, slots=True)
class Snippet:
    """Lines of Python, and what they import: `from` and `import` lines."""

    imports: tuple[str, ...]
    lines: tuple[str, ...]


_DESIGN = Snippet(("import ilmek",), ("report = ilmek.design({path!r})",))
_ORDER = (
    "from ilmek.io.output import Outputs",
    "from ilmek.jobs.design import design_machine",
    "from ilmek.jobs.machine_file import read_machine_order",
)

_STATES: Mapping[str, Snippet] = {
    "machine": _DESIGN,
    "synthesis": _DESIGN,
    "linkage": Snippet(("import ilmek",), ("run = ilmek.run_machine({path!r})", "report = run.report")),
    "cyclogram": Snippet(
        ("from ilmek.jobs import cyclogram",),
        ("given = cyclogram.find({path!r}, {{}})", "report = cyclogram.report(given)"),
    ),
}
"""What every product of a kind of file begins with."""

_TEXT = "Path({target!r}).write_text(%s, encoding='utf-8')"

_WRITES: Mapping[str, Snippet] = {
    "page": Snippet(("from ilmek.jobs.page import page_text",), (_TEXT % "page_text(report, [])",)),
    "data": Snippet(("from ilmek.io.json_file import json_text",), (_TEXT % "json_text(report.as_json())",)),
    "linkage data": Snippet(
        ("from ilmek.io.json_file import json_text", "from ilmek.jobs.mechanism.data import as_json"),
        (_TEXT % "json_text(as_json(run.analysis, report))",),
    ),
    "linkage table": Snippet(("from ilmek.io.table_csv import csv_text",), (_TEXT % "csv_text(run.table())",)),
    "cyclogram table": Snippet(
        ("from ilmek.io.table_csv import csv_text",), (_TEXT % "csv_text(cyclogram.columns(given, 360))",)
    ),
    "animation": Snippet(
        ("from ilmek.io.output import Outputs", "from ilmek.jobs.animation import write_animation"),
        (
            "with Outputs(force=True) as outputs:",
            "    write_animation(report, Path({target!r}), outputs, ilmek.Progress())",
        ),
    ),
    "linkage parts": Snippet(
        (
            "from ilmek.io.output import Outputs",
            "from ilmek.jobs.mechanism.making import made_mechanism",
            "from ilmek.jobs.workshop_order import WorkshopOrder, workshop_writer",
        ),
        (
            "with Outputs(force=True) as outputs:",
            "    write = workshop_writer(WorkshopOrder(Path({target!r})), outputs)",
            "    made = made_mechanism(run.analysis.run)",
            "    write(made.report, made.papers)",
        ),
    ),
}
"""What writes a product, by its name, or by kind and name."""

_WHOLE: Mapping[str, Snippet] = {
    "parts": Snippet(
        (*_ORDER, "from ilmek.jobs.workshop_order import WorkshopOrder"),
        (
            "order = read_machine_order({path!r}, {{}})",
            "with Outputs(force=True) as outputs:",
            "    design_machine(order.machine, order.settings, WorkshopOrder(Path({target!r})), outputs=outputs)",
        ),
    ),
    "mechanism": Snippet(
        (*_ORDER[1:], "from ilmek.jobs.design import mechanism_text"),
        (
            "order = read_machine_order({path!r}, {{}})",
            "made = design_machine(order.machine, order.settings)",
            _TEXT % "mechanism_text(made.mechanism, Path({target!r}))",
        ),
    ),
    "space": Snippet(
        (*_ORDER[1:], "from ilmek.jobs.loom_space import loom_glb"),
        (
            "order = read_machine_order({path!r}, {{}})",
            "made = design_machine(order.machine, order.settings)",
            "Path({target!r}).write_bytes(loom_glb(made.loom, made.report))",
        ),
    ),
}
"""The products of machines that need more of a design than its report."""


def product_python(kind: str, path: str, name: str, target: str) -> str:
    """The Python that writes a product of a file; run in the project's folder, as the command line."""
    if kind == "carpet":
        return carpet_command(path, target, chart=name == "chart").python
    write = _WRITES.get(f"{kind} {name}") or _WRITES.get(name)
    parts = (_STATES[kind], write) if write is not None else (_WHOLE[name],)
    imports = dict.fromkeys(line for part in parts for line in part.imports)
    lines = [line.format(path=path, target=target) for part in parts for line in part.lines]
    plain, chosen = (sorted(line for line in imports if line.startswith(word)) for word in ("import", "from"))
    return "\n".join(("from pathlib import Path", "", *plain, *chosen, "", *lines, ""))
