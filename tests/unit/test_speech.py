"""Spoken rows and the foot switch: programs of speech that write down what they are given."""

import os
import stat
import time
from pathlib import Path

import pytest
from click.testing import CliRunner
from processes import PATIENCE
from tests.unit.test_call_command import CHART, MARKED

from ilmek.cli import main
from ilmek.cli.call_screen import spoken_step
from ilmek.cli.keys import keys_of
from ilmek.drivers.speech import Speaker
from ilmek.errors import OutputError
from ilmek.jobs.call import Calling
from ilmek.sentences import WEAVERS, in_language

RECORDER = """#!/bin/sh
if [ "$2" = "?" ]; then
  echo "Alex                en_US    # Most people recognise me by my voice."
  echo "Yelda               tr_TR    # Merhaba, benim adim Yelda."
  exit
fi
echo "$@" >> "$(dirname "$0")/said"
cat >> "$(dirname "$0")/said"
"""


def program(folder: Path, name: str, script: str = RECORDER) -> Path:
    (folder / name).write_text(script, encoding="utf-8")
    (folder / name).chmod(stat.S_IRWXU)
    return folder / "said"


def ended(speaker: Speaker) -> None:
    """Wait until the program has ended by itself."""
    assert speaker._process is not None
    speaker._process.wait(PATIENCE)


@pytest.fixture
def only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The only folder of programs that is searched."""
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}/bin{os.pathsep}/usr/bin")
    monkeypatch.setattr("shutil.which", lambda name: str(tmp_path / name) if (tmp_path / name).exists() else None)
    return tmp_path


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("espeak-ng", "-v tr --stdin"),
        ("spd-say", "--wait --language tr --pipe-mode"),
        ("say", "-v Yelda -f -"),
        ("powershell", "-NoProfile -Command Add-Type"),
    ],
)
def test_each_program_gets_language_and_text(name: str, arguments: str, only: Path) -> None:
    said = program(only, name)
    with Speaker("tr") as speaker:
        speaker.say("sıra 1. 12. kökboya kırmızısı.")
        ended(speaker)
        assert not speaker.failed
    text = said.read_text(encoding="utf-8")
    assert text.startswith(arguments)
    assert "kökboya kırmızısı" in text


def test_a_new_text_stops_the_one_before(only: Path) -> None:
    said = program(only, "espeak-ng", "#!/bin/sh\nread text\nexec sleep 60\n")
    with Speaker("fa") as speaker:
        began = time.monotonic()
        for number in range(5):
            speaker.say(f"{number}")
    assert time.monotonic() - began < 20
    assert not said.exists()


def test_what_is_missing_is_one_clear_error(only: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"no program of speech is installed; espeak-ng.*install espeak-ng"):
        Speaker("fa")
    program(only, "say")
    with pytest.raises(OutputError, match="no voice of 'fa' is installed"):
        Speaker("fa")
    refused = CliRunner().invoke(main, ["call", str(tmp_path / "chart.png"), "--speak"])
    assert refused.exit_code == 2
    assert "--speak calls on a terminal" in refused.stderr


def test_a_program_that_fails_is_noted(only: Path) -> None:
    program(only, "espeak-ng", "#!/bin/sh\nexit 1\n")
    with Speaker("ne") as speaker:
        speaker.say("लहर")
        ended(speaker)
        assert speaker.failed


def test_steps_are_spoken_in_every_language() -> None:
    """The number of the row at its begin; then knots and yarn."""
    calling = Calling(CHART, "runs", "right", 2)
    assert spoken_step(calling) == "row 2. 1. madder."
    calling.forward()
    assert spoken_step(calling) == "4. indigo."
    with in_language("fa"):
        assert spoken_step(Calling(CHART, "runs", "right", 2)) == "رج ۲. ۱. madder."
    half = Calling(MARKED, "runs", "right", 3)
    texts = set()
    for language in WEAVERS:
        with in_language(language):
            texts.add(spoken_step(half))
    assert len(texts) == len(WEAVERS)


def test_a_foot_switch_stays_in_its_row() -> None:
    assert list(keys_of(b"a\x1b[6~c\x1b[5~b \r", pedal=True)) == ["back", "next", "next", "back", *["next"] * 3]
    assert list(keys_of(b"a\x1b[6~c")) == ["row"]
