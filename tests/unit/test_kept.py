"""Values that are kept between processes: made once for the same sources, anew for others."""

from pathlib import Path

import kept as kept_values
import pytest
from kept import digest_of_sources, kept

CALLS: list[int] = []


def counted() -> dict[str, int]:
    CALLS.append(1)
    return {"calls": len(CALLS)}


def test_a_value_is_made_once_for_the_same_sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    CALLS.clear()
    assert kept(counted, tmp_path) == kept(counted, tmp_path) == {"calls": 1}
    assert len(list(tmp_path.iterdir())) == 1
    monkeypatch.setattr(kept_values, "digest_of_sources", lambda: "other")
    assert kept(counted, tmp_path) == {"calls": 2}
    assert [path.name for path in tmp_path.iterdir()] == [f"{__name__}.counted.other"]


def test_each_change_of_a_source_changes_the_digest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for folder in kept_values.SOURCES:
        (tmp_path / folder).mkdir(parents=True)
    file = tmp_path / "src/ilmek/a.py"
    monkeypatch.setattr(kept_values, "ROOT", tmp_path)
    digests = []
    for text in ("x = 1", "x = 2", "x = 1\n"):
        file.write_text(text)
        digests.append(digest_of_sources.__wrapped__())
    file.rename(file.with_name("b.py"))
    digests.append(digest_of_sources.__wrapped__())
    assert len(set(digests)) == 4
