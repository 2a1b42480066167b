"""Lists of the parts of a tree for purchase and workshop: parts, stock to be cut, bought parts, fasteners.

bars of a section = bins of the bar's length for its pieces, each with its saw cut: first fit, the longest first
their least number = ceil(sum of lengths with cuts / length of a bar)                  [Dosa: FFD <= 11/9 least + 2/3]
"""

import math
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence

from ilmek.elements.prices import PriceRates, price_of
from ilmek.part.assemblies import drawings_of_parts
from ilmek.part.bill import line_of
from ilmek.part.blanks import PLATE, blanks_of, sold_as
from ilmek.part.contacts import joined_by
from ilmek.part.part import Part
from ilmek.part.tightening import tightening_of
from ilmek.part.tree import Tree
from ilmek.report import Table, columns
from ilmek.sentences import Sentence
from ilmek.units import mm

BARS, WHOLE = (1.0, 2.0, 3.0, 6.0, 12.0), 6.0
"""Lengths in which bars and tubes are sold [m], and that of a whole one: less is cut from it by its dealer."""

SAW = 3 * mm
"""Width of a saw cut [m]; assumed by this project."""

FASTENER = "fastener"
"""Process of screws and keys."""

BELTS = frozenset(("belt", "belt and pulleys"))
"""Processes of belts."""


def part_lists(tree: Tree, prices: Mapping[str, PriceRates]) -> tuple[Table, ...]:
    """The lists of a tree: `parts`, `cut-list`, `purchase`, `fasteners`."""
    return parts_list(tree, prices), cut_list(tree), purchase_list(tree, prices), fastener_list(tree)


def parts_list(tree: Tree, prices: Mapping[str, PriceRates]) -> Table:
    """A row for each part: its number is its position in the list, its drawing that of its id where it is made, its
    assemblies the drawings of those that it is put into.
    """
    heads = columns(
        "number | id | title | drawing | assemblies | quantity | make or buy | size | material | process"
        " | mass of one [kg] 6 | price of all | designation | fixing"
    )
    rows, assemblies = [], drawings_of_parts(tree)
    for position, (part, number) in enumerate(tree.occurrences(), 1):
        line, bought = line_of(part, number), part.purchase
        source = (part.designation, "make" if bought is None else "buy")
        drawing = part.id if bought is None else ""
        material = sold_as(part)
        into = " ".join(assemblies[part.id])
        made = position, part.id, part.title, drawing, into, number, source[1], line.description, material, part.process
        rows.append((*made, part.mass, price_of(line, prices), source[0], part.fixing))
    return Table("parts", Sentence("list.parts"), heads, tuple(rows))


def distinct_titles(tree: Tree) -> dict[str, str]:
    """Titles of the parts by their ids; of parts of one title each with so much of its designation, or of its size, as
    tells it from the others.
    """
    named: dict[str, list[Part]] = defaultdict(list)
    for part, _ in tree.occurrences():
        named[part.title].append(part)
    titles = {own[0].id: title for title, own in named.items() if len(own) == 1}
    for own in (parts for parts in named.values() if len(parts) > 1):
        words = [[part.title, *(part.designation or line_of(part, 1).description).split(", ")] for part in own]
        distinct = len({*map(tuple, words)})
        enough = next(k for k in range(1, 100) if len({tuple(word[:k]) for word in words}) == distinct)
        titles |= {part.id: ", ".join(filter(None, word[:enough])) for part, word in zip(own, words, strict=True)}
    return titles


def purchase_list(tree: Tree, prices: Mapping[str, PriceRates]) -> Table:
    """A row for each designation of bought parts, with all parts that are ordered by it; pieces with their whole."""
    ordered: dict[tuple[str, str, float], list[tuple[Part, int]]] = defaultdict(list)
    pieces: dict[str, list[tuple[Part, int]]] = defaultdict(list)
    for part, number in tree.occurrences():
        if part.purchase is not None and part.purchase.piece_of:
            pieces[part.purchase.piece_of].append((part, number))
        elif part.purchase is not None:
            ordered[part.process, part.designation, part.purchase.length].append((part, number))
    heads = columns("designation | kind | length of one [m] | quantity | mass of all [kg] 6 | price of all | parts")
    rows = []
    for (kind, row, length), parts in sorted(ordered.items()):
        whole = [*parts, *(piece for part, _ in parts for piece in pieces[part.id])]
        number = sum(count for _, count in parts)
        more = math.fsum(
            count * part.purchase.length for part, count in whole if part.purchase and part.purchase.piece_of
        )
        mass = math.fsum(count * part.mass for part, count in whole)
        price = math.fsum(price_of(line_of(part, count), prices) for part, count in whole)
        ids = " ".join(part.id for part, _ in whole)
        rows.append((row or kind, kind, length + more / number or math.nan, number, mass, price, ids))
    return Table("purchase", Sentence("list.purchase"), heads, tuple(rows))


def cut_list(tree: Tree) -> Table:
    """A row for each section of stock: its pieces by length, their sum, and the bars that they are cut from."""
    stock: dict[tuple[str, str], list[tuple[float, int, str]]] = defaultdict(list)
    for part, number in tree.occurrences():
        for blank in blanks_of(part):
            if blank.form != PLATE and part.material is not None:
                stock[blank.name, sold_as(part)].append((blank.length, number, part.id))
    heads = columns("section | material | pieces | lengths | length of all [m] 6 | saw cut [m] | length of a bar [m]")
    heads = (*heads, *columns("bars | pieces of each bar | least number of bars | parts"))
    rows = []
    for (section, material), cuts in sorted(stock.items()):
        pieces = [length for length, number, _ in cuts for _ in range(number)]
        bar = _bar_for(pieces)
        named = "; ".join(f"{number} x {cut_length(length)} mm" for length, number, _ in cuts)
        least = math.ceil(math.fsum(piece + SAW for piece in pieces) / (bar + SAW) - 1e-9)
        ids = " ".join(name for _, _, name in cuts)
        bars = bars_for(pieces, bar)
        nested = "; ".join(f"{count} x ({_counted(own)})" for own, count in Counter(bars).items())
        lengths = math.fsum(pieces), SAW, bar, len(bars)
        rows.append((section, material, len(pieces), named, *lengths, nested, least, ids))
    return Table("cut-list", Sentence("list.cut"), heads, tuple(rows))


def _counted(pieces: Sequence[float]) -> str:
    """The pieces of a bar, those of one length together."""
    return " + ".join(f"{number} x {length}" for length, number in Counter(map(cut_length, pieces)).items())


def _bar_for(pieces: Sequence[float]) -> float:
    """Length of the bars for some pieces [m]: the least with room for all, else a whole one, or the longest piece.

    >>> _bar_for((0.4, 0.5)), _bar_for((0.5, 0.5)), _bar_for((2.0,) * 9), _bar_for((7.0, 1.0))
    (1.0, 2.0, 6.0, 12.0)
    """
    all_of_them = math.fsum(pieces) + (len(pieces) - 1) * SAW
    least = min(all_of_them, max(*pieces, WHOLE))
    return next((offered for offered in BARS if least <= offered + 1e-9), max(pieces))


def bars_for(pieces: Sequence[float], bar: float) -> tuple[tuple[float, ...], ...]:
    """The pieces of each bar of a length [m]: each in the first with room for it and its saw cut, the longest first.

    >>> bars_for((2.0, 4.0, 3.0, 2.9), 6.0)
    ((4.0,), (3.0, 2.9), (2.0,))
    """
    bars: list[list[float]] = []
    for piece in sorted(pieces, reverse=True):
        room = (own for own in bars if math.fsum(own) + piece + len(own) * SAW <= bar + 1e-9)
        first = next(room, None)
        if first is None:
            bars.append([piece])
        else:
            first.append(piece)
    return tuple(map(tuple, bars))


def fastener_list(tree: Tree) -> Table:
    """A row for each fastener: the parts that it touches, which it joins, and the torque of a screw or nut."""
    fasteners = [(part, number) for part, number in tree.occurrences() if part.process == FASTENER]
    joined = joined_by(tree, frozenset(part.id for part, _ in fasteners))
    heads = columns("designation | id | quantity | joins | and | tightening torque [Nm] 3 | preload [N] 3")
    return Table(
        "fasteners",
        Sentence("list.fasteners"),
        heads,
        tuple(_fastener(part, number, joined[part.id]) for part, number in fasteners),
    )


def _fastener(part: Part, number: int, joined: Sequence[str]) -> tuple[str | int | float, ...]:
    assert part.purchase is not None
    turned = tightening_of(part)
    tightened = (math.nan, math.nan) if turned is None else (turned.torque, turned.preload)
    first, *others = (*joined, "")
    return part.purchase.row, part.id, number, first, " ".join(filter(None, others)), *tightened


def cut_length(length: float) -> str:
    """A length that is sawn, in mm to a tenth.

    >>> cut_length(1.8191834), cut_length(0.04)
    ('1819.2', '40')
    """
    return f"{length / mm:.1f}".removesuffix(".0")
