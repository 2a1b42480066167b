"""A small project of the studio, and how its files are read and saved."""

from pathlib import Path

from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.opening import open_project
from ilmek.jobs.studio.project.tasks import FileContent, PathRequest, SaveRequest, read_file, save_file

RECIPE = 'plain = "ivory"  # the field\nsize = "60x90cm"\n\n# the edge\n[[border]]\nyarn = "dark red"\nwidth = 3\n'


def sample_project(parent: Path) -> Path:
    """A project with a carpet and a machine, in a new folder."""
    base = parent / "mine"
    (base / "machines").mkdir(parents=True)
    (base / "carpet.toml").write_text(RECIPE)
    (base / "machines" / "beat-up.toml").write_text('machine = "beat-up"\n\n[settings]\nswing = "30deg"\n')
    return open_project(base)


def content(context: Context, path: str = "carpet.toml") -> FileContent:
    return read_file(PathRequest(path), context)


def save(context: Context, text: str, path: str = "carpet.toml") -> FileContent:
    saved = save_file(SaveRequest(path, content(context, path).digest, text=text), context)
    assert saved.saved
    return saved.file
