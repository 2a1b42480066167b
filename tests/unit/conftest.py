"""Fixtures of the unit tests."""

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest


@pytest.fixture
def memory(tmp_path: Path) -> Iterator[Path]:
    """A folder in memory, where the system has such; thousands of folders are made in it."""
    shared = Path("/dev/shm")
    if not os.access(shared, os.W_OK):
        yield tmp_path
        return
    with tempfile.TemporaryDirectory(dir=shared) as folder:
        yield Path(folder)


@pytest.fixture
def plain_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages and a picture of the carpet that are made at once; the true ones have tests of their own."""
    for name in ("carpet_page", "loom_page"):
        monkeypatch.setattr(f"ilmek.jobs.weave.{name}", lambda page, *_: page.title)
    monkeypatch.setattr("ilmek.jobs.chart.write_carpet_png", lambda path, *_: path.write_bytes(b""))
