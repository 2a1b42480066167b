"""Small wrong changes of texts, trees, bytes and command lines; each a function of a random generator."""

import json
import math
import re
from collections.abc import Iterator, Sequence
from random import Random
from typing import Any

NUMBERS = (
    *("0", "-1", "1", "-0.0", "1e308", "-1e308", "1e-320", "1e400", "nan", "inf", "-inf", "1" * 400, "1e99999"),
    *("9223372036854775808", "-9223372036854775809", "0x10", "1_000", "1,5", "0.1.2", "١٢", "½", "1e", "--1", "255"),
    *("1e9", "1000000", "65536", "256", "1e-9", "0.5", "2", "3", "100000"),
)
UNITS = (
    *("mm", "m", "km", "um", "deg", "rad", "rpm", "s", "min", "h", "ms", "kg", "g", "N", "Nm", "%", "mm^2", "1/m"),
    *("km^400", "m^-99", "m^1e9", "m//s", "^", "mm mm", "°C", "µm", "/dm", "m/s^2", "hz", "ft", "MPa", "m^0.5", "*"),
)
FORMULA = '=HYPERLINK("http://x.test","y")'
SCRIPT = "<script>alert(1)</script>"
IMAGE = '"><img src=x onerror=alert(1)>'
TEXTS = (
    *("", " ", "a" * 3000, "名前", "İ", "ﬁ", "e\u0301", "\u202egnp", "\u2028", "a\nb", "a\tb", "\x7f", "\x9b31m"),
    *("\x1b[31mred\x1b[0m", "\x1b]0;title\x07", FORMULA, "+1+1", "@SUM(A1)", "-2+3", "\t=1", SCRIPT, IMAGE, "&lt;"),
    *("{{7*7}}", "${x}", "%s%n", "../up", ".", "..", "-", "--", "--help", "=", "a=", "=b", "a.b.c", "[" * 3000),
    *("'; DROP TABLE row;--", "None", "null", "true", "ground", "(" * 500 + "0" + ")" * 500, "\ufeff", "\\", '"', "'"),
)
BYTES = (b"\0", b"\xff", b"\xff\xfe", b"\xef\xbb\xbf", b"\x80", b"\r", b"\r\n", b"\x1b[2J", b"\xed\xa0\x80")

LONGEST_TEXT = 200_000
"""Largest number of letters of a changed text: repeated changes multiply it."""

_TOKEN = re.compile(r"[-+]?\d[\d.eE+-]*|\w+|\"[^\"\n]*\"|\s+|.", re.DOTALL)


def number(draw: Random) -> str:
    """A number: of the list, or any."""
    kind = draw.random()
    if kind < 0.5:
        return draw.choice(NUMBERS)
    return f"{draw.gauss(0, 1) * 10 ** draw.uniform(-4, 5):.6g}" if kind < 0.8 else str(draw.randint(-3, 400))


def quantity(draw: Random) -> str:
    """A number, mostly with a unit."""
    unit = draw.choice(UNITS) if draw.random() < 0.8 else ""
    return number(draw) + draw.choice(("", " ")) + unit


def scalar(draw: Random) -> str:
    """Any text that somebody could write for a value."""
    return draw.choice((number, quantity, lambda draw: draw.choice(TEXTS)))(draw)


def changed_text(draw: Random, text: str) -> str:
    """A text after one to four changes of its tokens or lines."""
    for _ in range(draw.choice((1, 1, 1, 2, 4))):
        text = draw.choice((_other_token, _other_token, _other_token, _other_lines))(draw, text)[:LONGEST_TEXT]
    return text


def _other_token(draw: Random, text: str) -> str:
    tokens = _TOKEN.findall(text) or [""]
    chosen = [index for index, token in enumerate(tokens) if not token.isspace()] or [0]
    index = draw.choice(chosen)
    change = draw.randrange(7)
    if change == 6:
        opening, closing = draw.choice((("[", "]"), ('{"a":', "}"), ("{a=", "}"), ("a.", "a"), ("(", ")"), ("-", "")))
        depth = draw.choice((2, 60, 600, 30_000))
        tokens[index] = opening * depth + closing * (depth if draw.random() < 0.6 else 1)
    elif change == 0:
        del tokens[index]
    elif change == 1:
        tokens.insert(index, tokens[draw.choice(chosen)])
    elif change == 2 and tokens[index][:1].isdigit():
        tokens[index] = number(draw)
    elif change == 3:
        tokens[index] = tokens[draw.choice(chosen)]
    elif change == 4:
        tokens[index] *= draw.choice((2, 3, 50))
    else:
        tokens[index] = scalar(draw)
    return "".join(tokens)


def _other_lines(draw: Random, text: str) -> str:
    lines = text.splitlines(keepends=True) or [""]
    first, second = draw.randrange(len(lines)), draw.randrange(len(lines))
    change = draw.randrange(4)
    if change == 0:
        del lines[first : first + draw.choice((1, 1, 3, 100))]
    elif change == 1:
        lines.insert(second, lines[first])
    elif change == 2:
        lines[first], lines[second] = lines[second], lines[first]
    else:
        lines[first] *= draw.choice((2, 20, 300))
    return "".join(lines)


def changed_tree(draw: Random, tree: Any) -> Any:
    """A tree of dicts and lists after one to three changes."""
    for _ in range(draw.choice((1, 1, 1, 2, 3))):
        nodes = list(_nodes(tree))
        if nodes:
            _change_node(draw, *draw.choice(nodes), nodes)
    return tree


def _change_node(draw: Random, holder: Any, key: Any, nodes: Sequence[tuple[Any, Any]]) -> None:
    change = draw.randrange(8)
    if change == 0:
        del holder[key]
    elif change == 1 and isinstance(holder, dict):
        holder[draw.choice((draw.choice(TEXTS), f"{key} ", str(key).upper()))] = holder.pop(key)
    elif change == 2:
        other, name = draw.choice(nodes)
        holder[key] = _copied(other[name])
    elif change == 3:
        holder[key] = draw.choice(([holder[key]], {"a": holder[key]}))
    elif change == 4:
        holder[key] = _nested(draw.choice((3, 30, 80)), draw.choice("[{"))
    elif change == 5 and isinstance(holder, list):
        holder.extend(_copied(holder[key]) for _ in range(draw.choice((1, 1, 5, 300))))
    elif isinstance(holder[key], str) and change == 6:
        holder[key] = changed_text(draw, holder[key])
    else:
        holder[key] = _leaf(draw)


def _leaf(draw: Random) -> Any:
    values = (0, -1, 1, 2, 0.5, 1e308, 1e-320, math.nan, math.inf, 2**63, 2**31, 10**400, True, None, "", [], {}, 1e9)
    return draw.choice(values) if draw.random() < 0.5 else scalar(draw)


def _nodes(tree: Any) -> Iterator[tuple[Any, Any]]:
    """Every holder with its key or index."""
    for key, value in list(tree.items()) if isinstance(tree, dict) else list(enumerate(tree)):
        yield tree, key
        if isinstance(value, dict | list):
            yield from _nodes(value)


def _copied(tree: Any) -> Any:
    return json.loads(json.dumps(tree)) if isinstance(tree, dict | list) else tree


def _nested(depth: int, bracket: str) -> Any:
    tree: Any = 0
    for _ in range(depth):
        tree = [tree] if bracket == "[" else {"a": tree}
    return tree


def toml(tree: Any) -> str:
    """A tree as TOML, tables within tables in one line."""
    if not isinstance(tree, dict):
        return inline(tree)
    return "".join(f"{json.dumps(str(key))} = {inline(value)}\n" for key, value in tree.items())


def inline(value: Any) -> str:
    """A value of TOML in one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(str(key))} = {inline(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=not value.isprintable())
    if isinstance(value, bool):
        return str(value).lower()
    return "null" if value is None else str(value)


def changed_bytes(draw: Random, content: bytes) -> bytes:
    """Bytes after one to eight changes: cut, repeated, replaced, numbers of a header made large."""
    data = bytearray(content)
    for _ in range(draw.choice((1, 1, 2, 8))):
        at = int(len(data) * draw.random() ** draw.choice((1, 1, 4)))
        change = draw.randrange(7)
        if change == 0:
            data[at : at + 1] = bytes([draw.randrange(256)])
        elif change == 1:
            del data[at : at + draw.choice((1, 4, 50, 10**6))]
        elif change == 2:
            data[at:at] = data[at : at + draw.choice((1, 8, 64))] * draw.choice((1, 2, 100))
        elif change == 3:
            large = draw.choice((0, 1, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF, 1 << 24, 100_000))
            data[at : at + 4] = large.to_bytes(4, draw.choice(("big", "little")))
        elif change == 4:
            data[at : at + 2] = draw.choice((b"\0\0", b"\xff\xff", b"\x7f\xff", b"\0\x01"))
        elif change == 5:
            data[at:at] = draw.choice(BYTES) * draw.choice((1, 1, 1000))
        elif data:
            data[at % len(data)] ^= 1 << draw.randrange(8)
    return bytes(data)


def changed_line(draw: Random, words: Sequence[str]) -> list[str]:
    """A command line after one or two changes of its words."""
    words = list(words)
    for _ in range(draw.choice((1, 1, 2))):
        at = draw.randrange(len(words)) if words else 0
        some = draw.choice(words) if words else ""
        flag = draw.choice(("--help", "--json", "--force", "--out", "--nothing", "-x", "--set"))
        kind = draw.randrange(7)
        if kind < 4:
            words[at : at + 1] = (
                (),
                (some, *words[at : at + 1]),
                (scalar(draw), *words[at : at + 1]),
                (scalar(draw),),
            )[kind]
        elif kind == 4:
            words[at : at + 1] = [changed_text(draw, one) for one in words[at : at + 1]]
        else:
            words.append(some if kind == 5 else flag)
    return words
