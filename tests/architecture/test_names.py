"""One name, one thing; and the words of names and of the texts that users see are those of the field."""

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from default_machines import default_report
from sources import tree_of

from ilmek.cli import main
from ilmek.machines.catalogue import MACHINES
from ilmek.params import reachable
from ilmek.records import declared_results
from ilmek.report import Report

PACKAGE = Path(__file__).parents[2] / "src" / "ilmek"
SOURCES = sorted(PACKAGE.rglob("*.py"))

BANNED = {"asked", "course", "courses", "freed", "freedom", "freedoms", "hang", "hangs", "held", "hung", "place"}
BANNED |= {"places", "reckoned", "said", "told", "unsaid", "wanted", "way", "ways"}
"""Words that no module, class, public function, parameter or attribute is named by: the field has its own."""

BANNED_IN_TEXTS = BANNED - {"held"}
"""The same for texts that users see; yarn may be held by a gripper."""

TERMS = re.compile(r"degrees?[ _]of[ _]freedom")
"""Terms of the field that contain such a word."""

STABLE = {"Track.held", "track(held)"}
"""Names that users see in files or in JSON, and that therefore stay: `held` of a track of a cyclogram."""

UNFINISHED: set[str] = set()
"""Packages in which the names of functions, parameters and attributes are not yet checked."""


def banned(text: str, words: set[str] = BANNED_IN_TEXTS) -> list[str]:
    """The banned words in a text or a name, in alphabetical order."""
    return sorted(set(re.findall(r"[a-z]+", TERMS.sub("", text.lower()))) & words)


def public_classes() -> dict[str, list[str]]:
    """Where each public class of the package is defined."""
    found: dict[str, list[str]] = defaultdict(list)
    for path in SOURCES:
        for node in tree_of(path).body:
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


def signature(function: ast.FunctionDef, owner: str = "") -> Iterator[str]:
    """The names of a function and its parameters: `owner.f`, `owner.f(x)`."""
    yield f"{owner}{function.name}"
    given = function.args
    for one in (*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg):
        if one is not None:
            yield f"{owner}{function.name}({one.arg})"


def attributes(kind: ast.ClassDef) -> Iterator[str]:
    """The names of a class' public attributes, methods and parameters of methods."""
    for node in kind.body:
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.target.id[0] != "_":
            yield f"{kind.name}.{node.target.id}"
        if isinstance(node, ast.FunctionDef) and (node.name[0] != "_" or node.name == "__init__"):
            yield from signature(node, f"{kind.name}.")


def public_names(path: Path) -> Iterator[str]:
    """The names of a module's public functions, their parameters, its constants and the attributes of its classes."""
    for node in tree_of(path).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield from signature(node)
        elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from attributes(node)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (one.id for one in targets if isinstance(one, ast.Name) and not one.id.startswith("_"))


def checked_part(name: str) -> str:
    """The last part of a name: the parameter, else the attribute or function."""
    return re.sub(r".*[.(](?=\w)", "", name)


def test_public_functions_parameters_and_attributes_are_named_in_words_of_the_field() -> None:
    bad = [
        f"{path.relative_to(PACKAGE)}: {name}"
        for path in SOURCES
        if path.relative_to(PACKAGE).parts[0] not in UNFINISHED
        for name in public_names(path)
        if banned(checked_part(name), BANNED) and name not in STABLE
    ]
    assert bad == []


def commands() -> dict[str, click.Command]:
    context = click.Context(main)
    return {name: command for name in main.list_commands(context) if (command := main.get_command(context, name))}


def test_help_texts_are_in_words_of_the_field() -> None:
    texts = {f"{name}, summary": line for name, (_, line) in main.modules.items()}
    for name, command in {"ilmek": main, **commands()}.items():
        texts[name] = f"{command.help} {command.epilog}"
        texts |= {f"{name} {option.name}": getattr(option, "help", None) or "" for option in command.params}
    assert len(texts) > 60
    assert {name: banned(text) for name, text in texts.items() if banned(text)} == {}


@pytest.mark.parametrize("name", MACHINES)
def test_parameters_and_results_are_described_in_words_of_the_field(name: str) -> None:
    machine = MACHINES[name]
    texts = {"title": machine.title, "summary": machine.summary}
    texts |= {f"parameter {key}": one.doc for key, one in reachable(machine.params).items()}
    texts |= {f"result {one.name}": one.meaning for one in declared_results(*machine.reported)}
    assert {key: banned(text) for key, text in texts.items() if banned(text)} == {}


def reports(report: Report) -> Iterator[Report]:
    """A report and those of its machines."""
    yield report
    for child in report.children:
        yield from reports(child)


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.one_in(3)
def test_tables_and_figures_are_named_in_words_of_the_field(name: str) -> None:
    machine = MACHINES[name]
    texts = []
    for report in reports(default_report(machine.name)):
        texts += [text for table in report.tables for text in (table.title, *(one.heading for one in table.columns))]
        texts += [f"{figure.title} {figure.note}" for figure in report.figures]
    assert [text for text in texts if banned(text)] == []
