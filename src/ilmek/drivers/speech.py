"""Speech through the system: the first program of speech that is installed says one text after the other.

| program | system |
|---|---|
| espeak-ng | Linux, Windows, macOS; has all languages of the weaver's papers |
| spd-say | Linux, by Speech Dispatcher |
| say | macOS, where a voice of the language is installed |
| powershell | Windows, where a voice of the language is installed |
"""

import re
import shutil
import subprocess
from collections.abc import Sequence
from contextlib import suppress

from ilmek.errors import OutputError

_OF_WINDOWS = (
    "Add-Type -AssemblyName System.Speech; $s = New-Object System.Speech.Synthesis.SpeechSynthesizer; "
    "$v = $s.GetInstalledVoices() | Where-Object {{ $_.VoiceInfo.Culture.TwoLetterISOLanguageName -eq '{language}' }} "
    "| Select-Object -First 1; if (-not $v) {{ exit 4 }}; $s.SelectVoice($v.VoiceInfo.Name); "
    "[Console]::InputEncoding = [Text.Encoding]::UTF8; $s.Speak([Console]::In.ReadToEnd())"
)
_LONGEST = 10.0
"""Time in which a program lists its voices [s]."""


class Speaker:
    """A program of speech in a language; each text stops the one before.

    Raises OutputError where none is installed, or none has a voice of the language.
    """

    def __init__(self, language: str) -> None:
        self.language = language
        self._command = _command(language)
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def program(self) -> str:
        """The path of the program."""
        return self._command[0]

    @property
    def failed(self) -> bool:
        """Whether the program ended with an error by itself."""
        return self._process is not None and (self._process.poll() or 0) > 0

    def say(self, text: str) -> None:
        """Say a text, without waiting for its end. Raises OutputError where the program cannot be started."""
        self.stop()
        quiet = subprocess.DEVNULL
        try:
            process = subprocess.Popen(self._command, stdin=subprocess.PIPE, stdout=quiet, stderr=quiet)
        except OSError as error:
            raise OutputError(f"--speak: {self.program} cannot be started ({error.strerror})") from None
        self._process = process
        assert process.stdin is not None
        with suppress(BrokenPipeError), process.stdin as words:  # a program that ends at once has failed
            words.write(text.encode("utf-8"))

    def __enter__(self) -> "Speaker":
        return self

    def __exit__(self, *_error: object) -> None:
        self.stop()

    def stop(self) -> None:
        """Stop what is being said."""
        if self._process is not None:
            self._process.terminate()
            self._process.wait()
            self._process = None


def _command(language: str) -> Sequence[str]:
    """The program and its arguments; it reads the text from its standard input."""
    if program := shutil.which("espeak-ng"):
        return (program, "-v", language, "--stdin")
    if program := shutil.which("spd-say"):
        return (program, "--wait", "--language", language, "--pipe-mode")
    if program := shutil.which("say"):
        listed = subprocess.run([program, "-v", "?"], capture_output=True, timeout=_LONGEST, check=False).stdout
        voice = re.search(rf"^(.+?) +{language}[_-]\w+ +#", listed.decode("utf-8", "replace"), re.MULTILINE)
        if voice is not None:
            return (program, "-v", voice[1], "-f", "-")
        raise OutputError(f"--speak: no voice of {language!r} is installed", do="add it in the settings of the system")
    if program := shutil.which("powershell"):
        return (program, "-NoProfile", "-Command", _OF_WINDOWS.format(language=language))
    raise OutputError(
        "--speak: no program of speech is installed",
        allowed="espeak-ng, spd-say, say or powershell",
        do="install espeak-ng, or leave --speak out",
    )
