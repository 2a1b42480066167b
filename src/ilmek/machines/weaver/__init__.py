"""The knotting head of the thesis, "the weaver": six cams on one shaft that tie a symmetric knot in one turn.

Source: thesis, section 2.2.3 and Figures 2.11 to 2.16. The order of the motions is the thesis'; angles, strokes and
limits are parameters, since the thesis prints none.
"""

from dataclasses import replace

from ilmek.machines.component import Component
from ilmek.machines.weaver.choices import choices
from ilmek.machines.weaver.design import Weaver, design, head_relations
from ilmek.machines.weaver.in_loom import params_for, work
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.report import WeaverAnalysis, analyse, cam_tables, checks, figures, tables, warnings
from ilmek.machines.weaver.tree import head_mass, head_tree, mass_of
from ilmek.timing.cyclogram import Cyclogram

__all__ = ["MACHINE", "Weaver", "WeaverParams", "cyclograms", "design", "head_mass", "mass_of"]


def cyclograms(weaver: Weaver) -> tuple[Cyclogram, ...]:
    """The head's cyclogram with the order of its motions."""
    order = (*weaver.cyclogram.relations, *head_relations(weaver))
    return (replace(weaver.cyclogram, relations=tuple(dict.fromkeys(order))),)


MACHINE = Component(
    name="weaver",
    title="Knotting head",
    params=WeaverParams,
    design=design,
    analysis=analyse,
    reported=(WeaverAnalysis,),
    checks=checks,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=head_tree,
    cam_tables=cam_tables,
    cyclograms=cyclograms,
    work=work,
    choices=choices,
    fit=params_for,
    own_figures=("knot", "weaver-moving", "acceleration"),
)
