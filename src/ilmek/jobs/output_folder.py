"""The default output folder of a job."""

import re
from itertools import count
from pathlib import Path


def free_folder(picture: Path, kind: str) -> Path:
    """An unused folder in the current one, named after the picture: `photo-carpet`, `photo-carpet-2`."""
    stem = re.sub(r"[^\w.-]+", "-", picture.stem).strip("-.") or "picture"
    names = (f"{stem[:80]}-{kind}" + (f"-{number}" if number > 1 else "") for number in count(1))
    return next(Path(name) for name in names if not Path(name).exists())
