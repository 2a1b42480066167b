"""The sentences of the terminal in English."""

TERMINAL = {
    "terminal.note": "note: {text}",
    "terminal.checks": "checks: {passed} passed, {failed} failed",
    "terminal.weaves": "weaves: yes",
    "terminal.weaves-not": "weaves: NO, {count} reasons",
    "terminal.weaves-not-one": "weaves: NO, {count} reason",
    "terminal.nearest": "nearest that weaves: {text}",
    "terminal.must": "{value}, {source}",
    "terminal.must-be": "{value}, must be == {limit}",
    "terminal.at-most": "{value}, must be at most {limit}",
    "terminal.at-least": "{value}, must be at least {limit}",
    "terminal.also-of": "also every parameter of {machines}, as {first}.NAME=VALUE",
    "terminal.with-json": "with --json also: {names}",
    "terminal.tests": "tests of the computation: all {count} pass",
    "terminal.tests-one": "tests of the computation: the only one passes",
    "terminal.tests-failed": "tests of the computation: {failed} of {count} failed: {names}",
}
