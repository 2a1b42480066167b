"""What a workshop could not make or fit: joints without a fit, soft shafts under rollers, cams closer than ground."""

from collections.abc import Iterator

from ilmek.cams.profile_tolerance import GROUND
from ilmek.part.joint_fits import joints_without_fit
from ilmek.part.meetings import meetings
from ilmek.part.tree import Tree
from ilmek.report import Check, at_least, at_most


def making_checks(tree: Tree) -> Iterator[Check]:
    """Fits of the joints; the profile of the cam that allows least, where there are cams."""
    loose = joints_without_fit(tree)
    source = "; ".join(loose) or "a bore and its pin, faces on each other, or a bought part"
    yield at_most("joints that move without a fit", len(loose), 0, "1", source)
    for meeting in meetings(tree):
        bought, shaft = meeting.bore.part.purchase, meeting.inner.part
        if bought is not None and bought.hardness and shaft.material is not None:
            hard = shaft.material.treatment.hardness if shaft.material.treatment else 0
            title = f"hardness of the shaft in {bought.row} (HRC)"
            yield at_least(title, hard, bought.hardness, "1", "maker's catalogue").with_cure(
                "a hardened shaft", shaft.id
            )
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
