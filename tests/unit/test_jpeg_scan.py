"""Coded bytes of JPEG files: whole files pass, whatever their coding; scrambled ones are noticed."""

import io
import random

import numpy as np
import pytest
from PIL import Image

from ilmek.io.picture_file import DamagedError, check_structure
from ilmek.progress import Cancelled, Progress

SMOOTH = Image.fromarray(np.random.default_rng(7).integers(0, 256, (20, 30, 3), dtype=np.uint8)).resize((301, 203))


def saved(image: Image.Image = SMOOTH, **options: object) -> bytes:
    stream = io.BytesIO()
    image.save(stream, "JPEG", **options)
    return stream.getvalue()


@pytest.mark.parametrize("mode", ["RGB", "L", "CMYK"])
@pytest.mark.parametrize("options", [{}, {"optimize": True}, {"progressive": True}, {"restart_marker_blocks": 5}])
def test_whole_files_pass(mode: str, options: dict[str, object]) -> None:
    for quality, subsampling, size in ((5, 2, (301, 203)), (90, 1, (8, 8)), (100, 0, (65, 17)), (75, 2, (17, 130))):
        image = SMOOTH.resize(size).convert(mode)
        chosen = {"subsampling": subsampling} if mode == "RGB" else {}
        check_structure(saved(image, quality=quality, **chosen, **options))


@pytest.mark.parametrize("padding", [b"\0", b"\0\1", b"\0" * 500])
def test_padding_after_the_last_block_passes(padding: bytes) -> None:
    data = saved()
    check_structure(data[:-2] + padding + data[-2:])


def scan_of(data: bytes) -> int:
    return data.index(b"\xff\xda") + 14


@pytest.mark.parametrize("restart", [0, 4])
def test_most_scrambled_files_are_noticed(restart: int) -> None:
    data, chance, found = saved(restart_marker_blocks=restart), random.Random(3), 0
    for _ in range(100):
        at = chance.randrange(scan_of(data), len(data) - 400)
        try:
            check_structure(data[:at] + chance.randbytes(300) + data[at + 300 :])
        except DamagedError:
            found += 1
    assert found >= 95


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda data: data[: scan_of(data) + 300] + data[-2:], "the codes end"),
        (lambda data: data[:-2] + bytes(range(100)) + data[-2:], "after the last block"),
        (lambda data: data[: scan_of(data)] + b"\xff\x00" * 50 + data[scan_of(data) + 100 :], "wrong code|too many"),
        (lambda data: data.replace(b"\xff\xc4", b"\xff\xfe"), "without its tables"),
        (lambda data: data.replace(b"\xff\xc0\x00\x11", b"\xff\xc0\x00\x06"), "too short|no marker"),
    ],
)
def test_damage_is_named(change: object, reason: str) -> None:
    with pytest.raises(DamagedError, match=reason):
        check_structure(change(saved()))


def test_tables_with_too_many_codes_are_refused() -> None:
    data = bytearray(saved())
    at = data.index(b"\xff\xc4") + 5
    data[at : at + 16] = b"\xff" * 16
    with pytest.raises(DamagedError):
        check_structure(bytes(data))


def test_the_walk_is_cancelled() -> None:
    with pytest.raises(Cancelled):
        check_structure(saved(), Progress(cancelled=lambda: True))
