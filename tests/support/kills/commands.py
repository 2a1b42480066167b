"""The commands that are killed. Each has two variants: one makes the old result, the other the new one."""

import random
import shutil
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[3]
EXAMPLES = ("press.toml", "jansen_leg.toml", "wool.toml")
PICTURES = {"small.png": (48, 64), "large.png": (4000, 6000)}


@dataclass(frozen=True)
class Command:
    """A command line.

    name       in the table
    arguments  common to both variants, with `{}` where they differ
    variants   what stands there
    outputs    files and folders that it writes, relative to its folder
    """

    name: str
    arguments: tuple[str, ...]
    variants: tuple[str, str]
    outputs: tuple[str, ...]

    def line(self, variant: int) -> list[str]:
        """The arguments of a variant."""
        return [argument.format(self.variants[variant]) for argument in self.arguments]


def _command(line: str, *outputs: str, variants: tuple[str, str]) -> Command:
    arguments = tuple(line.split())
    return Command(arguments[0], arguments, variants, outputs)


COMMANDS = (
    _command(
        "weave small.png --size 24x32cm --quality {}/dm --out out --json out.json --force",
        *("out", "out.json"),
        variants=("20x20", "20x22"),
    ),
    _command("chart small.png --size 24x32cm --quality {}/dm --out out --force", "out", variants=("20x20", "20x22")),
    _command(
        "design beat-up --set swing={} --workshop parts --report page.html --json page.json --force",
        *("parts", "page.html", "page.json"),
        variants=("30deg", "32deg"),
    ),
    _command(
        "cyclogram press.toml --solve {} --out quick.toml --csv motions.csv --force",
        *("quick.toml", "motions.csv"),
        variants=("period", "acceleration"),
    ),
    _command(
        "mechanism jansen_leg.toml --speed 60rpm --steps {} --csv motion.csv --json motion.json",
        *("motion.csv", "motion.json"),
        variants=("300", "360"),
    ),
)
"""Files are replaced without --force too, if ilmek wrote them and they have not changed."""

LONG = (
    _command("design path-four-bar --set starts={} --json page.json --force", "page.json", variants=("40", "400")),
    _command("weave large.png --size {} --quality 60x60/dm --out out --force", "out", variants=("2x3m", "3.3x5m")),
    _command("reproduce --paper {} --json page.json --force", "page.json", variants=("beat-up", "thesis")),
    _command(
        "mechanism jansen_leg.toml --speed 60rpm --steps {} --csv motion.csv --force",
        "motion.csv",
        variants=("1000", "100000"),
    ),
)
"""Commands that work long: the second variant is interrupted, and only the time to its end is measured."""


def prepare(folder: Path, *, large: bool = False) -> None:
    """Put the inputs into a folder."""
    folder.mkdir(parents=True)
    for name in EXAMPLES:
        shutil.copyfile(ROOT / "examples" / name, folder / name)
    for name in PICTURES if large else ("small.png",):
        width, height = PICTURES[name]
        noise = random.Random(1).randbytes(width * height * 3)
        Image.frombytes("RGB", (width, height), noise).save(folder / name, compress_level=1)
