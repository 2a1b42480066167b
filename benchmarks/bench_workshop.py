"""All papers of the default loom: processor time of its command, and of the search for the order of assembly."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.tree_manual import UP
from ilmek.part.insertion import insertions

ALLOWED, ORDER = 90.0, 10.0
"""Of the whole folder, and of the order of assembly in it [s]."""

UNIT = [sys.executable, "-c", "import numpy"]
"""What stands for the speed of the computer, and for what else it does, beside them."""


def command_seconds(command: list[str]) -> float:
    """Processor time of a command [s]."""
    before = os.times()
    subprocess.run(command, check=True, capture_output=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def run() -> None:
    """Print the times."""
    tree = loom_tree(design(AutomatedLoomParams()))
    begun = time.process_time()
    steps = insertions(tree, UP, frozenset((part_id("frame"),)))
    order = time.process_time() - begun
    print(f"order of assembly, {len(steps)} steps: {order:.1f} s of processor time, allowed {ORDER:g} s")
    numpy = min(command_seconds(UNIT) for _ in range(5))
    with tempfile.TemporaryDirectory() as folder:
        written = Path(folder) / "loom"
        whole = command_seconds([sys.executable, "-m", "ilmek", "design", "automated-loom", "--workshop", str(written)])
        files = sum(1 for _ in written.iterdir())
    print(
        f"folder of the default loom, {files} files: {whole:.1f} s of processor time, allowed {ALLOWED:g} s; "
        f"{whole / numpy:.0f} times `import numpy` ({numpy:.2f} s)"
    )
