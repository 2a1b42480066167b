"""Odd environments: no traceback, whatever the variables hold."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ENVIRONMENTS = {
    "a date in words": {"SOURCE_DATE_EPOCH": "abc"},
    "a date beyond time": {"SOURCE_DATE_EPOCH": "9" * 30},
    "an unknown backend": {"MPLBACKEND": "nosuch"},
    "no home and no characters": {"HOME": None, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"},
    "nothing writable": {"HOME": "/proc", "XDG_CACHE_HOME": "/proc/none", "MPLCONFIGDIR": "/proc/none"},
    "a terminal of no size": {"TERM": "nosuch", "COLUMNS": "abc", "LINES": "-1"},
}


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_an_odd_environment_does_no_harm(name: str, tmp_path: Path) -> None:
    changed = {**os.environ, **ENVIRONMENTS[name]}
    kept = {key: value for key, value in changed.items() if value is not None}
    words = ["design", "beat-up", "--report", str(tmp_path / "page.html")]
    done = subprocess.run([sys.executable, "-m", "ilmek", *words], env=kept, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert b"Traceback" not in done.stderr
