"""Sheets of squared paper as a camera sees them: a chart that is known, printed, bent, lit, photographed and stored."""

import io
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

Picture = NDArray[np.uint8]
PAPER = (246, 244, 236)


@dataclass(frozen=True)
class Sheet:
    """A photographed sheet and its truth: for each cell the number of its colour; the palette."""

    picture: Picture
    truth: NDArray[np.int64]
    palette: Picture


def random_palette(rng: np.random.Generator, count: int) -> Picture:
    """Colours at least 50 codes apart from each other and 40 from black, as inks are."""
    chosen: list[NDArray[np.int64]] = []
    while len(chosen) < count:
        colour = rng.integers(35, 246, 3)
        if all(np.linalg.norm(colour - other) > 50 for other in chosen):
            chosen.append(colour)
    return np.array(chosen, dtype=np.uint8)


def random_design(rng: np.random.Generator, rows: int, columns: int, colours: int) -> NDArray[np.int64]:
    """A border, discs, bars and lone cells, each colour somewhere."""
    design = np.zeros((rows, columns), dtype=np.int64)
    border = int(rng.integers(1, 4))
    design[:border] = design[-border:] = 1
    design[:, :border] = design[:, -border:] = 1
    y, x = np.mgrid[:rows, :columns]
    for number in range(3 * colours):
        colour, cy, cx = number % colours, rng.integers(0, rows), rng.integers(0, columns)
        reach = rng.integers(2, max(3, min(rows, columns) // 6))
        near = (abs(y - cy) + abs(x - cx) <= reach) if number % 2 else (abs(y - cy) <= reach) & (abs(x - cx) <= 1)
        design[near] = colour
    lone = rng.random(design.shape) < 0.01
    design[lone] = rng.integers(0, colours, int(lone.sum()))
    return design


def printed(  # noqa: C901
    rng: np.random.Generator,
    design: NDArray[np.int64],
    palette: Picture,
    pitch: int,
    *,
    line: int = 120,
    heavy: int = 10,
    letters: bool = False,
    faded: float = 0.0,
    margin: int = 0,
    numbers: bool = False,
) -> Picture:
    """The sheet flat and evenly lit.

    line     code of the grey lines        heavy   every so many lines is darker and, from pitch 12, thicker
    letters  one in each cell              faded   share of the line segments that are not printed
    margin   of paper [pixels]             numbers of rows and columns in the margin
    """
    rows, columns = design.shape
    drawing = np.repeat(np.repeat(palette[design], pitch, 0), pitch, 1)
    picture = Image.new("RGB", (columns * pitch + 2 * margin + 1, rows * pitch + 2 * margin + 1), PAPER)
    picture.paste(Image.fromarray(drawing), (margin, margin))
    draw = ImageDraw.Draw(picture)
    font = ImageFont.load_default(max(6, int(pitch * 0.55)))
    if letters:
        for row in range(rows):
            for column in range(columns):
                dark = int(palette[design[row, column]].astype(int).sum()) < 380
                at = margin + (column + 0.5) * pitch, margin + (row + 0.5) * pitch
                draw.text(
                    at,
                    "ABCDEFGHJKLMNP"[design[row, column]],
                    fill=(240,) * 3 if dark else (30,) * 3,
                    font=font,
                    anchor="mm",
                )
    if numbers:
        for column in range(0, columns, 10):
            draw.text((margin + column * pitch, margin * 0.5), str(column), fill=(40, 40, 40), font=font, anchor="mm")
        for row in range(0, rows, 10):
            draw.text((margin * 0.5, margin + row * pitch), str(row), fill=(40, 40, 40), font=font, anchor="mm")
    for across in (False, True):
        for number in range((rows if across else columns) + 1):
            strong = heavy and number % heavy == 0
            code, width = (line // 2 if strong else line), (2 if strong and pitch >= 12 else 1)
            for part in range(columns if across else rows):
                if rng.random() < faded:
                    continue
                one, begin, end = margin + number * pitch, margin + part * pitch, margin + (part + 1) * pitch
                ends = (begin, one, end, one) if across else (one, begin, one, end)
                draw.line(ends, fill=(code,) * 3, width=width)
    return np.asarray(picture)


def photographed(
    rng: np.random.Generator,
    flat: Picture,
    *,
    perspective: float = 0.0,
    bend: float = 0.0,
    turn: float = 0.0,
    shadow: float = 0.0,
    noise: float = 0.0,
    blur: float = 0.0,
    quality: int | None = None,
    around: float = 0.06,
) -> Picture:
    """A flat sheet on a table under a camera.

    perspective, bend  displacements, of the short side     turn     [rad]
    shadow             share of the light that is lost in it   noise, blur  [codes], [pixels]     quality  of the JPEG
    around             margin of the table, of the short side
    """
    height, width = flat.shape[:2]
    short = min(height, width)
    tilts, phases = (rng.uniform(-1, 1), rng.choice([-1, 1])), rng.uniform(0, 6, 2)
    while True:
        edge = round(around * short)
        y, x = np.mgrid[-edge : height + edge, -edge : width + edge].astype(float)
        s, t = (x - width / 2) / short, (y - height / 2) / short
        c, n = np.cos(turn), np.sin(turn)
        s, t = c * s + n * t, -n * s + c * t
        depth = 1 + perspective * (tilts[0] * s + tilts[1] * t) * short / max(height, width)
        s, t = s / depth, t / depth
        s = s + bend * np.sin(2.0 * t + phases[0]) * 0.5
        t = t + bend * np.sin(2.5 * s + phases[1]) * 0.5
        at = np.stack([t * short + height / 2, s * short + width / 2])
        inside = (at[0] > 0) & (at[0] < height) & (at[1] > 0) & (at[1] < width)
        if not (inside[0].any() or inside[-1].any() or inside[:, 0].any() or inside[:, -1].any()):
            break
        around += 0.04
    table = rng.integers(60, 180, 3)
    made = np.stack(
        [
            scipy.ndimage.map_coordinates(flat[..., k].astype(np.float32), at, order=1, cval=float(table[k]))
            for k in range(3)
        ],
        axis=-1,
    )
    angle = rng.uniform(0, 6)
    far = np.cos(angle) * s + np.sin(angle) * t
    light = 1 - shadow / (1 + np.exp(-(far - rng.uniform(-0.2, 0.2)) / 0.06)) - 0.3 * shadow * far
    made = made * light[..., None]
    if blur:
        made = scipy.ndimage.gaussian_filter(made, (blur, blur, 0))
    made = made + rng.normal(0, noise, made.shape) if noise else made
    picture = np.clip(np.rint(made), 0, 255).astype(np.uint8)
    if quality is None:
        return picture
    stored = io.BytesIO()
    Image.fromarray(picture).save(stored, "JPEG", quality=quality)
    return np.asarray(Image.open(stored).convert("RGB"))


def random_sheet(seed: int, *, small: bool = False) -> Sheet:
    """A sheet with everything at random: 30 to 110 cells a side (small: 24 to 36), pitch 12 to 26 px."""
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(24, 36, 2) if small else rng.integers(30, 110, 2)
    pitch, colours = int(rng.integers(12, 26)), int(rng.integers(3, 9))
    palette = random_palette(rng, colours)
    design = random_design(rng, int(rows), int(columns), colours)
    flat = printed(
        rng,
        design,
        palette,
        pitch,
        line=int(rng.integers(40, 190)),
        heavy=int(rng.choice([0, 5, 10])),
        letters=bool(rng.random() < 0.5),
        faded=float(rng.choice([0.0, 0.2, 0.4])),
        margin=int(rng.choice([0, 3 * pitch])),
        numbers=bool(rng.random() < 0.5),
    )
    picture = photographed(
        rng,
        flat,
        perspective=float(rng.uniform(0, 0.25)),
        bend=float(rng.uniform(0, 0.04)),
        turn=float(rng.uniform(-0.08, 0.08)),
        shadow=float(rng.uniform(0, 0.45)),
        noise=float(rng.uniform(0, 5)),
        blur=float(rng.uniform(0, 1.0)),
        quality=int(rng.integers(60, 95)),
    )
    return Sheet(picture, design, palette)
