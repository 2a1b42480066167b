"""The beat-up mechanism: a crank-rocker that drives weft and knots to the fell.

Sized by the swing of the rocker and the rotation of the crank between its dead centres, or by its lengths, after
Topalbekiroglu and Celik, "Kinematic analysis of beat-up mechanism used for handmade carpet looms"; moved by
`ilmek.linkage`, loaded by `ilmek.dynamics`.

The force on the beater is that of the rocker, m_E (a_E - g), which its bolts transmit against its inertia and weight.
It is greatest near the extended dead centre, where the beater reverses at the fell.
"""

from ilmek.machines.beat_up.design import BeatUp, design, ground_for
from ilmek.machines.beat_up.in_loom import fit, planned_beat, work
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.beat_up.report import BeatUpAnalysis, analyse, checks, figures, self_tests, tables, warnings
from ilmek.machines.beat_up.tree import tree
from ilmek.machines.beat_up.use import use_choices
from ilmek.machines.component import Component

__all__ = ["MACHINE", "BeatUp", "BeatUpParams", "design", "ground_for"]

MACHINE = Component(
    name="beat-up",
    title="Beat-up",
    params=BeatUpParams,
    design=design,
    analysis=analyse,
    reported=(BeatUpAnalysis,),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=tree,
    work=work,
    choices=use_choices,
    fit=fit,
    beat=planned_beat,
    own_figures=(
        *("family", "beat-up-moving", "beater-travel", "beater-velocity", "beater-acceleration"),
        *("transmission-angle", "shaking-force", "run-speed"),
    ),
)
