"""Pictures of every kind: read right, or refused in one sentence."""

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageCms

from ilmek.errors import PictureError
from ilmek.io.picture import LARGEST, read_picture

RGB = np.random.default_rng(7).integers(0, 256, (12, 20, 3), dtype=np.uint8)
IMAGE = Image.fromarray(RGB)


def png(width: int, height: int, depth: int, kind: int, raw: bytes) -> bytes:
    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


@pytest.mark.parametrize("suffix", ["png", "bmp", "tif", "ppm", "tga", "qoi", "pcx"])
def test_lossless_formats_give_the_pixels_back(tmp_path: Path, suffix: str) -> None:
    file = tmp_path / f"a.{suffix}"
    IMAGE.save(file)
    picture = read_picture(file)
    assert np.array_equal(picture.rgb, RGB)
    assert picture.notes == ()


def test_alpha_is_laid_on_white(tmp_path: Path) -> None:
    rgba = np.dstack([RGB, np.full((12, 20), 255, np.uint8)])
    rgba[:6, :, 3] = 0
    Image.fromarray(rgba).save(tmp_path / "a.png")
    picture = read_picture(tmp_path / "a.png")
    assert (picture.rgb[:6] == 255).all()
    assert np.array_equal(picture.rgb[6:], RGB[6:])
    assert picture.notes == ("transparent parts put on white",)


def test_alpha_that_hides_nothing_is_not_mentioned(tmp_path: Path) -> None:
    IMAGE.convert("RGBA").save(tmp_path / "a.png")
    assert read_picture(tmp_path / "a.png").notes == ()


def test_palette_with_a_transparent_entry(tmp_path: Path) -> None:
    flat = Image.new("P", (10, 10), 1)
    flat.putpalette([255, 0, 0, 0, 0, 255])
    flat.paste(0, (0, 0, 10, 5))
    flat.save(tmp_path / "a.png", transparency=0)
    picture = read_picture(tmp_path / "a.png")
    assert picture.rgb[0, 0].tolist() == [255, 255, 255]
    assert picture.rgb[9, 9].tolist() == [0, 0, 255]


def test_grey_of_16_bits(tmp_path: Path) -> None:
    Image.fromarray(RGB[..., 0].astype(np.uint16) * 257).save(tmp_path / "a.png")
    picture = read_picture(tmp_path / "a.png")
    assert np.array_equal(picture.rgb, np.repeat(RGB[..., :1], 3, axis=2))
    assert "16 bits" in picture.notes[0]


def test_rgb_of_16_bits(tmp_path: Path) -> None:
    deep = (RGB.astype(np.uint16) * 257).astype(">u2")
    raw = b"".join(b"\0" + row.tobytes() for row in deep)
    (tmp_path / "a.png").write_bytes(png(20, 12, 16, 2, raw))
    picture = read_picture(tmp_path / "a.png")
    assert np.array_equal(picture.rgb, RGB)
    assert picture.notes == ("16 bits per channel reduced to 8",)


def test_grey_in_floating_point_is_scaled(tmp_path: Path) -> None:
    grey = np.linspace(-1, 3, 240, dtype=np.float32).reshape(12, 20)
    grey[3, 3] = np.nan
    Image.fromarray(grey).save(tmp_path / "a.tif")
    picture = read_picture(tmp_path / "a.tif")
    assert picture.rgb[0, 0, 0] == 0
    assert picture.rgb[-1, -1, 0] == 255
    assert "darkest" in picture.notes[0]


def test_cmyk_says_so(tmp_path: Path) -> None:
    Image.new("CMYK", (10, 10), (0, 255, 255, 0)).save(tmp_path / "a.tif")
    picture = read_picture(tmp_path / "a.tif")
    red, green, blue = picture.rgb[5, 5]
    assert red > 200
    assert max(green, blue) < 60
    assert "CMYK" in picture.notes[0]


@pytest.mark.parametrize("name", ["a.png", "a.tif"])
def test_exif_rotation_is_applied(tmp_path: Path, name: str) -> None:
    exif = Image.Exif()
    exif[0x0112] = 6
    IMAGE.save(tmp_path / name, exif=exif)
    picture = read_picture(tmp_path / name)
    assert np.array_equal(picture.rgb, np.rot90(RGB, -1))
    assert "EXIF" in picture.notes[0]


def test_first_frame_of_an_animation(tmp_path: Path) -> None:
    IMAGE.save(tmp_path / "a.png", save_all=True, append_images=[Image.new("RGB", IMAGE.size)] * 2)
    picture = read_picture(tmp_path / "a.png")
    assert np.array_equal(picture.rgb, RGB)
    assert picture.notes == ("the first of several frames is used",)


def test_colour_profiles(tmp_path: Path) -> None:
    srgb = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    IMAGE.save(tmp_path / "srgb.png", icc_profile=srgb)
    same = read_picture(tmp_path / "srgb.png")
    assert int(np.abs(same.rgb.astype(int) - RGB).max()) <= 1
    assert same.notes == ()
    IMAGE.save(tmp_path / "broken.png", icc_profile=b"no profile")
    broken = read_picture(tmp_path / "broken.png")
    assert np.array_equal(broken.rgb, RGB)
    assert "profile is damaged" in broken.notes[0]


def test_cielab_is_brought_to_srgb(tmp_path: Path) -> None:
    Image.new("LAB", (10, 10), (255, 128, 128)).save(tmp_path / "a.tif")
    picture = read_picture(tmp_path / "a.tif")
    assert picture.rgb.min() >= 250
    assert "sRGB" in picture.notes[0]


def bad_pictures(folder: Path) -> dict[str, tuple[Path, str]]:
    """Name -> (path, what must be said)."""
    whole = png(20, 12, 8, 2, b"".join(b"\0" + row.tobytes() for row in RGB))
    contents = {
        "empty": (b"", "is empty"),
        "text": (b"a carpet", "is not a picture"),
        "cut": (whole[: len(whole) // 2], "damaged or truncated"),
        "header only": (whole[:40], "damaged or truncated|not a picture"),
        "wrong checksum": (whole[:30] + b"\0\0\0\0" + whole[34:], "damaged|not a picture"),
        "bomb": (png(60_000, 60_000, 8, 0, b"\0"), "at most 150 megapixels"),
        "just too large": (png(LARGEST // 8 + 1, 8, 8, 0, b"\0"), "at most 150 megapixels"),
        "one pixel": (png(1, 1, 8, 0, b"\0\0"), "1 x 1 pixels; at least 8 x 8"),
        "a line": (png(500, 1, 8, 0, b"\0" * 501), "500 x 1 pixels"),
        "postscript": (b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 50 50\n%%EndComments\n", "format EPS"),
    }
    made = {}
    for name, (data, said) in contents.items():
        file = folder / f"{name}.png"
        file.write_bytes(data)
        made[name] = (file, said)
    return {
        **made,
        "folder": (folder, "is a folder"),
        "missing": (folder / "emtpy.png", "does not exist.*did you mean .*empty.png"),
        "too long": (folder / ("x" * 300), "cannot be read"),
        "device": (Path("/dev/null"), "is not a file"),
    }


BAD = (
    "empty", "text", "cut", "header only", "wrong checksum", "bomb", "just too large", "one pixel", "a line",
    "postscript", "folder", "missing", "too long", "device",
)  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_bad_pictures_are_refused(tmp_path: Path, name: str) -> None:
    file, said = bad_pictures(tmp_path)[name]
    with pytest.raises(PictureError, match=said) as caught:
        read_picture(file)
    assert "\n" not in str(caught.value)
