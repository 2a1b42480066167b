"""Cures in Turkish, put together from what they advise: `set a larger lift, or fewer heads`.

    set a, b, or c                  a, b ya da c seçin
    leave a to the design           a tasarıma bırakın

Each thing is a parameter, which keeps its name, a setting `name=value`, or a noun with adjectives in the comparative.
"""

import re
from collections.abc import Callable, Mapping

_PAIRS = """
larger = daha büyük | greater = daha büyük | smaller = daha küçük | higher = daha yüksek | lower = daha düşük
longer = daha uzun | shorter = daha kısa | thicker = daha kalın | thinner = daha ince | heavier = daha ağır
lighter = daha hafif | finer = daha ince | coarser = daha kaba | wider = daha geniş | narrower = daha dar
broader = daha enli | stiffer = daha rijit | stronger = daha dayanıklı | deeper = daha derin | fewer = daha az
more = daha çok | slower = daha yavaş | quicker = daha hızlı | faster = daha hızlı | another = başka | other = başka
"""
_NOUNS = """
needle = iğne | links = uzuv | link = uzuv | opening = açıklık (opening) | pile yarn = hav ipliği | yarn = iplik
pitch = çözgü adımı | warp pitch = çözgü adımı | warps = çözgü | warp = çözgü | quality = kalite | comb = tarak
quality along = boyuna kalite | supports = destek | teeth = diş | leaf = yaprak | reach = erişim (reach)
reach of it = erişim | lift = kalkma (lift) | lead = adım (lead) | speed = hız (speed)
spacer_tube with a thicker wall = daha kalın cidarlı spacer_tube | speed of the crank = krank hızı | beater = tefe
beaters = tefe | run-up = kalkış | tension = gerginlik (tension) | tension of the warps = çözgü gerginliği
arm = kol (arm) | bearing = yatak | stub = muylu | clearance = boşluk (clearance) | force = kuvvet (force)
carpet = halı | leg = leg | margin = pay (margin) | opening of the arms = kol açıklığı | rod = çubuk | rise = rise
dwell = dwell | fall = fall | ratio = oran (ratio) | crank = krank (crank) | loom = tezgâh | drives = tahrik
stroke = strok (stroke) | strokes = strok | tube = boru | tools = takım | colours = renk | width = genişlik (width)
thickness = kalınlık (thickness) | cycle (knot_cycle of a loom) = çevrim (tezgâhta knot_cycle) | ground = ground
limits of speed and acceleration = hız ve ivme sınırı | pins = pim | carriage = araba | compensation = dengeleme
acceleration of the slide = sürgü ivmesi | efficiency = verim (efficiency) | shift = kayma (shift) | heads = kafa
limit = sınır | limits = sınır | weft and beat = atkı ve vuruş | moving links and needle = hareketli uzuv ve iğne
springs = yay | strut = çubuk boyu | shafts = mil | spans of the warps = çözgü açıklığı | weft = atkı | head = kafa
accelerations = ivme | beat = vuruş | levers = kol | wall = cidar | cycle = çevrim | wire = tel | gauge = ayar (gauge)
needles and loopers = iğne ve lüper | spans = destek açıklığı | machine = makine | weavers = dokuyucu | ones = olanı
weavers or heads = dokuyucu ya da kafa | axes = eksen | stitches over the length = boyuna dikiş | cones = koni
slide = sürgü | swing = salınım (swing) | pile handler = hav taşıyıcısı | bobbin = masura | room = yer
heights of the shed = ağızlık yüksekliği | task = görev | cloth = kumaş | seams = dikiş | cams = kam
turning sense = dönme yönü | fingers = parmak | size = boyut
"""


def _read(text: str) -> Mapping[str, str]:
    return dict(pair.split(" = ") for line in text.strip().split("\n") for pair in line.split(" | "))


_ADJECTIVES, _THINGS = _read(_PAIRS), _read(_NOUNS)
_CLAUSE = re.compile(r"(?:; or |, or |, (?:and )?)(?=(?:set|leave|take) )")
_ITEM = re.compile(r"(, or |, | or (?!an? of))")
_NAME = re.compile(r"--[\w-]+|[\w-]+(?:[_.=][\w.%-]+)+|@\w+")
_VERBS = {"set": "seçin", "take": "alın"}
_LEFT = re.compile(r"leave ([\w.-]+(?:(?:, | and )[\w.-]+)*) (to the design|to the bill|open|out)")
_ENDS = {"to the design": "tasarıma bırakın", "to the bill": "iplik listesine bırakın", "open": "açık bırakın"}
_ENDS |= {"out": "bırakmayın"}


def advised(text: str, phrase: Callable[[str], str | None]) -> str | None:
    """A cure in Turkish; None where the text is none, or a thing of it is not known.

    phrase  what is known as a whole

    >>> advised("set a longer front_span, or a lower lift", lambda _: None)
    'daha uzun front_span ya da daha düşük kalkma (lift) seçin'
    >>> advised("leave head_width to the design, or set thinner warps", lambda _: None)
    'head_width değerini tasarıma bırakın ya da daha ince çözgü seçin'
    """
    clauses = [phrase(clause) or _clause(clause) for clause in _CLAUSE.split(text)]
    said = [clause for clause in clauses if clause is not None]
    return " ya da ".join(said) if len(said) == len(clauses) else None


def _clause(text: str) -> str | None:
    verb, _, rest = text.partition(" ")
    if verb in _VERBS:
        items = _items(rest)
        return items and f"{items} {_VERBS[verb]}"
    left = _LEFT.fullmatch(text)
    if left is None:
        return None
    *first, last = re.split(r", | and ", left[1])
    return f"{', '.join(first)}{' ve ' if first else ''}{last} değerini {_ENDS[left[2]]}"


def _items(text: str) -> str | None:
    whole = _item(text)
    if whole is not None:
        return whole
    pieces = _ITEM.split(text)
    items = [_item(piece) for piece in pieces[::2]]
    if None in items:
        return None
    links = [", " if link == ", " else " ya da " for link in pieces[1::2]]
    return "".join(f"{item}{link}" for item, link in zip(items, [*links, ""], strict=True))


def _item(text: str) -> str | None:
    """A thing with its adjectives; adjectives alone, as the first of `shorter or thinner teeth`."""
    words = text.removeprefix("a ").removeprefix("an ").split(" ")
    said = []
    while words and words[0] in {*_ADJECTIVES, "and"}:
        word = words.pop(0)
        said.append(_ADJECTIVES.get(word, "ve"))
    thing = " ".join(words)
    if thing:
        known = thing if _NAME.fullmatch(thing) else _THINGS.get(thing)
        if known is None:
            return None
        said.append(known)
    return " ".join(said)
