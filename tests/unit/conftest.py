"""Fixtures of the unit tests."""

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from default_machines import out_of_space
from PIL import Image

from ilmek.viz.carpet_picture import WHOLE, DrawnCarpet


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
def not_in_space() -> Iterator[None]:
    """Looms whose parts are not compared in space."""
    with out_of_space():
        yield


@pytest.fixture
def plain_loom_page(monkeypatch: pytest.MonkeyPatch, not_in_space: None) -> None:
    """A title for loom.html, and no loom in space for it."""
    monkeypatch.setattr("ilmek.jobs.weave.loom_page", lambda page, *_: page.title)
    monkeypatch.setattr("ilmek.jobs.weave.loom_in_space", lambda *_: None)


@pytest.fixture
def plain_page(monkeypatch: pytest.MonkeyPatch, plain_loom_page: None) -> None:
    """Pages without figures, a small picture of the carpet, no loom in space: the true ones have tests of their own."""
    monkeypatch.setattr("ilmek.jobs.weave.carpet_page", lambda page, *_: page.title)
    monkeypatch.setattr("ilmek.machines.component.made_figures", lambda *_: ())
    monkeypatch.setattr("ilmek.jobs.chart.draw_carpet", lambda *_, **__: DrawnCarpet(Image.new("RGB", (2, 2)), WHOLE))


@pytest.fixture
def nothing_near(monkeypatch: pytest.MonkeyPatch) -> None:
    """No search of the nearest carpets where a loom cannot weave: it takes a minute, and has a test of its own."""
    monkeypatch.setattr("ilmek.jobs.nearest.nearest_fits", lambda *_: ())
