"""A run of the twin in the studio: news of each instant, commands, what is refused."""

import threading
from pathlib import Path

import numpy as np
import pytest
from default_machines import SETTLED
from PIL import Image
from processes import PATIENCE, until

from ilmek.errors import IlmekError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.loom.run import LoomCommand, RunNews, RunRequest, TwinRunEnd, command, run
from ilmek.loom.control.view import Answer
from ilmek.progress import Cancelled, Progress


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("project")
    pixels = np.zeros((12, 16, 3), np.uint8)
    pixels[:, ::2] = (180, 30, 30)
    (folder / "pictures").mkdir()
    Image.fromarray(pixels).save(folder / "pictures" / "small.png")
    recipe = (
        'picture = "pictures/small.png"\nsize = "20x30cm"\nquality = "20x20/dm"\ncolours = 2\n[loom]\nbeat = "comb"\n'
    )
    (folder / "carpet.toml").write_text(recipe + "".join(f'{name} = "{value}"\n' for name, value in SETTLED.items()))
    return folder


def test_a_run_weaves_the_carpet_and_tells_of_it(project: Path) -> None:
    news: list[RunNews] = []
    end = run(RunRequest(speed=1e6), Context(str(project), show=news.append))
    assert (end.state, end.faults) == ("Complete", 0)
    assert end.knots == end.total == 40 * 60
    assert end.last.knots == end.total
    assert end.last.left == 0
    assert [one.knots for one in news] == sorted(one.knots for one in news)


def test_a_run_is_held_led_on_and_stopped_by_commands(project: Path) -> None:
    news: list[RunNews] = []
    context = Context(str(project), show=news.append)
    with pytest.raises(IlmekError, match="no run"):
        command(LoomCommand("hold"), context)
    ends: list[TwinRunEnd] = []
    working = threading.Thread(target=lambda: ends.append(run(RunRequest(speed=500.0), context)))
    working.start()
    try:
        until(lambda: bool(news) and news[-1].state == "Execute", "the first row")
        assert command(LoomCommand("hold"), context) == Answer(True, "")
        until(lambda: news[-1].state == "Held")
        assert command(LoomCommand("resume"), context).ok
        until(lambda: news[-1].state == "Execute")
        assert command(LoomCommand("stop"), context).ok
    finally:
        working.join(PATIENCE)
    assert not working.is_alive()
    assert ends[0].last.state == "Stopped"


def test_a_run_that_is_cancelled_ends_at_once(project: Path) -> None:
    news: list[RunNews] = []
    progress = Progress(cancelled=lambda: len(news) > 2)
    with pytest.raises(Cancelled):
        run(RunRequest(speed=10.0), Context(str(project), progress, news.append))


def test_unknown_commands_speeds_and_files_are_refused(project: Path) -> None:
    context = Context(str(project))
    with pytest.raises(IlmekError, match="the command 'dance'"):
        command(LoomCommand("dance"), context)
    with pytest.raises(IlmekError, match="a clock of 0 times"):
        run(RunRequest(speed=0.0), context)
