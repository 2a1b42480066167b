"""Runs test files in a forked process in which one module is a mutant, or in which the functions run are recorded.

The process that forks has loaded the libraries, but nothing of ilmek: each child loads it with its own mutant.
"""

import ast
import importlib
import importlib.abc
import importlib.machinery
import itertools
import multiprocessing
import os
import sys
import threading
import time
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing import connection
from multiprocessing.connection import Connection
from multiprocessing.context import ForkProcess
from pathlib import Path
from types import CodeType, FrameType, ModuleType
from typing import Any, TypeVar

import pytest
from hypothesis import Phase, settings
from hypothesis.errors import InvalidArgument

OPTIONS = (
    *("-q", "-p", "no:cacheprovider", "-p", "no:xdist", "--doctest-modules", "--import-mode=importlib"),
    *("-W", "ignore::pytest.PytestAssertRewriteWarning"),  # hypothesis was loaded before the fork
    *("-o", "addopts=", "-o", "pythonpath=src tests/support ."),
)
LIBRARIES = (
    "numpy",
    "scipy.optimize",
    "scipy.linalg",
    "scipy.spatial",
    "numba",
    "PIL.Image",
    "ezdxf",
    "click.testing",
    "jaxtyping",
)
RECORDED_EXAMPLES = 10
"""Examples of a property while functions are recorded: the recording takes about as long as the others would."""
FORK = multiprocessing.get_context("fork")
K = TypeVar("K")
CAUGHT, SURVIVED, TIMED_OUT = "caught", "survived", "timed out"


@dataclass
class Outcome:
    """What a run found: verdict, the test that failed, functions that were run, seconds of each file."""

    verdict: str
    test: str = ""
    functions: dict[str, list[str]] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)


def load_libraries() -> None:
    """What every child needs, loaded once before they are forked."""
    for name in LIBRARIES:
        with suppress(ImportError):
            importlib.import_module(name)


@dataclass(frozen=True)
class Task:
    """Test files to run, from the repository's root, until one test fails.

    mutant  a module's name and what it is replaced by
    record  the package whose functions are recorded; then all tests are run
    """

    files: tuple[str, ...]
    mutant: tuple[str, ast.Module] | None = None
    record: str = ""
    timeout: float = 600.0


def outcomes(root: Path, tasks: Iterable[tuple[K, Task]], jobs: int = 1) -> Iterator[tuple[K, Outcome]]:
    """The outcome of each task, as they end; so many at a time."""
    waiting, running = iter(tasks), dict[Connection, tuple[K, ForkProcess, float]]()
    while True:
        for key, task in itertools.islice(waiting, jobs - len(running)):
            receiver, sender = FORK.Pipe(duplex=False)
            child = FORK.Process(target=_child, args=(sender, root, task))
            child.start()
            sender.close()
            running[receiver] = key, child, time.monotonic() + task.timeout
        if not running:
            return
        next_end = min(end for _, _, end in running.values())
        ready = connection.wait(list(running), max(0.0, next_end - time.monotonic()))
        for receiver, (key, child, end) in list(running.items()):
            if receiver in ready or time.monotonic() >= end:
                yield key, _received(receiver, child, receiver in ready)
                del running[receiver]


def _received(receiver: Connection, child: ForkProcess, ready: bool) -> Outcome:
    outcome = Outcome(TIMED_OUT)
    if ready:
        try:
            outcome = receiver.recv()
        except EOFError:
            outcome = Outcome(CAUGHT, "the process died")
    child.kill()
    child.join()
    receiver.close()
    return outcome


def _child(sender: Connection, root: Path, task: Task) -> None:
    os.chdir(root)
    sys.path[:0] = [str(root / "src"), str(root)]
    silent = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(silent, stream)
    plugin = _Plugin(task.record)
    try:
        if task.mutant:
            sys.meta_path.insert(0, _Finder(*task.mutant))
            importlib.import_module(task.mutant[0])
        first_failure = () if task.record else ("-x",)
        code = int(pytest.main([*OPTIONS, *first_failure, *task.files], plugins=[plugin])) if task.files else 0
    except BaseException as error:  # the mutant cannot even be loaded
        code, plugin.failed = 1, repr(error)[:200]
    sender.send(Outcome(CAUGHT if code else SURVIVED, plugin.failed, plugin.functions(), plugin.seconds))
    os._exit(0)


class _Plugin:
    """Notes the first failure, the seconds of each file, and the functions that were run."""

    def __init__(self, package: str) -> None:
        self.package, self.failed = package, ""
        self.seconds: dict[str, float] = {}
        self.codes: dict[str, set[CodeType]] = {}
        self.kernels: set[Any] = set()
        self.file = ""

    def pytest_configure(self) -> None:
        usual = settings.default
        with suppress(InvalidArgument):
            usual = settings.get_profile("ilmek")
        few = {"max_examples": RECORDED_EXAMPLES} if self.package else {}
        settings.register_profile("mutants", parent=usual, phases=[Phase.explicit, Phase.generate], **few)
        settings.load_profile("mutants")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.seconds[self.file] = self.seconds.get(self.file, 0.0) + report.duration
        if report.failed and not self.failed:
            self.failed = report.nodeid

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed and not self.failed:
            self.failed = report.nodeid

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        self.file = nodeid.partition("::")[0]
        if self.package:
            self.codes.setdefault(self.file, set())
            sys.setprofile(self._called)
            threading.setprofile(self._called)

    def pytest_runtest_logfinish(self) -> None:
        sys.setprofile(None)
        threading.setprofile(None)  # type: ignore[arg-type]

    def _called(self, frame: FrameType, event: str, _: object) -> None:
        if event == "call":
            self.codes[self.file].add(frame.f_code)
            if frame.f_code.co_qualname == "Kernel.__call__":
                self.kernels.add((self.file, frame.f_locals["self"]))

    def functions(self) -> dict[str, list[str]]:
        """`module function` of all that was run, by test file; kernels with those that they call."""
        names = {
            Path(module.__file__ or ""): name
            for name, module in list(sys.modules.items())
            if self._is_own(name, module)
        }
        found = {
            file: {
                f"{names[Path(code.co_filename)]} {plain(code.co_qualname)}"
                for code in codes
                if Path(code.co_filename) in names
            }
            for file, codes in self.codes.items()
        }
        for file, kernel in self.kernels:
            found[file] |= {f"{one.__module__} {plain(one.__qualname__)}" for one in _called_kernels(kernel)}
        return {file: sorted(used) for file, used in found.items()}

    def _is_own(self, name: str, module: ModuleType) -> bool:
        return bool(self.package) and name.partition(".")[0] == self.package and bool(getattr(module, "__file__", None))


def plain(qualname: str) -> str:
    """A qualified name without the marks of functions within functions, as `operators` writes it."""
    parts = [part for part in qualname.replace("<locals>.", "").split(".") if not part.startswith("<")]
    return ".".join(parts)


def _called_kernels(kernel: Any) -> set[Any]:
    """The functions of a kernel and of all kernels that it calls."""
    found, left = set(), [kernel]
    while left:
        function = left.pop().function
        if function not in found:
            found.add(function)
            used = (function.__globals__.get(name) for name in function.__code__.co_names)
            left += [value for value in used if isinstance(value, type(kernel))]
    return found


class _Finder(importlib.abc.MetaPathFinder):
    """Finds one module, and gives it the mutant's code."""

    def __init__(self, module: str, tree: ast.Module) -> None:
        self.module, self.tree = module, tree

    def find_spec(self, name: str, path: Any, target: Any = None) -> importlib.machinery.ModuleSpec | None:
        if name != self.module:
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path, target)
        assert spec is not None
        assert spec.origin is not None
        spec.loader = _Loader(name, spec.origin, self.tree)
        return spec


class _Loader(importlib.machinery.SourceFileLoader):
    def __init__(self, name: str, path: str, tree: ast.Module) -> None:
        super().__init__(name, path)
        self.tree = tree

    def get_code(self, fullname: str) -> CodeType:  # noqa: ARG002 - the name of the signature
        return compile(self.tree, self.path, "exec", dont_inherit=True)
