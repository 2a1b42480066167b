"""Odd environments: no traceback, whatever the variables hold."""

from pathlib import Path

import pytest
from processes import ended, ilmek

ENVIRONMENTS = {
    "a date in words, no home and no characters": {
        "SOURCE_DATE_EPOCH": "abc",
        "HOME": None,
        "LC_ALL": "C",
        "PYTHONUTF8": "0",
        "PYTHONIOENCODING": "ascii",
    },
    "a date beyond time, nothing writable": {
        "SOURCE_DATE_EPOCH": "9" * 30,
        "HOME": "/proc",
        "XDG_CACHE_HOME": "/proc/none",
        "MPLCONFIGDIR": "/proc/none",
    },
    "an unknown backend, a terminal of no size": {
        "MPLBACKEND": "nosuch",
        "TERM": "nosuch",
        "COLUMNS": "abc",
        "LINES": "-1",
    },
}


@pytest.mark.parametrize("name", ENVIRONMENTS)
@pytest.mark.one_in(3)
def test_an_odd_environment_does_no_harm(name: str, tmp_path: Path) -> None:
    done = ended(ilmek("design", "beat-up", "--report", tmp_path / "page.html"), changes=ENVIRONMENTS[name], text=False)
    assert done.returncode == 0, done.stderr
    assert b"Traceback" not in done.stderr
