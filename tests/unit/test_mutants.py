"""The tool of `make mutants`: what it changes, and whether it sees that a test notices."""

import ast
from pathlib import Path

from mutants.__main__ import read_accepted, sampled
from mutants.operators import mutants_of, mutated
from processes import printed, python

SOURCE = """
LIMIT: float = 2.0 * mm
DOUBLE = 2 / LIMIT
CALL = lambda x: 9 + x
SMALL = 1e-6

def area(width: int, sides: list[float], number: int = 5) -> float:
    for _ in range(4):
        sides = sorted(sides)
    if width <= 3 or not sides:
        raise ValueError(f"{width + 1} is too small")
    return max(sides) * -width + LIMIT * abs(1e-9 - sides[0])

def draw_figure(width: int) -> int:
    return width + 1

class Shape:
    def __repr__(self) -> str:
        return 7 * "-"

def divided(width: float) -> list[float]:
    return np.linspace(0, round(width, 2), 7, endpoint=width > 3 * SMALL)
"""


def test_the_changes_of_a_function() -> None:
    assert {(one.function, one.before, one.after) for one in mutants_of("shapes", SOURCE)} == {
        ("", "2 / LIMIT", "2 * LIMIT"),
        ("", "2 / LIMIT", "2"),
        ("", "9 + x", "9 - x"),
        ("", "9", "10"),
        ("area", "width <= 3", "width > 3"),
        ("area", "width <= 3", "width < 3"),
        ("area", "3", "4"),
        ("area", "width <= 3 or not sides", "width <= 3 and (not sides)"),
        ("area", "not sides", "sides"),
        (
            "area",
            "max(sides) * -width + LIMIT * abs(1e-09 - sides[0])",
            "max(sides) * -width - LIMIT * abs(1e-09 - sides[0])",
        ),
        ("area", "max(sides) * -width", "max(sides) / -width"),
        ("area", "max(sides) * -width", "max(sides)"),
        ("area", "max(sides) * -width", "-width"),
        ("area", "max(sides)", "min(sides)"),
        ("area", "-width", "width"),
        ("area", "LIMIT * abs(1e-09 - sides[0])", "LIMIT / abs(1e-09 - sides[0])"),
        ("area", "LIMIT * abs(1e-09 - sides[0])", "LIMIT"),
        ("area", "LIMIT * abs(1e-09 - sides[0])", "abs(1e-09 - sides[0])"),
        ("area", "abs(1e-09 - sides[0])", "1e-09 - sides[0]"),
        ("area", "0", "1"),
        ("divided", "0", "1"),
        ("divided", "width > 3 * SMALL", "width <= 3 * SMALL"),
    }


def test_each_change_is_made_alone() -> None:
    whole = ast.unparse(ast.parse(SOURCE))
    for mutant in mutants_of("shapes", SOURCE):
        changed = ast.unparse(mutated(SOURCE, mutant))
        assert changed != whole
        assert [len(changed.splitlines()), changed.count("ValueError")] == [len(whole.splitlines()), 1]


def test_a_sample_is_that_of_its_seed() -> None:
    found = mutants_of("shapes", SOURCE)
    assert sampled(found, 5, 1) == sampled(found, 5, 1) != sampled(found, 5, 2)


def test_accepted_survivors_have_a_reason() -> None:
    assert read_accepted("# remark\n\nshapes area: 3 -> 4  # the same\n") == {"shapes area: 3 -> 4": "the same"}


FILES = {
    "pyproject.toml": "[tool.pytest.ini_options]\n",
    "shapes.py": "def counted(n):\n    while not n > 0:\n        pass\n    return n + 1 if 1.5 else 0\n",
    "test_shapes.py": "from shapes import counted\n\ndef test_counted():\n    assert counted(2) == 3\n",
}

SCRIPT = """
from pathlib import Path
from mutants.operators import mutants_of, mutated
from mutants.worker import Task, outcomes

source = Path("shapes.py").read_text()
changes = {one: ("shapes", mutated(source, one)) for one in mutants_of("shapes", source)}
hangs = lambda one: "n > 0" in one.before
tasks = ((one, Task(("test_shapes.py",), change, timeout=2 if hangs(one) else 60)) for one, change in changes.items())
for one, found in outcomes(Path.cwd(), tasks, 4):
    print(f"{one.before} -> {one.after}: {found.verdict} {found.test}".strip())
"""


def test_mutants_are_caught_survive_and_hang(tmp_path: Path) -> None:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    assert set(printed(python("-c", SCRIPT), cwd=tmp_path).splitlines()) == {
        "not n > 0 -> n > 0: timed out",
        "n > 0 -> n <= 0: timed out",
        "0 -> 1: survived",
        "n + 1 if 1.5 else 0 -> 0 if 1.5 else n + 1: caught test_shapes.py::test_counted",
        "n + 1 -> n - 1: caught test_shapes.py::test_counted",
        "1 -> 2: caught test_shapes.py::test_counted",
        "1.5 -> 1.6500000000000001: survived",
    }
