"""What the repository must not hold: machine paths, addresses in the lock, left-overs."""

import re
from pathlib import Path

import pytest
from processes import ended

ROOT = Path(__file__).parents[2]


def tracked() -> list[Path]:
    listed = ended(["git", "ls-files", "-z"], cwd=ROOT)
    if listed.returncode:
        pytest.fail(f"git ls-files: {listed.stderr}")
    return [ROOT / name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file()]


TEXTS = [path for path in tracked() if path.suffix in {".py", ".md", ".toml", ".txt", ".html", ".css", ".cfg", ""}]


def test_no_machine_path() -> None:
    pattern = re.compile(r"(?<![\w./-])/(?:root|home|mnt|work)/[a-z]")
    found = [path.name for path in TEXTS if pattern.search(path.read_text(encoding="utf-8"))]
    assert found == []


def test_lock_names_no_host() -> None:
    lock = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    assert "//" not in lock
    assert all(re.fullmatch(r"[\w.-]+==[\w.+-]+", line) for line in lock.splitlines() if line)


def test_no_left_overs_in_the_sources() -> None:
    pattern = re.compile(r"\b(?:TODO|FIXME|XXX|NotImplementedError)\b")
    assert [
        path.name for path in TEXTS if "src" in path.parts and pattern.search(path.read_text(encoding="utf-8"))
    ] == []
