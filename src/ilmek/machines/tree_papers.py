"""The papers of a machine that has none of its own: how it is put together, what wears in it, lists of parts."""

from ilmek.elements.prices import PRICES
from ilmek.machines.automated_loom.papers.maintenance import spares_of
from ilmek.machines.making_checks import making_checks
from ilmek.machines.tree_manual import UP, assembly_check, fastening_check, tree_manual, weld_check
from ilmek.part.bolting import bolted
from ilmek.part.insertion import insertions
from ilmek.part.part_lists import part_lists
from ilmek.part.projection import widest_view
from ilmek.part.tree import Tree
from ilmek.report import Papers


def tree_papers(tree: Tree, *, in_space: bool) -> Papers:
    """The papers of a tree of parts; in_space: whether its parts are written together, as STEP and as GLB."""
    steps, whole = insertions(tree, UP), bolted(tree)
    pages = tree_manual(tree, steps, widest_view(tree), whole), spares_of(whole)
    shown = tuple(page for page in pages if page is not None)
    checks = assembly_check(steps), fastening_check(whole), weld_check(whole), *making_checks(tree)
    return Papers(shown, part_lists(whole, PRICES), checks, whole, in_space)
