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


def test_linkages_and_cams_run_where_only_numpy_and_scipy_are() -> None:
    """As in a browser: `docs/explanation/in-a-browser.md`."""
    statement = (
        "import ilmek as il, numpy as np; bar = il.four_bar(0.3, 0.06, 0.2, 0.23, points={'coupler.P': 0.1})\n"
        "motion = il.solve(bar, np.linspace(0, 6, 7), speed=1.0); il.judged(bar).limits('rocker')\n"
        "il.inverse_dynamics(motion, {'rocker': il.bar(0, 0.23, mass=1.0)}).table()\n"
        "il.plate_cam(il.cam_programme(il.rise(3.0, 0.02), il.fall(3.0, 0.02), il.dwell(2 * np.pi - 6)), 0.08)"
    )
    assert imported(statement, ("numba", "mapbox_earcut", "fcl", "manifold3d", "uharfbuzz", "rich")) == []


def test_a_page_compiles_nothing(tmp_path: Path) -> None:
    command = ["design", "warp-tension", "--report", str(tmp_path / "page.html")]
    statement = f"from ilmek.cli import main; main({command!r}, standalone_mode=False)"
    assert imported(statement, ("numba", "scipy.optimize", "matplotlib", "reportlab", "ezdxf", "OCP")) == []
