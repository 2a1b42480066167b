"""What a workshop could not make or fit of a tree of parts: joints without a fit, cams closer than they are ground."""

from collections.abc import Iterator

from ilmek.cams.profile_tolerance import GROUND
from ilmek.part.joint_fits import joints_without_fit
from ilmek.part.tree import Tree
from ilmek.report import Check, at_least, at_most


def making_checks(tree: Tree) -> Iterator[Check]:
    """Fits of the joints; the profile of the cam that allows least, where there are cams."""
    loose = joints_without_fit(tree)
    source = "; ".join(loose) or "a bore and its pin, faces on each other, or a bought part"
    yield at_most("joints that move without a fit", len(loose), 0, "1", source)
    cams = [(part.cam.increment, part.id) for part, _ in tree.occurrences() if part.cam is not None]
    if cams:
        increment, name = min(cams)
        yield at_least(
            "change of a cam's error from one degree to the next, allowed by its follower",
            increment,
            GROUND,
            "um",
            "what grinders of cams hold; assumed by this project",
        ).with_cure("set a larger weaver.contact_force, or a longer knot_cycle", name)
