"""Pictures of a project: taken by their content, drawings too, and charted as by the recipe."""

import io
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from psd_tools import PSDImage
from reportlab.pdfgen.canvas import Canvas
from studio_project import sample_project

from ilmek.errors import IlmekError, ParameterError, PictureError
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.jobs.studio.carpet.answers import ChartRequest, PictureRequest
from ilmek.jobs.studio.carpet.tasks import chart, picture
from ilmek.jobs.studio.project.pictures import UploadRequest, delete_picture, upload_picture
from ilmek.jobs.studio.project.tasks import PathRequest


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return sample_project(tmp_path)


@pytest.fixture
def context(folder: Path) -> Context:
    return Context(str(folder))


def test_pictures_are_taken_by_their_content(folder: Path, context: Context) -> None:
    png = b"\x89PNG\r\n\x1a\n" + bytes(20)
    assert upload_picture(UploadRequest("C:\\My Photos\\../rug (1).JPG", png), context).path == "pictures/rug--1.png"
    assert upload_picture(UploadRequest("rug--1.png", png), context).path == "pictures/rug--1.png"
    assert upload_picture(UploadRequest("rug--1.png", png + b"x"), context).path == "pictures/rug--1-2.png"
    for name, body in (("x.png", b"<html>"), ("x.svg", b"<?xml version='1.0'?><html><svg/>"), ("", b"")):
        with pytest.raises(ParameterError, match="no picture"):
            upload_picture(UploadRequest(name, body), context)
    delete_picture(PathRequest("pictures/rug--1.png"), context)
    assert not (folder / "pictures" / "rug--1.png").exists()


RED, NAVY = (158, 43, 37), (27, 36, 66)


def svg() -> bytes:
    """A red drawing with its right half in navy."""
    return (
        b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 60"><rect width="40" height="60" fill="#9e2b25"/>'
        b'<rect x="20" width="20" height="60" fill="#1b2442"/></svg>'
    )


def pdf() -> bytes:
    """A red page, then one with its right half in navy."""
    file = io.BytesIO()
    canvas = Canvas(file, (40, 60))
    for half in (40, 20):
        for left, colour in ((0, RED), (half, NAVY)):
            canvas.setFillColorRGB(*(code / 255 for code in colour))
            canvas.rect(left, 0, 40 - left, 60, stroke=0, fill=1)
        canvas.showPage()
    canvas.save()
    return file.getvalue()


def psd() -> bytes:
    """A layered file with its merged picture, red with its right half in navy."""
    image = Image.new("RGB", (80, 120), RED)
    image.paste(NAVY, (40, 0, 80, 120))
    file = io.BytesIO()
    PSDImage.frompil(image).save(file)
    return file.getvalue()


def first_part(answer: Binary, *sides: int) -> np.ndarray:
    """The array behind the JSON of an answer."""
    begin = 4 + int.from_bytes(answer.body[:4], "little")
    return np.frombuffer(answer.body, dtype=np.uint8, count=int(np.prod(sides)), offset=begin).reshape(sides)


DRAWINGS = {"rug.svg": (svg, {}), "rug.pdf": (pdf, {"page": 2}), "rug.psd": (psd, {})}


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize("sent", ["", "a drawing.png"])
def test_a_drawing_is_taken_shown_and_charted(context: Context, name: str, sent: str) -> None:
    """Whatever its name says; of a PDF file the page that the recipe states."""
    body, keys = DRAWINGS[name]
    for reader in ("resvg_py", "pypdfium2"):
        pytest.importorskip(reader, reason="the extra vector: there is no wheel for this platform")
    path = upload_picture(UploadRequest(sent or name, body()), context).path
    assert path == ("pictures/a-drawing" if sent else "pictures/rug") + name[-4:]
    recipe = {"picture": path, "size": "20x30cm", "quality": "20x20/dm", "yarns": "wool", **keys}
    knots = first_part(chart(ChartRequest(recipe), context), 60, 40)
    assert len(set(knots[:, :19].ravel().tolist())) == len(set(knots[:, 21:].ravel().tolist())) == 1
    assert knots[0, 0] != knots[0, -1]
    pixels = first_part(picture(PictureRequest(path, most=64, page=keys.get("page", 1)), context), 64, 43, 3)
    assert np.abs(pixels[30, [2, -3]].astype(int) - [RED, NAVY]).max() <= 2


def test_a_missing_extra_is_one_line(context: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("resvg_py", "pypdfium2", "psd_tools"):
        monkeypatch.setitem(sys.modules, name, None)
    for name in ("rug.svg", "rug.pdf"):
        with pytest.raises(PictureError, match=rf"{name} needs the extra vector .*pip install 'ilmek\[vector\]'"):
            upload_picture(UploadRequest(name, DRAWINGS[name][0]()), context)
    assert not (context.folder / "pictures").exists()
    assert upload_picture(UploadRequest("rug.psd", psd()), context).path == "pictures/rug.psd"  # it has its picture


@pytest.mark.parametrize("page", [0, 3])
def test_a_page_that_is_not_there(context: Context, page: int) -> None:
    path = upload_picture(UploadRequest("rug.pdf", pdf()), context).path
    with pytest.raises(IlmekError, match=rf"page={page} is given, and pictures/rug.pdf has 2 pages"):
        picture(PictureRequest(path, page=page), context)
