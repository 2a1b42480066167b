"""Commands of a page: those of `ilmek` in this process, others in a shell, servers beside the page."""

import contextlib
import fcntl
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from click.testing import CliRunner

from ilmek.cli import main

ROOT = Path(__file__).parents[3]
BESIDE = "in a terminal of its own"
_CODE = re.compile(r"#.*exit code (\d+)")
_LONGEST = 120.0


def logical_lines(text: str) -> Iterator[str]:
    """The commands of a block, lines that end with a backslash joined.

    >>> list(logical_lines("a \\\\\\n  b\\n\\n# only a comment\\nc"))
    ['a    b', 'c']
    """
    for line in text.replace("\\\n", " ").splitlines():
        if line.strip() and not line.lstrip().startswith("#"):
            yield line


def expected_code(line: str) -> int:
    """The exit code that a command's comment states.

    >>> expected_code("ilmek design tufting   # exit code 3: a check fails"), expected_code("ls")
    (3, 0)
    """
    code = _CODE.search(line)
    return int(code[1]) if code else 0


@dataclass
class Shell:
    """A terminal in a folder.

    folder  where it is      shared  folder of carpets that several pages weave by one command
    """

    folder: Path
    shared: Path
    home: Path
    beside: list[tuple[str, subprocess.Popen[str]]] = field(default_factory=list)

    @property
    def environment(self) -> Mapping[str, str]:
        """Of every command: this package, a state and a configuration of its own, no browser."""
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        own = {"XDG_CONFIG_HOME": str(self.home / ".config"), "XDG_STATE_HOME": str(self.home / ".local/state")}
        return {**os.environ, **own, "PATH": path, "PYTHONPATH": str(ROOT / "src"), "BROWSER": "true"}

    def run(self, line: str) -> tuple[int, str]:
        """Exit code and output of a command."""
        words = shlex.split(line, comments=True)
        tokens = shlex.shlex(line, posix=True, punctuation_chars=True)
        signs = [token for token in tokens if set(token) <= set("|&;<>()")]
        if words[0] == "cd":
            self.folder = (self.folder / words[1]).resolve()
            return 0, ""
        serves = words[:2] == ["ilmek", "serve"] and not {"--add-user", "--nodeset"} & {*words}
        if serves or words[:2] == ["ilmek", "studio"] or BESIDE in line:
            return self._beside(line, words)
        if words[0] != "ilmek" or signs or "$" in line:
            return self._shell(line)
        if words[1] == "weave" and "--out" in words and self._only_shipped(words):
            return self._once(words)
        return self._here(words)

    def _here(self, words: list[str]) -> tuple[int, str]:
        with contextlib.chdir(self.folder):
            result = CliRunner().invoke(main, words[1:], env=dict(self.environment))
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        return result.exit_code, result.output

    def _shell(self, line: str) -> tuple[int, str]:
        done = subprocess.run(
            ["bash", "-c", line],
            check=False,
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=_LONGEST,
        )
        return done.returncode, done.stdout

    def _beside(self, line: str, words: list[str]) -> tuple[int, str]:
        """Start a command that goes on; its output is the first line that it prints, if it prints one soon."""
        log = self.home / f"beside-{len(self.beside)}.txt"
        with log.open("w", encoding="utf-8") as output:
            process = subprocess.Popen(
                ["bash", "-c", f"exec {line}"],
                cwd=self.folder,
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                text=True,
            )
        self.beside.append((line, process))
        shown = self.folder / words[words.index(">") + 1] if ">" in words else log
        socket = self.folder / Path(words[2]).with_suffix(".journal") / "control"
        until = time.monotonic() + _LONGEST
        while process.poll() is None and time.monotonic() < until:
            if (words[1] == "run" and socket.exists()) or (
                shown.exists() and shown.read_text(encoding="utf-8").endswith("\n")
            ):
                return 0, log.read_text(encoding="utf-8")
            time.sleep(0.02)
        return process.returncode or 0, log.read_text(encoding="utf-8")

    def _only_shipped(self, words: list[str]) -> bool:
        """Whether a command reads only files of examples/, and writes a folder that does not exist."""
        out = words[words.index("--out") + 1]
        files = [word for word in words if (self.folder / word).exists() and word != out]
        return not (self.folder / out).exists() and all(Path(word).parts[:1] == ("examples",) for word in files)

    def _once(self, words: list[str]) -> tuple[int, str]:
        """As `_here`, but woven once for all pages."""
        out = words[words.index("--out") + 1]
        kept = self.shared / hashlib.sha256("\0".join(words).encode()).hexdigest()[:16]
        kept.mkdir(parents=True, exist_ok=True)
        with (kept / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not (kept / "output").exists():
                (kept / "examples").symlink_to(ROOT / "examples")
                code, output = Shell(kept, self.shared, self.home)._here(words)
                (kept / "output").write_text(f"{code}\n{output}", encoding="utf-8")
        code_line, _, output = (kept / "output").read_text(encoding="utf-8").partition("\n")
        if (kept / out).exists():
            shutil.copytree(kept / out, self.folder / out)
        return int(code_line), output

    def end(self) -> None:
        """End what runs beside the page."""
        for _, process in self.beside:
            if process.poll() is None:
                process.terminate()
        for _, process in self.beside:
            try:
                process.wait(30)
            finally:
                process.kill()
