"""Pictures made to harm: every one is read or refused in one sentence, in bounded time and memory, and in silence."""

import contextlib
import io
import os
import random
import struct
import sys
import time
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageFile
from PIL.PngImagePlugin import PngInfo
from processes import ended, printed, python

from ilmek.errors import PictureError
from ilmek.io import picture_file
from ilmek.io.chart.png import KEY, read_chart_png
from ilmek.io.native_messages import native_messages
from ilmek.io.picture import LARGEST_INTERPRETED, LARGEST_WHOLE, read_picture
from ilmek.progress import Cancelled, Progress

PATIENCE = 20.0
"""Far above the time on any processor [s]: what this guards against takes minutes."""


SMOOTH = Image.fromarray(np.random.default_rng(7).integers(0, 256, (6, 8, 3), dtype=np.uint8)).resize((80, 60))


def saved(kind: str, image: Image.Image = SMOOTH, **options: object) -> bytes:
    stream = io.BytesIO()
    image.save(stream, kind, **options)
    return stream.getvalue()


def chunk(name: bytes, data: bytes = b"") -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def with_chunks(data: bytes, chunks: bytes) -> bytes:
    """A PNG with chunks after its header."""
    return data[:33] + chunks + data[33:]


def tiff_of(directories: int) -> bytes:
    """A TIFF whose first directory is followed by many others."""
    data = bytearray(saved("TIFF"))
    (at,) = struct.unpack_from("<I", data, 4)
    (entries,) = struct.unpack_from("<H", data, at)
    directory = bytes(data[at : at + 2 + 12 * entries])
    struct.pack_into("<I", data, at + len(directory), len(data))
    for _ in range(directories):
        data += directory + struct.pack("<I", len(data) + len(directory) + 4)
    return bytes(data + directory + bytes(4))


def tiff_of_strips(strips: int) -> bytes:
    entries = (
        *((256, 3, 1, 8), (257, 4, 1, strips), (258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 1)),
        *((273, 4, strips, 8), (277, 3, 1, 1), (278, 4, 1, 1), (279, 4, strips, 8)),
    )
    directory = b"".join(struct.pack("<HHII", *entry) for entry in entries)
    return (
        b"II*\0" + struct.pack("<I", 8 + 4 * strips) + bytes(4 * strips) + struct.pack("<H", 9) + directory + bytes(4)
    )


def gif_with_comment(blocks: int) -> bytes:
    data = saved("GIF", SMOOTH.convert("P"))
    at = data.index(b",", 13 + 3 * 256)
    return data[:at] + b"!\xfe" + (b"\xff" + bytes(range(1, 256))) * blocks + b"\0" + data[at:]


def jpeg_with_exif(segments: int) -> bytes:
    data = saved("JPEG")
    segment = b"Exif\0\0II*\0" + bytes(65_000)
    return data[:2] + (b"\xff\xe1" + struct.pack(">H", len(segment) + 2) + segment) * segments + data[2:]


def scrambled(data: bytes, start: float, count: int) -> bytes:
    first = int(len(data) * start)
    return data[:first] + np.random.default_rng(1).bytes(count) + data[first + count :]


def icon_with_larger_picture() -> bytes:
    inner = png_header(16_000, 16_000)
    return b"\0\0\1\0\1\0" + struct.pack("<BBBBHHII", 16, 16, 0, 0, 1, 32, len(inner), 22) + inner


def png_header(width: int, height: int) -> bytes:
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND")


BLACK_AND_WHITE = SMOOTH.convert("1")
REFUSED = {
    "GIF with 60,000 blocks of comment": (lambda: gif_with_comment(60_000), "too many entries"),
    "PNG of 300,000 chunks": (lambda: with_chunks(saved("PNG"), chunk(b"prIv") * 300_000), "200,000 chunks"),
    "PNG with large texts": (
        lambda: with_chunks(saved("PNG"), chunk(b"zTXt", b"k\0\0" + zlib.compress(bytes(900_000))) * 80),
        "text",
    ),
    "PNG with a large profile": (
        lambda: with_chunks(saved("PNG"), chunk(b"iCCP", b"k\0\0" + zlib.compress(bytes(5_000_000)))),
        "too large",
    ),
    "PNG with a wrong checksum": (lambda: saved("PNG")[:-20] + b"\0" + saved("PNG")[-19:], "checksum"),
    "TIFF of 300,000 strips": (lambda: tiff_of_strips(300_000), "200,000 strips"),
    "TIFF cut in its directory": (lambda: saved("TIFF")[:-30], "damaged"),
    "fax, broken": (lambda: scrambled(saved("TIFF", BLACK_AND_WHITE, compression="group4"), 0.4, 60), "damaged"),
    "JPEG without end": (lambda: saved("JPEG")[:-2], "no end"),
    "JPEG with a foreign marker": (lambda: saved("JPEG")[:-40] + b"\xff\x37" + saved("JPEG")[-38:], "marker 37"),
    "JPEG without a restart marker": (
        lambda: saved("JPEG", restart_marker_blocks=2).replace(b"\xff\xd1", b"\0\0"), "restart marker",
    ),
    "JPEG, scrambled": (lambda: scrambled(saved("JPEG", SMOOTH.resize((900, 900)), quality=95), 0.5, 4000), "damaged"),
    "JPEG with 2 MB of EXIF data": (lambda: jpeg_with_exif(32), "EXIF"),
    "icon with a large picture inside": (icon_with_larger_picture, "too large|damaged"),
    "QOI above its limit": (
        lambda: b"qoif" + struct.pack(">IIBB", 3000, 3000, 3, 0) + bytes(99), "4 megapixels of QOI",
    ),
    "PPM of 16 bits above its limit": (lambda: b"P6 3000 3000 65535\n" + bytes(99), "4 megapixels of PPM"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_is_refused_at_once(tmp_path: Path, name: str, capfd: pytest.CaptureFixture[str]) -> None:
    make, reason = REFUSED[name]
    (tmp_path / "picture").write_bytes(make())
    begun = time.process_time()
    with pytest.raises(PictureError, match=f"(?i){reason}") as caught:
        read_picture(tmp_path / "picture")
    assert time.process_time() - begun < PATIENCE
    assert "\n" not in str(caught.value)
    assert capfd.readouterr().err == ""


def test_many_directories_are_not_walked(tmp_path: Path) -> None:
    (tmp_path / "a.tif").write_bytes(tiff_of(100_000))
    begun = time.process_time()
    picture = read_picture(tmp_path / "a.tif")
    assert time.process_time() - begun < PATIENCE
    assert picture.notes == ("the first of several frames is used",)
    assert np.array_equal(picture.rgb, np.asarray(SMOOTH))


def test_formats_decoded_whole_have_their_own_limit(tmp_path: Path) -> None:
    data = bytearray(saved("WEBP", lossless=True))
    at = data.index(b"VP8L") + 9
    struct.pack_into("<I", data, at, 9999 | 9999 << 14)
    (tmp_path / "a.webp").write_bytes(data)
    with pytest.raises(PictureError, match="damaged|40 megapixels of WEBP"):
        read_picture(tmp_path / "a.webp")
    Image.new("L", (2000, 1001)).save(tmp_path / "a.jp2")
    with pytest.raises(PictureError, match="2 megapixels of JPEG 2000; save it as PNG"):
        read_picture(tmp_path / "a.jp2")
    assert LARGEST_WHOLE == 40_000_000
    assert LARGEST_INTERPRETED == 4_000_000


def test_a_file_above_the_limit_is_not_read(tmp_path: Path) -> None:
    with (tmp_path / "a.png").open("wb") as file:
        file.truncate(30_000_000_000)  # sparse
    with pytest.raises(PictureError, match="30,000 MB; at most 500 MB"):
        read_picture(tmp_path / "a.png")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes")
def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(PictureError, match="is not a file"):
        read_picture(tmp_path / "pipe")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes")
def test_a_pipe_put_in_place_of_the_file_is_not_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    os.mkfifo(tmp_path / "pipe")
    monkeypatch.setattr(Path, "is_file", lambda _: True)
    with pytest.raises(PictureError, match="pipe or a device"):
        read_picture(tmp_path / "pipe")


def test_a_growing_file_is_read_to_its_first_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = saved("BMP")
    (tmp_path / "a.bmp").write_bytes(data)
    grown = []

    def grow(stage: str, share: float) -> None:
        if not grown:
            grown.append(share)
            with (tmp_path / "a.bmp").open("ab") as file:
                file.truncate(10_000_000)

    monkeypatch.setattr(picture_file, "_BLOCK", 1000)
    assert picture_file.read_bytes(tmp_path / "a.bmp", Progress(grow)) == data
    assert grown


def test_reading_is_cancelled(tmp_path: Path) -> None:
    SMOOTH.resize((1000, 1000)).save(tmp_path / "a.png")
    for last in (1, 3, 5):
        calls: list[int] = []

        def often(calls: list[int] = calls, last: int = last) -> bool:
            calls.append(1)
            return len(calls) > last

        with pytest.raises(Cancelled):
            read_picture(tmp_path / "a.png", Progress(cancelled=often))


def test_settings_of_pillow_are_put_back(tmp_path: Path) -> None:
    before = Image.MAX_IMAGE_PIXELS
    ImageFile.LOAD_TRUNCATED_IMAGES = True
    try:
        (tmp_path / "a.png").write_bytes(saved("PNG")[:-60])
        with pytest.raises(PictureError, match="damaged"):
            read_picture(tmp_path / "a.png")
        assert before == Image.MAX_IMAGE_PIXELS
        assert ImageFile.LOAD_TRUNCATED_IMAGES
    finally:
        ImageFile.LOAD_TRUNCATED_IMAGES = False


def test_messages_of_libraries_are_caught(capfd: pytest.CaptureFixture[str]) -> None:
    with native_messages() as messages:
        os.write(2, b"one\ntwo\n")
        with contextlib.suppress(BlockingIOError):
            os.write(2, b"x" * 1_000_000)  # more than a pipe holds
    os.write(2, b"after\n")
    assert messages[:2] == ["one", "two"]
    assert capfd.readouterr().err == "after\n"


SEEDS = {
    **{kind: saved(kind) for kind in ("PNG", "JPEG", "TIFF", "BMP", "PPM", "TGA", "PCX", "ICO", "SGI", "DDS")},
    "GIF": saved("GIF", SMOOTH.convert("P")),
    "LZW": saved("TIFF", compression="tiff_lzw"),
    "Deflate": saved("TIFF", compression="tiff_adobe_deflate"),
    "Group 4": saved("TIFF", BLACK_AND_WHITE, compression="group4"),
    "MSP": saved("MSP", BLACK_AND_WHITE),
    "WEBP": saved("WEBP"),
    "JPEG2000": saved("JPEG2000"),
}


CODINGS = {
    "usual": saved("JPEG"),
    "of best quality": saved("JPEG", quality=100, subsampling=0),
    "grey": saved("JPEG", SMOOTH.convert("L")),
    "of four inks": saved("JPEG", SMOOTH.convert("CMYK")),
    "progressive": saved("JPEG", progressive=True),
    "with restart markers": saved("JPEG", restart_marker_blocks=5),
}


@pytest.mark.parametrize("coding", CODINGS)
def test_a_jpeg_cut_short_anywhere_is_refused(tmp_path: Path, coding: str) -> None:
    data, file = CODINGS[coding], tmp_path / "a.jpg"
    file.write_bytes(data)
    assert read_picture(file).rgb.shape[2] == 3
    for stop in sorted({*np.linspace(4, len(data) - 1, 40).astype(int).tolist(), *range(len(data) - 6, len(data) - 1)}):
        for ending in (b"", bytes(64)):  # nothing, or the zeros of a full disc
            file.write_bytes(data[:stop] + ending)
            with pytest.raises(PictureError, match="damaged or truncated|cannot be read"):
                read_picture(file)


def mutant(data: bytes, chance: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 5))):
        at = chance.randrange(min(len(changed), chance.choice((40, 300, 100_000))))
        kind = chance.randrange(4)
        if kind == 0:
            changed[at] ^= 1 << chance.randrange(8)
        elif kind == 1:
            changed[at : at + 4] = chance.choice((b"\xff\xff\xff\xff", bytes(4), b"\x7f\xff\xff\xff", b"\0\0\0\1"))
        elif kind == 2 and at > 8:
            del changed[at:]
        else:
            changed[at:at] = chance.randbytes(chance.choice((1, 4, 100)))
    return bytes(changed)


SILENT_CASE = """
import sys
from pathlib import Path
from ilmek.errors import PictureError
from ilmek.io.picture import read_picture
try:
    read_picture(Path(sys.argv[1]))
except PictureError:
    print("refused")
"""


def test_pillow_logs_nothing_to_the_error_stream(tmp_path: Path) -> None:
    data = bytearray(saved("TIFF"))
    at = data.index(struct.pack("<HHI", 277, 3, 1))
    struct.pack_into("<H", data, at + 8, 8)  # samples per pixel
    (tmp_path / "a.tif").write_bytes(data)
    done = ended(python("-c", SILENT_CASE, tmp_path / "a.tif"))
    assert (done.returncode, done.stdout, done.stderr) == (0, "refused\n", "")


@pytest.mark.matrix(light=8)
@pytest.mark.parametrize("name", SEEDS)
def test_mutants_are_read_or_refused(tmp_path: Path, name: str, capfd: pytest.CaptureFixture[str]) -> None:
    chance = random.Random(name)
    file = tmp_path / "picture"
    for _ in range(40):
        file.write_bytes(mutant(SEEDS[name], chance))
        with contextlib.suppress(PictureError):
            assert read_picture(file).rgb.dtype == np.uint8
    assert capfd.readouterr().err == ""


def chart_with(facts: str, size: tuple[int, int] = (9, 9)) -> bytes:
    """A picture with a palette and these data of a chart."""
    info = PngInfo()
    info.add_itxt(KEY, facts)
    return saved("PNG", Image.new("P", size), pnginfo=info)


@pytest.mark.parametrize(
    "facts",
    [
        "[" * 100_000,
        "{}",
        '{"yarns": [], "size": [1, 1], "quality": [1, 1], "knot": "symmetric"}',
        '{"yarns": [{"name": "a", "srgb": [0, 0, 256]}], "size": [1, 1], "quality": [1, 1], "knot": ""}',
        '{"yarns": [{"name": "a", "srgb": [0, 0, 0]}], "size": [1], "quality": [1, 1], "knot": ""}',
        '{"yarns": [{"name": "a", "srgb": [0, 0, 0]}], "size": [NaN, 1], "quality": [1, 1], "knot": ""}',
        '{"yarns": [{"name": "a", "srgb": [0, 0, 0]}], "size": [1e999, 1], "quality": [1, 1], "knot": ""}',
    ],
)
def test_charts_of_others_are_checked(tmp_path: Path, facts: str) -> None:
    (tmp_path / "chart.png").write_bytes(chart_with(facts))
    with pytest.raises(PictureError, match="is no knot chart"):
        read_chart_png(tmp_path / "chart.png")


MEMORY = """
import resource, sys
from pathlib import Path
from ilmek.io.picture import read_picture
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
read_picture(Path(sys.argv[1]))
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1000)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="memory is counted in kB on Linux only")
def test_memory_of_a_picture_is_bounded(tmp_path: Path) -> None:
    side = 5000
    (tmp_path / "a.png").write_bytes(saved("PNG", Image.new("LA", (side, side), (7, 200)), compress_level=1))
    used = int(printed(python("-c", MEMORY, tmp_path / "a.png")))
    assert used < 7 * side**2 + 60e6
