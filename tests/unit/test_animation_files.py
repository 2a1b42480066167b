"""`--animation`: pictures that move, as files that are whole or not there."""

import importlib.util
import io
import itertools
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner, Result
from default_machines import default_report
from PIL import Image, ImageChops, ImageSequence

from ilmek.cli import main
from ilmek.io.moving_picture import gif, write_mp4
from ilmek.io.output import Outputs
from ilmek.jobs import animation as job
from ilmek.progress import Cancelled, Progress
from ilmek.report import Animation, Report
from ilmek.viz import animation_frames
from ilmek.viz.looks import looked

ROOT = Path(__file__).parents[2]
FEW = 12
ROCKER, COUPLER, CRANK = (0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00), (0x00, 0x9E, 0x73)


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, arguments)


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> int:
    """A run of a few pictures."""
    for module in (animation_frames, job):
        monkeypatch.setattr(module, "PICTURES", FEW)
    return FEW


@pytest.fixture(scope="module")
def four_bar() -> Report:
    return default_report("function-four-bar")


def pictures(report: Report) -> list[Image.Image]:
    (animation,) = (one for one in looked(report.figures) if isinstance(one, Animation))
    return list(animation_frames.pictures(animation))


def test_a_run_takes_five_seconds() -> None:
    assert animation_frames.PICTURES / animation_frames.RATE == 5.0


def test_a_mechanism_of_a_file_is_written_as_gif(tmp_path: Path, few: int) -> None:
    to = tmp_path / "klann.gif"
    shown = run("mechanism", str(ROOT / "examples/klann_leg.toml"), "--animation", str(to))
    assert shown.exit_code == 0
    assert f"animation: {to}" in shown.output
    assert to.stat().st_size < 24_000 * few, "3 MB for 125 pictures"
    with Image.open(to) as file:
        assert (file.n_frames, file.info["duration"], file.info["loop"]) == (few, 40, 0)
        assert file.size[0] == 960
        assert file.size[1] % 2 == 0
        frames = [frame.convert("RGB") for frame in itertools.islice(ImageSequence.Iterator(file), 0, None, 3)]
    assert {frame.getpixel((2, 2)) for frame in frames} == {(255, 255, 255)}
    assert all(ImageChops.difference(*pair).getbbox() is not None for pair in itertools.pairwise(frames))


def test_bodies_have_the_colours_of_the_page_and_stand_where_they_are(few: int, four_bar: Report) -> None:
    """Colours of the rocker's, the coupler's and the crank's edges are those of the palette."""
    drawn = pictures(four_bar)
    assert len(drawn) == few
    for colour in ROCKER, COUPLER, CRANK:
        for one in (drawn[0], drawn[few // 2]):
            assert np.count_nonzero((np.asarray(one) == colour).all(axis=2)) > 300


def test_the_same_pictures_give_the_same_bytes(few: int, four_bar: Report) -> None:
    first, second = (gif(iter(pictures(four_bar)), 25, animation_frames.COLOURS) for _ in range(2))
    assert first == second
    with Image.open(io.BytesIO(first)) as file:
        file.seek(few // 2)
        shown = np.asarray(file.convert("RGB"))
    for colour in ROCKER, COUPLER, CRANK:
        assert np.count_nonzero((shown == colour).all(axis=2)) > 300


@pytest.mark.parametrize(
    ("name", "told"),
    [("run.avi", "FILE.gif or FILE.mp4"), ("-", "FILE.gif or FILE.mp4"), ("run.mp4", "pip install 'ilmek[video]'")],
)
def test_a_name_that_cannot_be_written_is_refused_before_any_work(
    name: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    shown = run("design", "beat-up", "--animation", name)
    assert shown.exit_code == 2
    assert told in shown.stderr
    assert len(shown.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_what_does_not_move_has_no_animation(tmp_path: Path) -> None:
    file = str(ROOT / "examples/tufting_needle.toml")
    shown = run("mechanism", file, "--at", "30deg", "--animation", str(tmp_path / "run.gif"))
    assert shown.exit_code == 2
    assert "shows no motion" in shown.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_replaced_only_by_force_and_an_input_never(tmp_path: Path, few: int) -> None:
    to = tmp_path / "run.gif"
    to.write_text("mine")
    arguments = ("design", "hammer", "--animation", str(to))
    assert run(*arguments).exit_code == 2
    assert to.read_text() == "mine"
    assert run(*arguments, "--force").exit_code == 0
    assert to.read_bytes().startswith(b"GIF89a")
    mechanism = tmp_path / "mechanism.gif"
    mechanism.write_bytes((ROOT / "examples/quick_return.toml").read_bytes())
    before = mechanism.read_bytes()
    assert run("mechanism", str(mechanism), "--animation", str(mechanism), "--force").exit_code == 2
    assert mechanism.read_bytes() == before


def test_a_cancelled_run_leaves_nothing(tmp_path: Path, few: int, four_bar: Report) -> None:
    calls = itertools.count()
    progress = Progress(cancelled=lambda: next(calls) > few // 2)
    with Outputs() as outputs, pytest.raises(Cancelled):
        job.write_animation(four_bar, tmp_path / "run.gif", outputs, progress)
    assert list(tmp_path.iterdir()) == []


def test_mp4_is_h264_in_420_with_all_pictures(
    tmp_path: Path, few: int, four_bar: Report, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The calls of the encoder, on a stand-in: codec, format, sizes, pictures in order, and what is left at the end."""
    stream, written, opened = _Stream(), [], []

    class Container:
        def __enter__(self) -> "Container":
            return self

        def __exit__(self, *_: object) -> None:
            return None

        def add_stream(self, codec: str, rate: int) -> "_Stream":
            opened.append((codec, rate))
            return stream

        def mux(self, packet: object) -> None:
            written.append(packet)

    frame = SimpleNamespace(from_image=lambda picture: picture)
    av = SimpleNamespace(open=lambda *_, **__: Container(), VideoFrame=frame)
    monkeypatch.setitem(sys.modules, "av", av)
    given = pictures(four_bar)
    write_mp4(tmp_path / "run.mp4", iter(given), 25)
    assert opened == [("libx264", 25)]
    assert (stream.pix_fmt, stream.width % 2, stream.height % 2) == ("yuv420p", 0, 0)
    assert written == [*given, None]


class _Stream:
    """A stream that returns each picture as a packet."""

    width = height = 0
    pix_fmt = ""

    def encode(self, picture: object = None) -> list[object]:
        return [picture]
