"""Inputs by number: command lines with files, most of them nearly right."""

import json
import os
from collections.abc import Callable
from random import Random
from typing import Any

from designs import random_settings

from fuzz.case import COMMANDS, MINE, OLD, TAKEN, Case
from fuzz.corpus import (
    CYCLOGRAMS,
    PATH_CSV,
    QUALITY,
    SIZE,
    VALUES,
    YARNS_CSV,
    Corpus,
    changed_png,
    changed_programme,
    old_result,
)
from fuzz.mutations import (
    TEXTS,
    changed_bytes,
    changed_line,
    changed_text,
    changed_tree,
    quantity,
    scalar,
    toml,
)
from ilmek.loom.twin.faults import StopParams
from ilmek.machines import ENTRIES
from ilmek.params import declared

SPOILT = 0.08
"""Share of the command lines that are changed word by word."""

ON_A_TERMINAL = 0.1
"""Share of the inputs that run on a terminal."""

SLOW_MACHINES = {"automated-loom": 0.25, "path-four-bar": 0.3, "motion-four-bar": 0.5, "knotting-dyad": 0.5}
"""Weights of machines whose design takes long, in relation to the others."""

_MACHINES, _WEIGHTS = tuple(ENTRIES), tuple(SLOW_MACHINES.get(name, 1.0) for name in ENTRIES)
_JSON = (("--json", "-"),) * 3 + (("--json", "new.json"), (), ())
_ENVIRONMENTS: tuple[dict[str, str], ...] = (
    {"SOURCE_DATE_EPOCH": "abc"},
    {"SOURCE_DATE_EPOCH": "-1"},
    {"SOURCE_DATE_EPOCH": "99999999999999999"},
    {"MPLBACKEND": "nosuch"},
    {"COLUMNS": "0"},
    {"COLUMNS": "3"},
    {"TERM": "dumb"},
    {"NO_COLOR": "1"},
    {"LC_ALL": "C"},
    {"TZ": "nowhere/at all"},
)

Words = list[str]
Files = dict[str, bytes]


def make_case(corpus: Corpus, seed: int) -> Case:
    """The input of this number."""
    draw = Random(seed)
    words, files = draw.choices(_MAKERS, _SHARES)[0](draw, corpus)
    if draw.random() < SPOILT:
        words = changed_line(draw, words)
    if draw.random() < 0.02 and files:
        words = [*words, draw.choice(("--json", "--out", "--report", "--csv")), draw.choice(list(files))]
    if OLD in words:
        files |= old_result(draw)
        words += draw.choice(([], ["--force"], ["--force"]))
    environment = draw.choice(_ENVIRONMENTS) if draw.random() < 0.03 else {}
    return Case(tuple(map(_typed, words)), files, environment, draw.random() < ON_A_TERMINAL)


def _typed(word: str) -> str:
    """A word as a process can get it: short, no NUL; lone surrogates only as bytes that are not UTF-8."""
    plain = word.replace("\0", "")[:30_000]
    try:
        os.fsencode(plain)
    except UnicodeEncodeError:
        return plain.encode("utf-8", "replace").decode()
    return plain


def _given(draw: Random, share: float, option: str, value: Callable[[Random], str]) -> Words:
    return [option, value(draw)] if draw.random() < share else []


def _one_of(*values: str) -> Callable[[Random], str]:
    return lambda draw: draw.choice(values) if draw.random() < 0.85 else scalar(draw)


def _output(draw: Random, ending: str) -> str:
    """A path of an output: mostly new, else taken, missing, a device or an input."""
    if draw.random() < 0.7:
        return f"new{ending}"
    others = (
        TAKEN,
        f"{TAKEN}/{MINE}",
        OLD,
        f"{OLD}/yarn.csv",
        f"gone/new{ending}",
        "/dev/full",
        "/dev/null/x",
        ".",
        "",
        f"{'n' * 300}{ending}",
    )
    return draw.choice(
        (*others, f"new{ending}", f"új ={ending}", f"-{ending}", f"a\x1b[31m{ending}", f"\udcff{ending}")
    )


def _json(draw: Random) -> Words:
    chosen = list(draw.choice(_JSON))
    return [chosen[0], _output(draw, ".json")] if chosen[1:] == ["new.json"] else chosen


def _settings(draw: Random, machine: str, files: Files) -> list[str]:
    """Settings of a machine; few from a file."""
    settings = random_settings(machine, draw, most=draw.choice((1, 2, 4))) if draw.random() < 0.95 else {}
    if draw.random() < 0.1 and settings:
        settings[draw.choice(list(settings))] = scalar(draw)
    if draw.random() < 0.05 and settings:
        name = draw.choice(list(settings))
        text = settings[name].encode("utf-8", "replace") if draw.random() < 0.5 else draw.choice(VALUES)
        files["value.txt"] = text if draw.random() < 0.4 else changed_bytes(draw, text)
        settings[name] = draw.choice(("@value.txt", "@value.txt", "@gone.txt", f"@{TAKEN}", "@", "@/dev/null"))
    return [f"{name}={value}" for name, value in settings.items()]


def design(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    machine = draw.choices(_MACHINES, _WEIGHTS)[0]
    files: Files = {}
    settings = [word for one in _settings(draw, machine, files) for word in ("--set", one)]
    words = ["design", machine, *settings, *_json(draw)]
    words += _given(draw, 0.06, "--report", lambda draw: _output(draw, ".html"))
    if draw.random() < 0.03:
        words += ["--workshop", _output(draw, "")]
        words += _given(draw, 0.5, "--tolerance", _one_of("1um", "0.01deg", "0.01%"))
    return words + draw.choice(([], [], [], ["--force"])), files


def machines(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    return ["machines", *draw.choice(([], [draw.choice(_MACHINES)], [scalar(draw)])), *_json(draw)], {}


def _tree_file(draw: Random, tree: Any, text: bytes | None = None) -> tuple[str, bytes]:
    """A tree as TOML or JSON, changed as a tree, as a text, as bytes, or not."""
    kind = draw.random()
    tree = json.loads(json.dumps(tree))
    if kind < 0.5:
        tree = changed_tree(draw, tree)
    name = draw.choice(("given.toml", "given.toml", "given.json"))
    if text is not None and kind > 0.75:
        name, written = "given.toml", text.decode()
    else:
        written = toml(tree) if name.endswith("toml") else json.dumps(tree, ensure_ascii=draw.random() < 0.5)
    if 0.65 < kind < 0.8:
        written = changed_text(draw, written)
    content = written.encode("utf-8", "surrogatepass")
    if kind > 0.95:
        content = changed_bytes(draw, content)
    return (name if draw.random() < 0.97 else draw.choice(("given", "given.JSON", "given.csv"))), content


def mechanism(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    source = draw.choice(list(corpus.mechanisms))
    name, content = _tree_file(draw, corpus.mechanisms[source], corpus.texts[source])
    words = ["mechanism", name, *_json(draw)]
    words += _given(draw, 0.06, "--at", _one_of("30deg", "A0=30deg", "O=1rad", "Q=0", "10mm"))
    words += _given(draw, 0.12, "--over", _one_of("-40deg..40deg", "0..1rad", "0deg..360deg", "1..1", "..", "0mm..5mm"))
    words += _given(draw, 0.2, "--speed", _one_of("60rpm", "1m/s", "0rpm", "-3rad/s"))
    words += _given(draw, 0.3, "--steps", _one_of("1", "2", "36", "360", "2000", "0", "1000001"))
    words += _given(draw, 0.15, "--csv", lambda draw: draw.choice(("-", _output(draw, ".csv"))))
    words += _given(draw, 0.07, "--report", lambda draw: _output(draw, ".html"))
    return words + _given(draw, 0.07, "--as", _one_of("toml", "json")), {name: content}


def cyclogram(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    files: Files = {}
    if draw.random() < 0.12:
        machine = draw.choice((*CYCLOGRAMS, "weaver", "weaver", "cam"))
        given = [machine]
        given += [word for one in _settings(draw, machine.partition(":")[0], files) for word in ("--set", one)]
    else:
        source = draw.choice(list(corpus.cyclograms))
        name, content = _tree_file(draw, corpus.cyclograms[source], corpus.texts[source])
        files[name], given = content, [name]
    words = ["cyclogram", *given, *_json(draw)]
    words += _given(draw, 0.3, "--solve", _one_of("acceleration", "period", "jerk"))
    words += _given(draw, 0.2, "--steps", _one_of("1", "7", "720", "0"))
    words += _given(draw, 0.15, "--csv", lambda draw: draw.choice(("-", _output(draw, ".csv"))))
    words += _given(draw, 0.1, "--out", lambda draw: _output(draw, draw.choice((".toml", ".json", ".txt"))))
    return words + _given(draw, 0.07, "--report", lambda draw: _output(draw, ".html")), files


def _random_path(draw: Random) -> bytes:
    """A path of random points."""
    points = [f"{draw.uniform(-5, 30):.3f},{draw.uniform(-9, 9):.3f}" for _ in range(draw.choice((2, 3, 8, 40, 400)))]
    return ("\n".join(("x [mm],y [mm]", *points)) + "\n").encode()


def knot(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    content = draw.choice((PATH_CSV, _random_path(draw), b"=1+1,y\n1,2\n"))
    kind = draw.random()
    if kind < 0.35:
        content = changed_text(draw, content.decode()).encode("utf-8", "surrogatepass")
    elif kind < 0.45:
        content = changed_bytes(draw, content)
    words = ["knot", "path.csv", *(["path.csv"] if draw.random() < 0.1 else [])]
    words += _given(draw, 0.6, "--pitch", _one_of("2mm", "4mm", "20mm", "0mm", "1um"))
    words += _given(draw, 0.3, "--warps", _one_of("1", "2", "12", "300", "10000", "0"))
    words += _given(draw, 0.15, "--first", _one_of("(0mm,0mm)", "(1mm,-1mm)", "(0,0)", "(-7um,3mm)", "(0,0) (1,1)"))
    words += _given(draw, 0.2, "--keep-out", _one_of("0mm", "0.1mm", "0.3mm"))
    if draw.random() < 0.1:
        headings = (("x", "y"), ("y", "x"), ("x [mm]", "y [mm]"), ("x", "x"), ("z", scalar(draw)))
        words += ["--columns", *draw.choice(headings)]
    words += draw.choice(([], [], ["--smooth"], ["--closed"], ["--smooth", "--closed"])) + _json(draw)
    return words + _given(draw, 0.05, "--report", lambda draw: _output(draw, ".html")), {"path.csv": content}


def _picture(draw: Random, corpus: Corpus) -> tuple[str, bytes]:
    name = draw.choice(list(corpus.pictures))
    content = corpus.pictures[name]
    kind = draw.random()
    if kind < 0.15 and name.endswith("png"):
        content = changed_png(draw, content)
    elif kind < 0.5:
        content = changed_bytes(draw, content)
    elif kind < 0.55:
        content += corpus.pictures[draw.choice(list(corpus.pictures))]
    return (name if draw.random() < 0.95 else draw.choice(("pict", "=1.png", "ü b.jpg", "a\x1b[31m.png"))), content


def _yarns(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    kind = draw.random()
    if kind > 0.35:
        return [], {}
    if kind < 0.2:
        text = YARNS_CSV.decode()
        text = changed_text(draw, text) if draw.random() < 0.7 else text.replace("madder", draw.choice(TEXTS))
        content = text.encode()
        return ["--yarns", "yarns.csv"], {"yarns.csv": content if draw.random() < 0.9 else changed_bytes(draw, content)}
    _, content = _tree_file(draw, corpus.yarns, corpus.texts["wool.toml"])
    return ["--yarns", "yarns.toml"], {"yarns.toml": content}


def _carpet(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    name, content = _picture(draw, corpus)
    words, files = _yarns(draw, corpus)
    words = ["--size", SIZE, "--quality", QUALITY, *words]
    if draw.random() < 0.12:
        words[1] = draw.choice(("kelle", "1x1m", "10x10cm", "100000x100000km", "0x5cm", scalar(draw), quantity(draw)))
    if draw.random() < 0.12:
        words[3] = draw.choice(
            ("40raj", "5x5/dm", "9/60", "90line", "62500/m2", "1e9x1e9/dm", scalar(draw), quantity(draw))
        )
    words += _given(draw, 0.1, "--knot", _one_of("symmetric", "asymmetric", "jufti"))
    words += _given(draw, 0.2, "--colours", _one_of("2", "5", "16", "255", "1", "-1", "auto"))
    words += _given(draw, 0.1, "--fit", _one_of("crop", "pad", "stretch", "turn", "fill"))
    words += _given(draw, 0.1, "--crop", _one_of("1,1;7,6", "10%,10% 90%,90%", "3,3;3,9", "a", "0,0;1e9,1e9"))
    words += _given(draw, 0.1, "--turn", _one_of("90deg", "-3deg", "45deg", "400deg", "1e-9rad"))
    words += _given(draw, 0.1, "--corners", _one_of("auto", "1,1;7,1;7,7;1,7", "1,1;7,7;7,1;1,7", "0,0;0,0;0,0;0,0"))
    words += _given(draw, 0.1, "--keep", _one_of("ivory", "gold;rose", "a yarn", '"', ",,"))
    words += _given(draw, 0.1, "--least-share", _one_of("1%", "20%", "100%", "-1%"))
    words += _given(draw, 0.1, "--propose", _one_of("2", "9", "64", "65", "x"))
    words += _given(draw, 0.1, "--pile-height", _one_of("8mm", "0mm", "1km"))
    words += draw.choice(([], [], [], ["--least-patch", "3"], ["--no-pdf"], ["--pdf"])) + _json(draw)
    folder = _output(draw, "") if draw.random() < 0.4 else draw.choice(("new", OLD))
    words += _given(draw, 0.5, "--out", _one_of(folder))
    words += draw.choice(([], [], ["--force"]))
    return [name, *words], {name: content, **files}


def chart(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    words, files = _carpet(draw, corpus)
    return ["chart", *words], files


def weave(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    words, files = _carpet(draw, corpus)
    words += draw.choice((["--heads", "2"], ["--heads", "1"], ["--deadline", "100h"], ["--deadline", "1h"], []))
    words += _given(draw, 0.05, "--heads", _one_of("3", "0", "999"))
    words += _given(draw, 0.05, "--deadline", _one_of("1s", "72", "50h"))
    words += _given(draw, 0.1, "--warp-pitch", _one_of("20mm", "10mm", "0mm", "1mm"))
    words += _given(draw, 0.1, "--aim", _one_of("price", "time", "speed"))
    if draw.random() < 0.15:
        loom = json.loads(json.dumps(corpus.loom))
        if draw.random() < 0.5:
            loom = {"machine": loom["machine"], "parameters": loom["parameters"]}
        files["loom.json"] = json.dumps(changed_tree(draw, loom) if draw.random() < 0.8 else loom).encode()
        return ["weave", *words, "--loom", "loom.json"], files
    for one in _settings(draw, "automated-loom", files) if draw.random() < 0.7 else []:
        words += ["--loom", one]
    return ["weave", *words], files


def inspect(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    content = changed_programme(draw, corpus.programme) if draw.random() < 0.93 else corpus.programme
    row = _given(draw, 0.7, "--row", _one_of("1", "2", "3", "4", "16", "0", "17", "-1", "99999999999999999999"))
    return ["inspect", "given.ilmek", *row, *_json(draw)], {"given.ilmek": content}


def _programme(draw: Random, corpus: Corpus) -> tuple[str, bytes]:
    """A programme of either form, most of them changed."""
    if draw.random() < 0.2:
        return "given.ilmek", changed_programme(draw, corpus.programme)
    description, row, rows = corpus.programme_text.partition("row 1\n")
    choice = draw.random()
    if choice < 0.25:
        description = changed_text(draw, description)
    elif choice < 0.85:
        at = draw.randrange(len(rows))
        rows = rows[:at] + changed_text(draw, rows[at : at + 600]) + rows[at + 600 :]
    content = f"{description}{row}{rows}".encode("utf-8", "replace")
    return "given.txt", changed_bytes(draw, content) if choice > 0.95 else content


def check(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    name, content = _programme(draw, corpus)
    return ["check", name, *_json(draw)], {name: content}


def convert(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    name, content = _programme(draw, corpus)
    return ["convert", name, draw.choice(("new.ilmek", "new.txt", "new.csv", name))], {name: content}


def simulate(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    files = {"given.ilmek": changed_programme(draw, corpus.programme) if draw.random() < 0.2 else corpus.programme}
    words = ["simulate", "given.ilmek", *_json(draw)]
    words += _given(draw, 0.5, "--seeds", _one_of("0", "1", "5", "20", "20", "-1"))
    words += _given(draw, 0.3, "--seed", _one_of("7", "8", "9", "-1"))
    words += _given(draw, 0.2, "--deadline", _one_of("1s", "72", "50h"))
    words += _given(draw, 0.2, "--out", _one_of("new", TAKEN))
    words += _given(draw, 0.1, "--shown", _one_of("rows", "knots"))
    names = [one.name for one in declared(StopParams)]
    for _ in range(draw.randrange(4)):
        words += ["--set", f"{draw.choice(names)}={draw.choice(('0', '0.3', '1', '30s', '2/km', scalar(draw)))}"]
    if draw.random() < 0.3:
        values = ("0.1", "3", '"2min"', "[1]", "nan")
        lines = [f"{draw.choice(names)} = {draw.choice(values)}" for _ in range(3)]
        files["stops.toml"] = "\n".join(lines).encode()
        words += ["--stops", "stops.toml"]
    return words, files


def reproduce(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    return ["reproduce", "--paper", draw.choice((*_PAPERS, scalar(draw))), *_json(draw)], {}


def other_words(draw: Random, corpus: Corpus) -> tuple[Words, Files]:
    words = [
        draw.choice((*COMMANDS, scalar(draw), "--version", "-h", "weav", "--help")) for _ in range(draw.randrange(4))
    ]
    return [word for one in words for word in (one, *draw.choice(((), (), ("--help",), (scalar(draw),))))], {}


_PAPERS = ("beat-up", "knotting", "tufting", "thesis")
_MAKERS = (
    design, machines, mechanism, cyclogram, knot, chart, weave, inspect, check, convert, simulate, reproduce,
    other_words,
)  # fmt: skip
_SHARES = (0.24, 0.03, 0.15, 0.11, 0.1, 0.13, 0.02, 0.07, 0.05, 0.02, 0.05, 0.005, 0.025)


def usual_cases(corpus: Corpus) -> list[Case]:
    """Inputs that are right: every command and machine once."""
    files = {
        "rgb.png": corpus.pictures["rgb.png"],
        "path.csv": PATH_CSV,
        "given.ilmek": corpus.programme,
        **corpus.texts,
    }
    carpet = ("rgb.png", "--size", SIZE, "--quality", QUALITY, "--out", "new")
    lines = [
        ("weave", *carpet, "--deadline", "100h"),
        ("chart", *carpet, "--yarns", "wool.toml"),
        ("inspect", "given.ilmek"),
        ("check", "given.ilmek"),
        ("convert", "given.ilmek", "new.txt"),
        ("simulate", "given.ilmek", "--seeds", "5", "--out", "new"),
        ("knot", "path.csv", "--report", "new.html"),
        ("design", "cam", "--workshop", "new", "--report", "new.html"),
        *(("design", machine, "--json", "-") for machine in _MACHINES),
        *(("machines", machine) for machine in _MACHINES),
        *(("mechanism", name, "--csv", "new.csv") for name in corpus.mechanisms),
        *(("cyclogram", name, "--solve", "acceleration") for name in corpus.cyclograms),
        ("cyclogram", "press.toml", "--solve", "period"),
        *(("reproduce", "--paper", paper) for paper in _PAPERS),
    ]
    return [Case(line, {name: files[name] for name in line if name in files}) for line in lines]
