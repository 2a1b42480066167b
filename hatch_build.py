"""What a build of the wheel does: the kernels are compiled, so that the first command after `pip install` does not.

They are compiled with the libraries of the build, and used where the installed ones have the same versions
(`ilmek.num.installed_kernels`). ILMEK_KERNELS=no leaves them out: for a development checkout, which compiles its own.
"""

import os
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class Kernels(BuildHookInterface):  # type: ignore[type-arg]
    """The hook of the build."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        """What the build needs beside its tool: all that the package itself needs, to run it."""
        if os.environ.get("ILMEK_KERNELS") == "no":
            return []
        project = tomllib.loads((Path(self.root) / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        return list(project["dependencies"])

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile the kernels into the wheel. Where that fails, the wheel has none, and says so."""
        if version == "editable" or os.environ.get("ILMEK_KERNELS") == "no":
            return
        source = Path(self.root) / "src"
        name = f"kernels-{sys.implementation.cache_tag}-{sys.platform}.zip"
        archive = Path(self.root) / "build" / name
        newest = max(file.stat().st_mtime for file in source.rglob("*.py"))
        if not archive.exists() or archive.stat().st_mtime < newest:  # pip builds twice, for the metadata too
            archive.unlink(missing_ok=True)
            archive.parent.mkdir(exist_ok=True)
            self.app.display_waiting("compiling the kernels, two to four minutes")
            # The libraries of the build are on the path of this process alone.
            environment = dict(os.environ, PYTHONPATH=os.pathsep.join((str(source), *filter(None, sys.path))))
            command = [sys.executable, "-m", "ilmek.jobs.warm", "--into", str(archive)]
            done = subprocess.run(command, env=environment, stderr=subprocess.PIPE, text=True, check=False)
            if done.returncode:
                reason = (done.stderr.strip() or "no reason").splitlines()[-1]
                self.app.display_warning(f"no kernels in the wheel: {reason}")
        if archive.exists():
            build_data["force_include"][str(archive)] = f"ilmek/num/{name}"
