"""The shipped client of the studio is the build of its sources; proved without Node, by digests.

`npm run build` in studio/ writes `build.json` beside the built files: see studio/scripts/stamp.mjs.
"""

import gzip
import hashlib
import json
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
STUDIO, CLIENT = ROOT / "studio", ROOT / "src/ilmek/web/client"
SOURCES = re.findall(
    r'"([^"]+)"', re.search(r"const SOURCES = \[(.*?)\]", (STUDIO / "scripts/stamp.mjs").read_text(), re.DOTALL)[1]
)
"""Files and folders that enter the build."""

LARGEST_FIRST_LOAD = 63_000
"""Bytes, compressed, of the first page with the view of the carpet."""


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _below(folder: Path, base: Path) -> dict[str, Path]:
    files = [folder] if folder.is_file() else [path for path in folder.rglob("*") if path.is_file()]
    return {path.relative_to(base).as_posix(): path for path in files}


def _stamp() -> dict[str, object]:
    stamp: dict[str, object] = json.loads((CLIENT / "build.json").read_text())
    return stamp


def test_the_shipped_build_is_that_of_the_sources() -> None:
    found = {name: path for part in SOURCES for name, path in _below(STUDIO / part, STUDIO).items()}
    names = sorted(name for name in found if not re.search(r"\.test\.tsx?$", name))
    lines = "".join(f"{_digest(found[name].read_bytes())}  {name}\n" for name in names)
    assert _stamp()["sources"] == _digest(lines.encode()), "build it by: npm run build (in studio/)"


def test_the_shipped_files_are_those_of_the_build() -> None:
    found = {name: _digest(path.read_bytes()) for name, path in _below(CLIENT, CLIENT).items() if name != "build.json"}
    assert found == _stamp()["files"]


def test_nothing_that_only_developers_need_is_shipped() -> None:
    assert not [name for name in _below(CLIENT, CLIENT) if name.endswith((".map", ".ts", ".tsx"))]


def test_the_first_load_is_small() -> None:
    index = (CLIENT / "index.html").read_text(encoding="utf-8")
    first = re.findall(r'(?:src|href)="\./([^"]+)"', index)
    carpet = [path.relative_to(CLIENT).as_posix() for path in (CLIENT / "assets").glob("carpet-*")]
    assert first
    assert {Path(name).suffix for name in carpet} == {".js", ".css"}
    loaded = _imported([*first, *carpet]) | {"index.html"}
    assert sum(len(gzip.compress((CLIENT / name).read_bytes(), 6)) for name in loaded) <= LARGEST_FIRST_LOAD


def _imported(names: list[str]) -> set[str]:
    """Files, and those that they import at once."""
    found: set[str] = set()
    while names:
        name = names.pop()
        if name in found:
            continue
        found.add(name)
        text = (CLIENT / name).read_text(encoding="utf-8") if name.endswith(".js") else ""
        names += [f"assets/{one}" for one in re.findall(r'(?:from|import)\s*"\./([^"]+\.js)"', text)]
    return found


def test_each_view_is_loaded_when_it_is_opened() -> None:
    index = (CLIENT / "index.html").read_text(encoding="utf-8")
    views = [path.name for path in (STUDIO / "src/views").iterdir() if path.is_dir()]
    for view in views:
        assert list((CLIENT / "assets").glob(f"{view}-*.js")), f"no file of its own for {view}"
        assert f"assets/{view}-" not in index


def test_the_page_has_no_inline_script_or_style() -> None:
    index = (CLIENT / "index.html").read_text(encoding="utf-8")
    assert re.search(r"<script(?![^>]*\bsrc=)|<style|\sstyle=|\son\w+=", index) is None


def test_the_lock_file_names_no_host() -> None:
    assert "://" not in (STUDIO / "package-lock.json").read_text(encoding="utf-8")


def test_the_lock_file_has_every_optional_package() -> None:
    packages = json.loads((STUDIO / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    optional = {name for package in packages.values() for name in package.get("optionalDependencies", {})}
    assert optional <= {path.rpartition("node_modules/")[2] for path in packages}, "npm ci refuses the lock file"
