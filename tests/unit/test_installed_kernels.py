"""Kernels that are installed with the package: used where they fit, ignored where they do not."""

import os
import sys
import zipfile
from pathlib import Path

import llvmlite.binding
import pytest
from processes import printed, python

from ilmek.num import installed_kernels
from ilmek.num.installed_kernels import baseline, compiler_settings, pack, read_installed

SCRIPT = """
import sys
from pathlib import Path
from ilmek.num import installed_kernels
installed_kernels.ARCHIVE = Path(sys.argv[1])
from warps import length
print(length(2.0, 3), length.dispatcher.stats.cache_misses != {})
"""
KERNEL = """
from ilmek.num.compiled import compiled

@compiled
def length(pitch: float, warps: int) -> float:
    return pitch * (warps - 1)
"""


def run(folder: Path, archive: Path, **settings: str) -> str:
    """What the kernel gives in a new process, and whether it was compiled there."""
    (folder / "warps.py").write_text(KERNEL, encoding="utf-8")
    paths = os.pathsep.join([str(folder), *sys.path])
    changes = {"PYTHONPATH": paths, "XDG_CACHE_HOME": str(folder / "cache"), **settings}
    return printed(python("-c", SCRIPT, archive), changes=changes).strip()


def test_what_is_installed_is_not_compiled(tmp_path: Path) -> None:
    archive = tmp_path / "kernels.zip"
    triple = llvmlite.binding.get_default_triple()
    if baseline(triple) is None:
        with pytest.raises(KeyError):
            compiler_settings(triple)
        return
    builder, user, other = (tmp_path / name for name in ("builder", "user", "other"))
    for folder in (builder, user, other):
        folder.mkdir()
    assert run(builder, archive, **compiler_settings(triple)) == "4.0 True"
    assert pack(builder.rglob("*.kernel"), archive) == 1
    assert run(user, archive) == "4.0 False"
    assert run(other, archive, ILMEK_INSTALLED_KERNELS="no") == "4.0 True"


@pytest.mark.parametrize("damage", ["missing", "no archive", "cut", "changed"])
def test_a_damaged_archive_is_as_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damage: str) -> None:
    archive = tmp_path / "kernels.zip"
    with zipfile.ZipFile(archive, "w") as packed:
        packed.writestr("a.kernel", b"machine code" * 99)
    whole = archive.read_bytes()
    contents = {"no archive": b"text", "cut": whole[:-30], "changed": whole.replace(b"machine", b"Machine", 1)}
    archive.unlink() if damage == "missing" else archive.write_bytes(contents[damage])
    monkeypatch.setattr(installed_kernels, "ARCHIVE", archive)
    installed_kernels._archive.cache_clear()
    try:
        assert read_installed("a.kernel") is None
    finally:
        installed_kernels._archive.cache_clear()
