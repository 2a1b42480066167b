"""Sphinx extension: the reference pages, generated from the code so that they cannot drift from it.

Writes docs/reference/generated/: one page for the machines (parameters and results), one for the command line, the
verdicts on the published papers, one for each package (signatures and docstrings, shown as they stand in the source);
and, beside the built pages, the report of every machine.
"""

import ast
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click
from click.testing import CliRunner

from ilmek.cli import main
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import Component
from ilmek.params import Parameter, listed
from ilmek.records import declared_results
from ilmek.units import format_quantity, printed_unit
from ilmek.verification import PAPERS, TITLES, reproduce
from ilmek.verification.wording import HEADINGS, ROOT_HEADINGS, root_rows, row, summary
from ilmek.viz.page import machine_page

SOURCE = Path(__file__).parents[2] / "src" / "ilmek"
OUT = Path(__file__).parents[1] / "reference" / "generated"
PACKAGES = (
    "units", "arguments", "errors", "arrays", "progress", "records", "params", "report", "num", "plane", "linkage",
    "elements", "synthesis", "dynamics", "cams", "timing", "weaving", "carpet", "loom", "machines", "verification",
    "io", "viz", "drivers", "factory", "jobs", "api",
)  # fmt: skip


def cell(text: object) -> str:
    """A table cell: one line, bars escaped."""
    return str(text).replace("|", "\\|").replace("\n", " ").strip()


def table(header: tuple[str, ...], rows: list[tuple[object, ...]]) -> str:
    """A Markdown table."""
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join("| " + " | ".join(cell(item) for item in line) + " |" for line in lines)


def default(parameter: Parameter) -> str:
    """A parameter's default in its unit; a dash where it is derived."""
    value = parameter.default
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else format_quantity(value, parameter.unit, digits=6)


def names(parameter: Parameter) -> str:
    """A parameter's name, and its alias where it has one."""
    return f"`{parameter.name}`, `{parameter.alias}`" if parameter.alias else f"`{parameter.name}`"


def meaning(parameter: Parameter) -> str:
    """A parameter's meaning, with its symbol where it has one."""
    return f"{parameter.doc} ({parameter.symbol})" if parameter.symbol else parameter.doc


POINTS, ANGLES = "(12mm,4mm) (18.5mm,9.5mm) (24mm,8mm) (27mm,3mm)", "20deg 65deg 100deg 150deg"
POSES = "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"

VARIANTS: dict[str, tuple[dict[str, str], ...]] = {
    "cam": ({"angle": "30deg", "linkage_stiffness": "500N/mm"},),
    "beat-up": ({"crank_angle": "60deg"},),
    "tufting": ({"crank_angle": "22deg"},),
    "hammer": ({"drive": "linkage"},),
    "knotting-four-bar": ({"sides": "2"}, {"poses": POSES, "ground_angle": "275deg"}),
    "knotting-dyad": ({"points": POINTS, "angles": ANGLES},),
    "path-four-bar": ({"cognates": "yes"},),
}
"""Settings beside the defaults in whose reports further results stand."""


def structure(value: object) -> str:
    """The names inside a group of values: `{slope, load {weight, pull}}`, and of a list those of its first entry."""
    if isinstance(value, Mapping):
        inner = (f"{name} {structure(item)}".strip() for name, item in value.items())
        return f"{{{', '.join(inner)}}}"
    if isinstance(value, list | tuple) and value:
        return f"[{structure(value[0]) or '…'}, …]"
    return ""


def result_rows(machine: Component) -> list[tuple[object, ...]]:
    """The declared results of a machine, with the structure of those that are groups of values."""
    reports = [machine.report_for(settings) for settings in ({}, *VARIANTS.get(machine.name, ()))]
    found = {result.name: structure(result.value) for report in reversed(reports) for result in report.results}
    declared = {one.name: one for one in reversed(declared_results(*machine.reported))}
    return [
        (f"`{name}`", printed_unit(one.unit) or "–", f"{one.meaning} {found.get(name, '')}".strip())
        for name, one in reversed(declared.items())
    ]


def machine_section(machine: Component) -> str:
    """One machine: its parameters, its declared results and, from a run of its defaults, its checks."""
    parameters = [
        (names(p), default(p), printed_unit(p.unit) or "–", p.allowed().removeprefix("allowed: "), meaning(p))
        for p in listed(machine.params)
    ]
    checks = [(c.name, c.relation, format_quantity(c.limit, c.unit), c.source) for c in machine.report_for({}).checks]
    return "\n\n".join(
        (
            f"## {machine.name}",
            f'{machine.summary}. <a href="../../machines/{machine.name}.html">Its page</a>, drawn with the defaults.',
            table(("parameter", "default", "unit", "allowed", "meaning"), parameters),
            "Results (JSON in SI and radians; the unit is the one that a report shows):",
            table(("result", "unit", "meaning, {names of a group}"), result_rows(machine)),
            "Checks, with the limits of the default parameters:",
            table(("check", "", "limit", "source"), checks),
        )
    )


def command_section(path: tuple[str, ...]) -> str:
    """The help of one command, as the terminal shows it."""
    shown = CliRunner().invoke(main, [*path, "--help"], prog_name="ilmek", terminal_width=100)
    return f"## ilmek {' '.join(path)}\n\n```text\n{shown.output.strip()}\n```"


def signature(node: ast.FunctionDef | ast.ClassDef) -> str:
    """The definition's first line, with annotations; a dataclass shows its fields."""
    if isinstance(node, ast.FunctionDef):
        returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        return f"{node.name}({ast.unparse(node.args)}){returns}"
    fields = [ast.unparse(item) for item in node.body if isinstance(item, ast.AnnAssign)]
    return f"class {node.name}" + "".join(f"\n    {field}" for field in fields)


def module_section(path: Path) -> str:
    """One module: its docstring and every public definition."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    name = ".".join(path.relative_to(SOURCE.parent).with_suffix("").parts).removesuffix(".__init__")
    parts = [f"## {name}", f"```text\n{ast.get_docstring(tree)}\n```"]
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
            body = f"{signature(node)}\n\n{ast.get_docstring(node) or ''}".rstrip()
            parts.append(f"### {node.name}\n\n```text\n{body}\n```")
    return "\n\n".join(parts)


def package_page(package: str) -> str:
    """All modules of a package on one page."""
    folder = SOURCE / package
    paths = sorted(folder.rglob("*.py")) if folder.is_dir() else [SOURCE / f"{package}.py"]
    return "\n\n".join((f"# ilmek.{package}", *(module_section(path) for path in paths)))


def verification_section(paper: str) -> str:
    """A paper's claims, those that are not reproduced first."""
    verdicts = reproduce([paper])
    apart = [verdict for verdict in verdicts if verdict.verdict != "reproduced"]
    roots = root_rows(verdicts)
    return "\n\n".join(
        (
            f"### {paper}",
            f"{TITLES[paper]}. {summary(verdicts)}.",
            "#### Not as printed",
            table(HEADINGS, [row(verdict) for verdict in apart]),
            *(("#### Slips, and the rows that follow from each", table(ROOT_HEADINGS, roots)) if roots else ()),
            "#### All",
            table(HEADINGS, [row(verdict) for verdict in verdicts]),
        )
    )


def write_pages(_app: Any) -> None:
    """Write every generated page."""
    OUT.mkdir(parents=True, exist_ok=True)
    commands = main.list_commands(click.Context(main))
    pages = {
        "machines": "\n\n".join(("# Machines", *(machine_section(machine) for machine in MACHINES.values()))),
        "command-line": "\n\n".join(
            ("# Command line", command_section(()), *(command_section((c,)) for c in commands))
        ),
        "verdicts": "\n\n".join(verification_section(paper) for paper in PAPERS),
        **{f"api-{package}": package_page(package) for package in PACKAGES},
    }
    for name, text in pages.items():
        (OUT / f"{name}.md").write_text(text + "\n", encoding="utf-8")


def write_machine_pages(app: Any, failed: Exception | None) -> None:
    """Write the report of every machine's defaults beside the built documentation, as `ilmek design --report` does."""
    if failed or app.builder.format != "html":
        return
    folder = Path(app.outdir) / "machines"
    folder.mkdir(exist_ok=True)
    for machine in MACHINES.values():
        page = machine_page(machine.report_for({}))
        (folder / f"{machine.name}.html").write_text(page, encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("builder-inited", write_pages)
    app.connect("build-finished", write_machine_pages)
    return {"parallel_read_safe": True}
