"""One name, one thing: public class names, and the words that names are made of."""

import ast
import re
from collections import defaultdict
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "src" / "ilmek"
SOURCES = sorted(PACKAGE.rglob("*.py"))

BANNED = {"asked", "course", "freed", "freedom", "freedoms", "hang", "held", "hung", "place", "places"}
BANNED |= {"reckoned", "said", "told", "unsaid", "wanted", "way", "ways"}
"""Words of which no public class and no module is named: the field has its own."""


def public_classes() -> dict[str, list[str]]:
    """Where each public class of the package is defined."""
    found: dict[str, list[str]] = defaultdict(list)
    for path in SOURCES:
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                found[node.name].append(str(path.relative_to(PACKAGE)))
    return found


def test_a_class_name_means_one_thing() -> None:
    assert {name: paths for name, paths in public_classes().items() if len(paths) > 1} == {}


def test_classes_are_named_in_words_of_the_field() -> None:
    words = {name: {word.lower() for word in re.findall(r"[A-Z]+[a-z0-9]*", name)} for name in public_classes()}
    assert {name: sorted(parts & BANNED) for name, parts in words.items() if parts & BANNED} == {}


def test_modules_are_named_in_words_of_the_field() -> None:
    assert [str(path.relative_to(PACKAGE)) for path in SOURCES if set(path.stem.split("_")) & BANNED] == []
