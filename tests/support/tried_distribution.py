"""Wheel and sdist, each installed into an empty environment outside the repository and tried there as a user would.

    python tests/support/tried_distribution.py dist constraints.txt examples

Only the standard library is needed. The wheel is built from the sdist, so that the sdist itself is tried by a few
commands without kernels, which would be compiled anew for minutes. The last lines name the Python, the files and the
seconds.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path

COMMANDS = (
    ("--version", 0),
    ("machines", 0),
    ("chart examples/medallion.png --size yastik --quality 20x20/dm --out chart", 0),
    ("weave examples/medallion.png --size seccade --quality 25x25/dm --out medallion", 0),
    ("check medallion/programme.ilmek --loom medallion/machine.json", 0),
    ("inspect medallion/programme.ilmek", 0),
    ("design beat-up --report beat-up.html --workshop parts", 0),
    ("design knotting-four-bar", 3),
    ("mechanism examples/slider_crank_press.toml --report press.html", 0),
    ("cyclogram examples/press.toml --solve period", 0),
    ("knot examples/gripper_path.csv --pitch 2mm", 0),
    ("reproduce --paper tufting", 0),
    ("chart nothing.png", 2),
)
"""Commands, and the exit code that each must have."""

OF_SDIST = ("--version", "machines", "chart nothing.png")
"""Those of them by which an sdist is tried."""

FILES = (
    *("chart/chart.png", "medallion/report.html", "medallion/programme.ilmek"),
    *("beat-up.html", "parts/crank.dxf", "press.html"),
)
"""Files that the commands must have written."""


def tried(distribution: Path, constraints: Path, examples: Path) -> None:
    """Install a distribution into an empty environment and run the commands. Raises SystemExit where one fails."""
    built = distribution.suffix == ".whl"
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONHOME")}
    environment |= {} if built else {"ILMEK_KERNELS": "no"}
    with tempfile.TemporaryDirectory(prefix="ilmek-dist-") as name:
        folder = Path(name)
        scripts = _installed(distribution, constraints, folder / "environment", environment)
        work = folder / "work"
        shutil.copytree(examples, work / "examples")
        for command, code in COMMANDS:
            if built or command in OF_SDIST:
                _run([str(scripts / "ilmek"), *command.split()], work, environment, code)
        missing = [file for file in FILES if built and not (work / file).exists()]
        if missing:
            raise SystemExit(f"not written: {', '.join(missing)}")


def _installed(distribution: Path, constraints: Path, folder: Path, environment: dict[str, str]) -> Path:
    """The folder of the commands of a new environment in which a distribution is installed."""
    begin = time.monotonic()
    venv.create(folder, with_pip=True)
    scripts = folder / ("Scripts" if os.name == "nt" else "bin")
    pip = [str(scripts / "python"), "-m", "pip", "--disable-pip-version-check", "--quiet"]
    install = [*pip, "install", "--constraint", str(constraints), str(distribution)]
    for command in (install, [*pip, "check"]):
        subprocess.run(command, env=environment, check=True)
    _show(f"  {time.monotonic() - begin:5.1f} s  installed with what it needs")
    return scripts


def _run(command: list[str], work: Path, environment: dict[str, str], code: int) -> None:
    """Run a command. Raises SystemExit where it ends with another code."""
    begin = time.monotonic()
    done = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True, check=False)
    shown = " ".join(command[1:])
    _show(f"  {time.monotonic() - begin:5.1f} s  ilmek {shown}")
    if done.returncode != code:
        raise SystemExit(f"{shown!r} ends with {done.returncode} instead of {code}:\n{done.stdout}{done.stderr}")


def _show(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main(folder: str, constraints: str, examples: str) -> None:
    """Try every wheel and sdist of a folder."""
    distributions = sorted(Path(folder).resolve().glob("*.whl")) + sorted(Path(folder).resolve().glob("*.tar.gz"))
    if [path.suffix for path in distributions] != [".whl", ".gz"]:
        raise SystemExit(f"{folder} must have one wheel and one sdist")
    for distribution in distributions:
        _show(
            f"{distribution.name}, {distribution.stat().st_size / 1e6:.1f} MB, Python {sys.version.split()[0]}",
        )
        tried(distribution, Path(constraints).resolve(), Path(examples).resolve())
    _show("wheel and sdist install and run")


if __name__ == "__main__":
    main(*sys.argv[1:])
