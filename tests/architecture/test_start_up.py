"""What must stay light: `import ilmek` and `ilmek --help` load no numerics."""

import json
import subprocess
import sys

import pytest

HEAVY = ("numpy", "scipy", "numba", "matplotlib", "PIL", "reportlab", "jinja2", "ezdxf", "OCP")


@pytest.mark.parametrize(
    "statement",
    ["import ilmek", "from ilmek.cli import main; main(['--help'], standalone_mode=False)"],
    ids=["import", "help"],
)
def test_loads_no_numerics(statement: str) -> None:
    script = f"import sys, json\n{statement}\nprint(json.dumps([m for m in {HEAVY!r} if m in sys.modules]))"
    shown = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert json.loads(shown.stdout.splitlines()[-1]) == []
