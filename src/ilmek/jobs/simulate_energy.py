"""The energy of a simulated carpet, by the works of its loom's machines."""

from pathlib import Path

from ilmek.errors import LoomError
from ilmek.jobs.existing_loom import read_existing_loom
from ilmek.jobs.loom_setup import loom_digest
from ilmek.loom.twin.faults import CAUSES
from ilmek.loom.twin.kernel import COUNTS, FAILED
from ilmek.loom.twin.statistics import CarpetStatistics
from ilmek.loom.twin.walk import BEATS, WEFTS
from ilmek.machines.automated_loom.energy import Energy, energy_of_acts
from ilmek.machines.automated_loom.report import analyse


def energy_of_run(file: Path, found: CarpetStatistics) -> Energy:
    """The energy of the run's acts on the loom of a file. Raises LoomError for another loom than the programme's."""
    loom, setup = read_existing_loom(file).design, found.setup
    if loom_digest(loom.params) != setup.loom:
        raise LoomError(
            f"{file} is not the loom of the programme", do="give the machine.json of the same `ilmek weave`"
        )
    faults = found.run.sums[COUNTS : COUNTS + len(CAUSES)]
    acts = {
        "knot": found.knots + int(found.run.sums[FAILED]),
        "colour change": int(found.run.changes.sum()),
        "row": setup.rows,
        "pass": 2 * setup.rows + int(faults[slice(*WEFTS)].sum()),
        "beat": 2 * setup.rows + int(faults[slice(*BEATS)].sum()),
        "carpet": 1,
    }
    return energy_of_acts(loom, analyse(loom).listed.axes, acts, found.time, setup.size.width * setup.size.length)
