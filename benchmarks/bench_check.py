"""The proof of a carpet of 20 million knots, from its file and from its text: time and memory.

Limits: 10 s, reading included. Each form is checked in a process of its own.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.bench_programme import HEADS, TIMES, YARNS, medallion, twenty_million
from ilmek.io.any_programme import open_any_programme, write_any_programme
from ilmek.io.programme_file import write_programme
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.programme import make_programme

CHECK = """
import resource, sys, time
from pathlib import Path
from ilmek.jobs.check import check_programme
begin = time.perf_counter()
found = check_programme(Path(sys.argv[1]))
wall, processor = time.perf_counter() - begin, time.process_time()
memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
times = f"{wall:.1f} s, with the start {processor:.1f} s of a processor, peak memory {memory / 1e9:.2f} GB"
print(f"{times}, {found.totals.knots / 1e6:.0f} million knots, ok: {found.ok}")
"""


def run() -> None:
    """Print the figures for a design with much grain: a change of colour every third knot."""
    with tempfile.TemporaryDirectory() as folder:
        file, text = Path(folder) / "programme.ilmek", Path(folder) / "programme.txt"
        write_programme(file, CompiledProgramme(twenty_million(), make_programme(medallion(0.2), YARNS, HEADS, TIMES)))
        with open_any_programme(file) as programme:
            begin = time.perf_counter()
            write_any_programme(text, text.suffix, programme)
            written = time.perf_counter() - begin
        print(f"  text of {text.stat().st_size / 1e6:.0f} MB written in {written:.1f} s")
        for one in (file, text):
            done = subprocess.run([sys.executable, "-c", CHECK, one], check=True, capture_output=True, text=True)
            print(f"  check of {one.name}: {done.stdout.strip()}   (limit 10 s)")
