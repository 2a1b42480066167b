"""Nouns of machines in Turkish: titles of parts, bodies, tracks and motions, put together from those they consist of.

    X of the Y, Y's X, y-x     =     y x+suffix          kam mili yatağı: bearing of the cam shaft

The suffix of possession follows the last vowel; k after a vowel becomes ğ, ç becomes c. A noun with a + has it already.
"""

import re
from collections.abc import Mapping
from functools import cache, lru_cache
from pathlib import Path

from ilmek.sentences.advice_turkish import advised


@cache
def _table(name: str) -> Mapping[str, str]:
    """A table of this folder: English, a tab, Turkish."""
    lines = Path(__file__).with_name(name).read_text(encoding="utf-8").splitlines()
    return dict(line.split("\t") for line in lines)


def phrased(text: str) -> str:
    """A text that is known as a whole in Turkish; another one stays, its nouns too.

    >>> phrased("unknown machine 'cam'"), phrased("cam, crank")
    ("bilinmeyen makine 'cam'", 'cam, crank')
    """
    return _phrase(text) or _filled(text) or text


def _known(text: str) -> str | None:
    """A phrase, a cure, either with a full stop, a phrase with more behind it, or one with holes."""
    if (known := _phrase(text) or advised(text, _phrase)) is not None:
        return known
    if text.endswith("."):
        return f"{named(text[:-1])}."
    main, more, rest = text.rpartition("; ")
    if more and (known := _phrase(main)) is not None:
        return f"{known}; {named(rest)}"
    return _filled(text)


def _phrase(text: str) -> str | None:
    """A phrase of the table of phrases; # stands there for a number or a quoted word, in the same order in both."""
    phrases = _table("turkish.tsv")
    if text in phrases:
        return phrases[text]
    found = phrases.get(_HOLE.sub("#", text))
    if found is not None:
        values = iter(_HOLE.findall(text))
        return re.sub("#", lambda _: next(values), found)
    return _capital(_phrase(text[0].lower() + text[1:])) if text[:1].isupper() else None


def _filled(text: str) -> str | None:
    """A phrase with holes for texts: {} for one that is said in Turkish too, {=} for one that stays.

    {0} and {1} are the places of both in the Turkish one.
    """
    near = {one for word in _WORD.findall(text) for one in _patterns().get(word, ())}
    for _, pattern, stays, said in sorted(near):
        if filled := pattern.fullmatch(text):
            values = zip(filled.groups(), stays, strict=True)
            return said.format(*(value if kept else named(value) for value, kept in values))
    return None


def _capital(text: str | None) -> str | None:
    return text and text[0].translate(_CAPITALS).upper() + text[1:]


@cache
def _patterns() -> Mapping[str, list[tuple[int, re.Pattern[str], tuple[bool, ...], str]]]:
    """The phrases with holes for texts, by their longest word: rank, what each hole keeps, and the Turkish.

    Those with the most letters come first.
    """
    phrases = _table("turkish.tsv")
    found: dict[str, list[tuple[int, re.Pattern[str], tuple[bool, ...], str]]] = {}
    for rank, key in enumerate(sorted((key for key in phrases if _TEXTS.search(key)), key=len, reverse=True)):
        pattern = re.compile("(.+?)".join(map(re.escape, _TEXTS.split(key))))
        stays = tuple(hole == "{=}" for hole in _TEXTS.findall(key))
        word = max(_WORD.findall(" ".join(_TEXTS.split(key))), key=len)
        found.setdefault(word, []).append((rank, pattern, stays, phrases[key]))
    return found


_WORD = re.compile(r"[^\W\d_]+")
_TEXTS = re.compile(r"\{=?\}")
_HOLE = re.compile(r"(?<!\w)'[^']*'(?!\w)|(?<![\w.#])[-−]?\d+(?:[.,]\d+)*(?:e[-+]?\d+)?(?!\w)")

_OF = re.compile(r"(.+?) of (?:the |an? |such a )?(.+)")
_ITS = re.compile(r"(.+?)(?:'s|(?<=s)') (.+)")
_MARK = re.compile(r"(?<=[a-zçğıöşü])\+")
_SENTENCE = re.compile(r"[a-z]{3,} [a-z]{2,}")
_PARAMETER = re.compile(r"parameters? ([\w.]+)")
_PIECES = re.compile(r"(; |: |\d+ × | \d+$)")
_CAPITALS = str.maketrans("i", "İ")
_VOWELS = {"a": "ı", "ı": "ı", "e": "i", "i": "i", "o": "u", "u": "u", "ö": "ü", "ü": "ü"}


@lru_cache(maxsize=16384)
def named(text: str) -> str:
    """A text with its nouns in Turkish; what is not known stays as it is.

    >>> named("2 × bearing of the cam shaft; 1 × heads' rail"), named("weaver: sley-follower"), named("NEMA 17")
    ('2 × kam mili yatağı; 1 × kafalar rayı', 'dokuma kafası: tefe tarağı izleyicisi', 'NEMA 17')
    >>> named("Beat-up: stress of a leaf")
    'Tefeleme: yaprağın gerilmesi'
    """
    if (known := _known(text)) is not None:
        return known
    whole = None if "; " in text else _noun(text)
    head, colon, rest = text.partition(": ")
    if whole is None and colon and "; " not in text:
        return f"{named(head)}: {named(rest)}"
    if whole is None:
        whole = "".join(map(_listed, _PIECES.split(text)))
    if whole == text and text[:1].isupper():
        lowered = text[0].lower() + text[1:]
        whole = named(lowered)
        return text if whole == lowered else _capital(whole) or ""
    return _MARK.sub("", whole)


def _listed(text: str) -> str:
    pieces = text.split(", ")
    known = [_piece(piece) for piece in pieces]
    unknown = any(new is None and _SENTENCE.search(piece) for new, piece in zip(known, pieces, strict=True))
    if unknown and any(known):  # one text is not said in two languages; a noun may have a comma
        rest = ", ".join(pieces[1:])
        return _piece(text) or (known[0] and (said := _piece(rest)) and f"{known[0]}, {said}") or text
    return _piece(text) or ", ".join(new or piece for new, piece in zip(known, pieces, strict=True))


def _piece(text: str) -> str | None:
    parameter = _PARAMETER.fullmatch(text)
    known = f"parametre {parameter[1]}" if parameter else _phrase(text) or _noun(text)
    first, both, second = text.partition(" and ")
    if known is None and both:
        pair = _noun(first), _noun(second)
        return f"{pair[0]} ile {pair[1]}" if all(pair) else None
    return known


@lru_cache(maxsize=4096)
def _noun(text: str) -> str | None:
    """A noun with its mark; None where it is not known."""
    nouns = _table("nouns_turkish.tsv")
    known = nouns.get(text) or nouns.get(text.replace("-", " "))
    if known is not None:
        return known
    parts = _OF.fullmatch(text)
    pairs = [(parts[1], parts[2])] if parts else []
    owned = _ITS.fullmatch(text)
    pairs += [(owned[2], owned[1])] if owned else []
    whole, dash, last = text.rpartition("-")
    pairs += [(last, whole), (last, " ".join(whole.rsplit("-", 1)))] if dash else []
    both = ((_noun(thing), _noun(owner)) for thing, owner in pairs)
    return next((f"{owner.replace('+', '')} {_possessed(thing)}" for thing, owner in both if thing and owner), None)


def _possessed(noun: str) -> str:
    """A noun with the suffix of possession.

    >>> [_possessed(noun) for noun in ("motor", "levha", "kasnak", "kıskaç", "yay", "kam mil+i")]
    ['motor+u', 'levhas+ı', 'kasnağ+ı', 'kıskac+ı', 'yay+ı', 'kam mil+i']
    """
    if "+" in noun:
        return noun
    end = noun[-1]
    vowel = next(_VOWELS[letter] for letter in reversed(noun.lower()) if letter in _VOWELS)
    if end in _VOWELS:
        return f"{noun}s+{vowel}"
    soft = {"k": "ğ", "ç": "c"}.get(end, end) if len(re.findall("[aıeioöuü]", noun)) > 1 else end
    return f"{noun[:-1]}{soft}+{vowel}"
