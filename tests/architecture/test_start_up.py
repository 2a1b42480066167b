"""What must stay light: a command imports what it uses."""

import json
from pathlib import Path

import pytest
from processes import printed, python

ROOT = Path(__file__).parents[2]
FIGURES = ("matplotlib", "PIL", "reportlab", "jinja2", "ezdxf", "OCP", "ilmek.viz")
HEAVY = ("numpy", "scipy", "numba", "jaxtyping", *FIGURES)
NO_TABLES = ("scipy", "numba", "jaxtyping", "rich", *FIGURES)
PLOTS = ("jaxtyping", "rich", "ilmek.dynamics.forward", *FIGURES)
COMMANDS = {
    "--help": HEAVY,
    "machines": (*HEAVY, "ilmek.report", "ilmek.machines.catalogue"),
    "machines --json -": (*NO_TABLES, "ilmek.machines.catalogue"),
    "design warp-tension --json -": (*NO_TABLES, "ilmek.machines.beat_up", "ilmek.carpet"),
    "design cam --json -": NO_TABLES,
    "design weaver --json -": ("scipy.optimize", "scipy.interpolate", "numba", "jaxtyping", "rich", *FIGURES),
    "design warp-tension": ("scipy", "numba", "jaxtyping", *FIGURES),
    "mechanism examples/quick_return.toml --json -": (*PLOTS, "scipy.integrate", "scipy.interpolate", "numba"),
    "knot examples/gripper_path.csv --json -": (*NO_TABLES, "ilmek.machines.catalogue", "ilmek.linkage"),
}
"""Commands, and what they must not import."""


def imported(statement: str, names: tuple[str, ...]) -> list[str]:
    """Those of the modules that a statement imports."""
    script = f"import sys, json\n{statement}\nprint('\\n' + json.dumps([m for m in {names!r} if m in sys.modules]))"
    found: list[str] = json.loads(printed(python("-c", script), cwd=ROOT).splitlines()[-1])
    return found


def test_the_package_itself_imports_nothing() -> None:
    assert imported("import ilmek", HEAVY) == []


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.one_in(2)
def test_a_command_imports_what_it_uses(command: str) -> None:
    statement = f"from ilmek.cli import main; main({command.split()!r}, standalone_mode=False)"
    assert imported(statement, COMMANDS[command]) == []


def test_a_page_compiles_nothing(tmp_path: Path) -> None:
    command = ["design", "warp-tension", "--report", str(tmp_path / "page.html")]
    statement = f"from ilmek.cli import main; main({command!r}, standalone_mode=False)"
    assert imported(statement, ("numba", "scipy.optimize", "matplotlib", "reportlab", "ezdxf", "OCP")) == []
