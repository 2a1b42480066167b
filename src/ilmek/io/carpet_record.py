"""The record of a carpet as JSON: what it is, of which yarns, what it took, its rows with their days; signed.

    {"record": {...}, "digests": {"/yarn/0/mass": "9f2c..."}, "digest": "...", "signature": {...}}

Each entry has a digest of its path and value, so that a changed one is named; the digest of all of them is signed with
Ed25519 (RFC 8032), and stands with the fingerprint of the key in the code of the carpet's label:

    ilmek:1:IDENTITY:DIGEST:FINGERPRINT

The file is written in one form only. A byte that is changed beside the entries is found too.
"""

import hashlib
import importlib
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from ilmek.errors import ParameterError
from ilmek.io.json_file import json_text
from ilmek.io.regular_file import open_regular
from ilmek.io.secret_file import read_bounded, write_secret
from ilmek.records import JsonObject
from ilmek.units import counted

LARGEST_RECORD = 20_000_000
"""Largest size of a record [bytes]."""

_SCHEME = "ilmek:1"
_SHOWN = 12
"""Changed entries that are named."""


class LabelCode(NamedTuple):
    """The code of a label."""

    identity: str
    digest: str
    fingerprint: str

    def __str__(self) -> str:
        return ":".join((_SCHEME, *self))


def parse_code(text: str) -> LabelCode:
    """The code of a label. Raises ParameterError for another text.

    >>> parse_code("ilmek:1:0b3e:77aa:-").identity
    '0b3e'
    """
    parts = text.strip().rsplit(":", 3)
    if len(parts) != 4 or parts[0] != _SCHEME:
        raise ParameterError(f"{text[:60]!r} is no code of a label", allowed=f"{_SCHEME}:IDENTITY:DIGEST:FINGERPRINT")
    return LabelCode(*parts[1:])


def _keys() -> Any:
    try:
        return importlib.import_module("cryptography.hazmat.primitives.asymmetric.ed25519")
    except ImportError:
        do = "pip install 'ilmek[orders]'"
        raise ParameterError("signatures need the package cryptography, which is not installed", do=do) from None


def signing_key(path: Path) -> Any:
    """The private key of a file, 32 bytes in hex; made for its owner alone where there is no file.

    Raises ParameterError for another content, LoomError where others may read it, OutputError.
    """
    keys = _keys()
    if not path.exists():
        write_secret(path, keys.Ed25519PrivateKey.generate().private_bytes_raw().hex().encode() + b"\n")
    try:
        return keys.Ed25519PrivateKey.from_private_bytes(bytes.fromhex(read_bounded(path, "key").decode().strip()))
    except ValueError:
        raise ParameterError(f"{path} is no key", allowed="64 hexadecimal digits", do="give a new file") from None


def fingerprint(public: str) -> str:
    """A short name of a public key."""
    return hashlib.sha256(bytes.fromhex(public)).hexdigest()[:16]


def entries(value: object, path: str = "") -> Iterator[tuple[str, object]]:
    """The entries of a record that hold no others, with their paths.

    >>> dict(entries({"yarn": [{"name": "ivory"}], "rows": []}))
    {'/yarn/0/name': 'ivory', '/rows': []}
    """
    if isinstance(value, Mapping) and value:
        for key, inner in value.items():
            yield from entries(inner, f"{path}/{key}")
    elif isinstance(value, list) and value:
        for index, inner in enumerate(value):
            yield from entries(inner, f"{path}/{index}")
    else:
        yield path, value


def _digest(value: object) -> str:
    text = json.dumps(value, ensure_ascii=False, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode("utf-8")).hexdigest()


def _digests(record: JsonObject) -> dict[str, str]:
    return {path: _digest([path, value])[:16] for path, value in entries(record)}


def signed_record(record: JsonObject, key: Any = None) -> JsonObject:
    """The record with its digests, and with a signature where a private key is given."""
    record = json.loads(json_text(record))
    digests = _digests(record)
    whole = _digest(digests)
    made: JsonObject = {"record": record, "digests": digests, "digest": whole, "signature": None}
    if key is not None:
        public = key.public_key().public_bytes_raw().hex()
        made["signature"] = {"algorithm": "Ed25519", "key": public, "value": key.sign(bytes.fromhex(whole)).hex()}
    return made


def code_of(made: JsonObject) -> LabelCode:
    """The code of a record's label; "-" in the place of the fingerprint where it is not signed."""
    signature = made["signature"]
    key = "-" if signature is None else fingerprint(signature["key"])
    return LabelCode(made["record"]["identity"], made["digest"][:32], key)


def read_record(path: Path) -> tuple[JsonObject, str]:
    """A record's data and text. Raises ParameterError for a file that is none."""
    try:
        file, size = open_regular(path)
        with file:
            data = file.read(LARGEST_RECORD + 1) if size <= LARGEST_RECORD else b""
    except OSError as error:
        raise ParameterError(f"{path} cannot be read ({error.strerror})", do="check the path") from None
    try:
        text = data.decode("utf-8")
        made = json.loads(text)
        shaped = isinstance(made["record"]["identity"], str) and isinstance(made["digests"], dict)
        shaped = shaped and isinstance(made["digest"], str) and isinstance(made["signature"], dict | None)
    except (ValueError, TypeError, KeyError, RecursionError):
        shaped = False
    if not shaped:
        raise ParameterError(f"{path} is no record of a carpet", allowed="JSON of `ilmek order`")
    return made, text


def record_faults(made: JsonObject, text: str, code: LabelCode | None = None, key: str | None = None) -> list[str]:
    """What is wrong with a record, in words; nothing where every byte is as it was written and signed.

    code  of its label      key  public key, or its fingerprint, that must have signed it
    """
    faults = list(_changed(made))
    if _digest(made["digests"]) != made["digest"]:
        faults.append("the digest of the record is not that of its digests: one of them was changed")
    if not faults and text != json_text(made):
        faults.append(f"{_first_difference(text, json_text(made))} is not as it was written")
    faults += _signature_faults(made, key)
    if code is not None:
        own = code_of(made)
        names = {"identity": "the identity", "digest": "the digest", "fingerprint": "the key"}
        for field, noun in names.items():
            given, found = getattr(code, field), getattr(own, field)
            if given != found:
                faults.append(f"{noun} is {found}, that of the label is {given}")
    return faults


def _changed(made: JsonObject) -> Iterator[str]:
    """The entries that differ from their digests, that were added or taken away."""
    now, then = _digests(made["record"]), made["digests"]
    values = dict(entries(made["record"]))
    changed = [
        f"{path} was changed: it is now {values[path]!r}" for path in now if then.get(path, now[path]) != now[path]
    ]
    changed += [f"{path} was added" for path in now if path not in then]
    changed += [f"{path} was taken away" for path in then if path not in now]
    yield from changed[:_SHOWN]
    if len(changed) > _SHOWN:
        yield f"and {counted(len(changed) - _SHOWN, 'more entry', 'more entries')}"


def _first_difference(text: str, written: str) -> str:
    lines = zip(text.split("\n"), written.split("\n"), strict=False)
    number = next((number for number, (one, other) in enumerate(lines, 1) if one != other), None)
    return "the end of the file" if number is None else f"line {number} of the file"


def _signature_faults(made: JsonObject, key: str | None) -> Iterator[str]:
    signature = made["signature"]
    if signature is None:
        if key is not None:
            yield "it is not signed"
        return
    keys = _keys()
    try:
        public = keys.Ed25519PublicKey.from_public_bytes(bytes.fromhex(signature["key"]))
        public.verify(bytes.fromhex(signature["value"]), bytes.fromhex(_digest(made["digests"])))
    except (ValueError, TypeError, KeyError, importlib.import_module("cryptography.exceptions").InvalidSignature):
        yield "the signature does not hold: record, digests, key or signature were changed"
        return
    if key is not None and key not in (signature["key"], fingerprint(signature["key"])):
        yield f"it is signed with the key {fingerprint(signature['key'])}, not with {key}"
