"""The leaf formulas compiled: the same numbers as on arrays, NaN where there is no answer; what is kept of them."""

import hashlib
import importlib
import pickle
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from processes import ended, printed, python

from ilmek.cli import main
from ilmek.linkage.groups import rrp, rrr
from ilmek.num import machine_code
from ilmek.num.compiled import COMPILATIONS, compiled, uncounted
from ilmek.num.machine_code import discarded

RNG = np.random.default_rng(7)
A, B = (RNG.normal(size=200) + 1j * RNG.normal(size=200) for _ in range(2))


def test_rrr_position_is_the_same_compiled():
    kernel = compiled(rrr.first_link)
    with np.errstate(invalid="ignore"):
        on_arrays = rrr.position(A, B, 1.0, 1.5, -1)
    one_by_one = np.array([a + kernel(b - a, 1.0, 1.5, -1)[0] for a, b in zip(A, B, strict=True)])
    assert 0 < np.isnan(on_arrays).sum() < 200
    np.testing.assert_allclose(one_by_one, on_arrays, rtol=0, atol=1e-13)


def test_rrp_position_is_the_same_compiled():
    kernel = compiled(rrp.reach)
    e = np.exp(0.3j)
    with np.errstate(invalid="ignore"):
        on_arrays = rrp.position(A, B, e, 1.2, +1)
    one_by_one = np.array([kernel(a - b, e, 1.2, +1)[0] for a, b in zip(A, B, strict=True)])
    assert 0 < np.isnan(on_arrays).sum() < 200
    np.testing.assert_allclose(one_by_one, on_arrays, rtol=0, atol=1e-13)


def test_division_by_zero_is_infinite_not_an_error():
    kernel = compiled(rrp.link_rate)
    assert np.isinf(kernel(1 + 0j, 1 + 1j, 0.0))


def test_an_uncounted_kernel_changes_its_arrays_and_makes_none():
    def halve(numbers: np.ndarray) -> None:
        part = numbers[1:]
        for i in range(len(part)):
            part[i] /= 2.0

    def made(count: int) -> float:
        return float(np.ones(count)[0])

    numbers = np.array([8.0, 6.0, 4.0])
    references = sys.getrefcount(numbers)
    uncounted(halve)(numbers)
    assert numbers.tolist() == [8.0, 3.0, 2.0]
    assert sys.getrefcount(numbers) == references
    assert compiled(made)(3) == 1.0
    with pytest.raises(Exception, match="array passed into the function"):
        uncounted(made)(3)


FILES = {
    "constants": "SCALE = 2.0\nUNUSED = 1.0\n",
    "leaf": '''
from ilmek.num import machine_code
from ilmek.num.compiled import compiled
from sample.constants import SCALE

@compiled
def leaf(x: float) -> float:
    """Doc."""
    return SCALE * x
''',
    "outer": """
from ilmek.num import machine_code
from ilmek.num.compiled import compiled
from sample import leaf as module

@compiled
def outer(x: float) -> float:
    return module.leaf(x) + 1.0
""",
    "lone": "from ilmek.num.compiled import compiled\n\n@compiled\ndef lone(x: float) -> float:\n    return x - 1.0\n",
}


@pytest.fixture
def sample(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., dict[str, bool]]:
    """Writes a package of kernels with some texts replaced, runs it, and returns which kernels had to be compiled."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    (tmp_path / "sample").mkdir()

    def run(
        edits: dict[str, tuple[str, str]] | None = None, results: tuple[float, float] = (7.0, 2.0)
    ) -> dict[str, bool]:
        for name, text in FILES.items():
            (tmp_path / "sample" / f"{name}.py").write_text(text.replace(*(edits or {}).get(name, ("", ""))))
        for name in [name for name in sys.modules if name.partition(".")[0] == "sample"]:
            del sys.modules[name]
        importlib.invalidate_caches()
        outer, lone = (importlib.import_module(f"sample.{name}") for name in ("outer", "lone"))
        kernels = {"outer": outer.outer, "leaf": outer.module.leaf, "lone": lone.lone}
        assert (outer.outer(3.0), lone.lone(3.0)) == results
        return {
            name: any(calls.stats.cache_misses for calls in (kernel.dispatcher, kernel.inner_dispatcher))
            for name, kernel in kernels.items()
        }

    return run


def entries(tmp_path: Path) -> list[Path]:
    return sorted((tmp_path / "cache").rglob("*.kernel"))


def test_nothing_is_compiled_twice(sample):
    assert sample() == {"outer": True, "leaf": True, "lone": True}
    assert sample() == {"outer": False, "leaf": False, "lone": False}


def test_a_compilation_is_announced_before_it_begins(sample, monkeypatch):
    numbers: list[int] = []
    monkeypatch.setattr(COMPILATIONS, "listener", numbers.append)
    first = COMPILATIONS.number + 1
    sample()
    assert numbers == [first, first + 1, first + 2]
    sample()
    assert len(numbers) == 3


@pytest.mark.parametrize(
    ("edits", "results", "compiled_anew"),
    [
        ({"leaf": ("SCALE * x", "x * SCALE - 1.0")}, (6.0, 2.0), {"outer", "leaf"}),
        ({"constants": ("SCALE = 2.0", "SCALE = 3.0")}, (10.0, 2.0), {"outer", "leaf"}),
        ({"lone": ("x - 1.0", "x - 2.0")}, (7.0, 1.0), {"lone"}),
        ({"outer": ("+ 1.0", "+ 2.0")}, (8.0, 2.0), {"outer"}),
        ({"leaf": ("compiled\n", "uncounted\n")}, (7.0, 2.0), {"outer", "leaf"}),
        ({"leaf": ("Doc.", "Other words.")}, (7.0, 2.0), set()),
        ({"constants": ("UNUSED = 1.0", "# a remark\nUNUSED = 5.0")}, (7.0, 2.0), set()),
    ],
    ids=["callee", "constant", "alone", "caller", "uncounted", "docstring", "unrelated"],
)
def test_an_edit_compiles_the_kernels_that_it_changes_and_no_other(sample, edits, results, compiled_anew):
    sample()
    assert {name for name, anew in sample(edits, results).items() if anew} == compiled_anew


@pytest.mark.parametrize("damage", ["empty", "cut", "zeros", "foreign"])
def test_a_damaged_entry_is_rebuilt(sample, tmp_path, damage):
    sample()
    for entry in entries(tmp_path):
        whole = entry.read_bytes()
        foreign = pickle.dumps(("no", "kernel"))
        damaged = {
            "empty": b"",
            "cut": whole[: len(whole) // 2],
            "zeros": whole[:999] + bytes(len(whole) - 999),
            "foreign": hashlib.sha256(foreign).digest() + foreign,
        }
        entry.write_bytes(damaged[damage])
    assert sample() == {"outer": True, "leaf": True, "lone": True}
    assert sample() == {"outer": False, "leaf": False, "lone": False}


def test_a_damaged_entry_is_noted_once_for_each(sample, tmp_path):
    sample()
    before = len(discarded)
    for entry in entries(tmp_path):
        entry.write_bytes(b"")
    sample()
    assert sorted(discarded[before:]) == entries(tmp_path)
    sample()
    assert len(discarded) == before + 3


def test_damaged_entries_are_one_note_of_the_run(monkeypatch, capsys):
    monkeypatch.setattr(machine_code, "discarded", [Path("cache", "a.kernel"), Path("cache", "b.kernel")])
    for shown in ("note: 2 damaged kernels in cache were removed and built anew\n", ""):
        with pytest.raises(SystemExit):
            main.main(["machines"])
        assert capsys.readouterr().err == shown


def test_without_a_private_folder_nothing_is_kept(sample, tmp_path):
    folder = tmp_path / "cache" / "ilmek" / "kernels"
    folder.mkdir(parents=True)
    folder.chmod(0o755)
    sample()
    assert list(folder.iterdir()) == []


def test_with_bounds_check_an_index_outside_is_an_error():
    script = (
        "import numpy as np\nfrom ilmek.num.compiled import compiled\n"
        "@compiled\ndef at(x: object, i: int) -> float:\n    return x[i]\n"
        "print(at(np.zeros(2), 1))\nat(np.zeros(2), 2)"
    )
    shown = ended(python("-c", script), changes={"ILMEK_BOUNDS_CHECK": "1"})
    assert (shown.stdout, "IndexError" in shown.stderr) == ("0.0\n", True)


def test_modules_with_kernels_load_no_compiler():
    script = "import sys, ilmek.linkage.batch, ilmek.loom.order; print('numba' in sys.modules)"
    assert printed(python("-c", script)) == "False\n"
