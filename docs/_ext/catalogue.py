"""Sphinx extension: the reference pages, generated from the code so that they cannot drift from it.

Writes docs/reference/generated/: one page for the machines (parameters and results), one for the command line, the
verdicts on the published papers, one for each package (signatures and docstrings, shown as they stand in the source);
and, beside the built pages, the report of every machine.
"""

import ast
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
from ilmek.verification.wording import HEADINGS, row, summary
from ilmek.viz.page import machine_page

SOURCE = Path(__file__).parents[2] / "src" / "ilmek"
OUT = Path(__file__).parents[1] / "reference" / "generated"
PACKAGES = (
    "units", "errors", "arrays", "progress", "params", "report", "num", "plane", "linkage", "elements", "carpet",
    "synthesis",
    "dynamics", "cams", "timing", "weaving", "loom", "machines", "verification", "io", "viz", "jobs",
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


def said(parameter: Parameter) -> str:
    """A parameter's meaning, with its symbol where it has one."""
    return f"{parameter.doc} ({parameter.symbol})" if parameter.symbol else parameter.doc


def machine_section(machine: Component) -> str:
    """One machine: its parameters and, from a run of its defaults, its results and checks."""
    parameters = [
        (names(p), default(p), printed_unit(p.unit) or "–", p.allowed().removeprefix("allowed: "), said(p))
        for p in listed(machine.params)
    ]
    report = machine.report_for({})
    results = [(f"`{r.name}`", printed_unit(r.unit) or "–", r.meaning) for r in declared_results(*machine.reported)]
    checks = [(c.name, c.relation, format_quantity(c.limit, c.unit), c.source) for c in report.all_checks]
    return "\n\n".join(
        (
            f"## {machine.name}",
            f'{machine.summary}. <a href="../../machines/{machine.name}.html">Its page</a>, drawn with the defaults.',
            table(("parameter", "default", "unit", "allowed", "meaning"), parameters),
            "Results (JSON in SI and radians; the unit is the one a report shows):",
            table(("result", "unit", "meaning"), results),
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
    return "\n\n".join(
        (
            f"### {paper}",
            f"{TITLES[paper]}. {summary(verdicts)}.",
            "#### Not as printed",
            table(HEADINGS, [row(verdict) for verdict in apart]),
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
