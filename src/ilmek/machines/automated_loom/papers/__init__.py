"""The papers of a loom: lists of its parts, and what its maker, its fitter, its weaver and its inspector must know."""

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.tree import whole_list
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.assembly_manual import assembly_manual
from ilmek.machines.automated_loom.papers.braking import braking_checks
from ilmek.machines.automated_loom.papers.chains import tolerance_paper
from ilmek.machines.automated_loom.papers.commissioning import commissioning
from ilmek.machines.automated_loom.papers.electrical import electrical
from ilmek.machines.automated_loom.papers.foundation import foundation
from ilmek.machines.automated_loom.papers.maintenance import maintenance
from ilmek.machines.automated_loom.papers.risks import risks, safety_checks
from ilmek.machines.making_checks import making_checks
from ilmek.part.bolting import bolted
from ilmek.part.part_lists import part_lists
from ilmek.report import Papers, Report


def papers(loom: LoomDesign, report: Report) -> Papers:
    """The papers of a loom with its report."""
    manual, assembled = assembly_manual(loom)
    pages = (
        manual,
        commissioning(loom, report),
        electrical(loom, report),
        maintenance(loom, report),
        risks(loom, report),
        tolerance_paper(loom),
        foundation(loom_tree(loom)),
    )
    tree = bolted(loom_tree(loom))
    checks = (*safety_checks(loom, report), *assembled, *braking_checks(loom), *making_checks(loom_tree(loom)))
    return Papers(pages, part_lists(tree, whole_list(loom).prices), checks, tree)
