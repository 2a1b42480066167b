"""The name of a moving picture, checked without the libraries that draw it."""

import importlib.util
from pathlib import Path

from ilmek.errors import OutputError, ParameterError

GIF, MP4 = ".gif", ".mp4"


def checked_animation(path: Path | None) -> Path | None:
    """The file of `--animation`.

    Raises ParameterError unless its name ends with .gif or .mp4, and OutputError for MP4 without the extra `video`.
    """
    if path is None:
        return None
    if path.suffix.lower() not in (GIF, MP4):
        raise ParameterError(
            f"--animation {path}", allowed="FILE.gif or FILE.mp4", do="give a file with such an ending"
        )
    if path.suffix.lower() == MP4 and importlib.util.find_spec("av") is None:
        raise OutputError("--animation: MP4 needs the extra video", do="pip install 'ilmek[video]', or give FILE.gif")
    return path
