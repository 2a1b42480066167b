"""Machine code that is installed with the package, so that the first command does not compile.

When the package is built, its kernels are compiled for a processor that nearly every computer in use has at least
(`BASELINE`), and packed into one archive beside this module (`ilmek.jobs.warm --into`). An entry has the name that the
cache of such a processor gives it (`ilmek.num.machine_code`), so an archive of other sources, libraries or another
Python matches nothing. A checkout has no archive: its kernels are compiled, and kept, when they are first called.
"""

import os
import sys
import zipfile
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import NamedTuple

from ilmek.num.private_files import read_entry


class Processor(NamedTuple):
    """A processor as the compiler names it, and the features that a computer needs to run its code."""

    name: str
    features: tuple[str, ...]


BASELINES = {
    "x86_64": Processor("x86-64-v3", ("avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")),
    "aarch64": Processor("generic", ()),
    "arm64": Processor("generic", ()),
}
"""Architecture, as the compiler's target names it -> the oldest processor that installed kernels serve.

x86-64-v3 is Intel's Haswell of 2013 and AMD's Excavator of 2015.
"""

ARCHIVE = Path(__file__).with_name(f"kernels-{sys.implementation.cache_tag}-{sys.platform}.zip")


def baseline(triple: str) -> Processor | None:
    """The processor of the installed kernels for a target, such as "x86_64-unknown-linux-gnu"; None without one."""
    return BASELINES.get(triple.partition("-")[0])


def compiler_settings(triple: str) -> dict[str, str]:
    """Variables of the environment for code of the baseline processor. Raises KeyError without one."""
    return {"NUMBA_CPU_NAME": BASELINES[triple.partition("-")[0]].name, "NUMBA_CPU_FEATURES": ""}


def pack(entries: Iterable[Path], archive: Path) -> int:
    """Write the entries of a cache folder into an archive. Returns their number.

    The date of all entries is the same, so that the same entries give the same archive.
    """
    paths = sorted(entries)
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for path in paths:
            packed.writestr(zipfile.ZipInfo(path.name), read_entry(path) or b"", zipfile.ZIP_DEFLATED, 9)
    return len(paths)


@cache
def _archive() -> zipfile.ZipFile | None:
    """The archive, opened once; None where the package has none or it cannot be read."""
    if os.environ.get("ILMEK_INSTALLED_KERNELS") == "no":
        return None
    try:
        return zipfile.ZipFile(ARCHIVE)
    except (OSError, zipfile.BadZipFile):
        return None


def read_installed(name: str) -> bytes | None:
    """An entry of the archive; None if there is none, or it is damaged.

    Raises nothing: what is not read is compiled.
    """
    archive = _archive()
    try:
        return archive.read(name) if archive and name in archive.NameToInfo else None
    except (OSError, zipfile.BadZipFile, EOFError):
        return None
