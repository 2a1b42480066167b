"""The same input gives the same bytes: in another process, with other numbers of threads, with another hash seed."""

import json
from pathlib import Path

import numpy as np
from PIL import Image
from processes import printed, python

MADE = """
import hashlib, json, sys
from contextlib import nullcontext
from pathlib import Path
from default_machines import SETTLED_OPTIONS, out_of_space
from ilmek.cli import main
from effort import number, some
from ilmek.machines.catalogue import MACHINES

def digest(data):
    return hashlib.sha256(data).hexdigest()

def reported(machine):  # without figures and parts in space: those of the files have them
    return machine.report(machine.design(machine.params.read({})), illustrated=False, assembled=False).as_json()

machines = [*MACHINES][number(1, 0) :]  # the loom is that of the carpet below; its own choice of a beat in a campaign
made = {name: digest(json.dumps(reported(MACHINES[name])).encode()) for name in some(machines, 5)}
for call in (
    "design cam --workshop cam",
    "chart ../noise.png --size 50x50cm --quality 25x25/dm --out chart",
    "weave ../noise.png --size 24x24cm --quality 10x10/dm --least-detail 0% --loom beat=comb --out carpet",
):
    try:
        with number(out_of_space, nullcontext)():  # parts in space, which no thread compares: in a campaign
            main([*call.split(), *(SETTLED_OPTIONS if call.startswith("weave") else ())])
    except SystemExit as end:
        assert not end.code, end.code
for file in sorted(path for folder in ("cam", "chart", "carpet") for path in Path(folder).iterdir()):
    made[str(file)] = digest(file.read_bytes())
Path("digests.json").write_text(json.dumps(made))
"""


def test_the_same_bytes_with_one_thread_and_with_two(tmp_path: Path) -> None:
    """In processes of one thread and of as many as processors; the seeds of hashes differ too."""
    noise = np.random.default_rng(1).integers(0, 256, (140, 140, 3), dtype=np.uint8)  # a sum over 15 625 colours
    Image.fromarray(noise).save(tmp_path / "noise.png")
    names = ("NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "PYTHONHASHSEED")
    for folder in (tmp_path / "1", tmp_path / "2"):
        folder.mkdir()
    printed(python("-c", MADE), cwd=tmp_path / "1", changes=dict.fromkeys(names, "1"))
    printed(python("-c", MADE), cwd=tmp_path / "2", changes=dict.fromkeys(names))
    one, two = (json.loads((tmp_path / threads / "digests.json").read_text()) for threads in ("1", "2"))
    assert len(one) > 20
    assert [name for name in one if one[name] != two[name]] == []
