"""The beam across behind the cams, and the posts on it that hold the steadies of long cam shafts.

A steady is pressed to the back by F, the load of a span. Its post is a cantilever of the height h on the beam, which
bends to the back between the columns by all posts' forces, as if spread over it:

    sigma = F h c / I,   sway = F h³ / (3 E I);   bow of the beam 5 w l⁴ / (384 E I), w = sum(F) / l
"""

from collections.abc import Iterator

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL, HollowSquare, ascending
from ilmek.machines.automated_loom.brackets import Brackets
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import ROOM, LoomFrame, member, part_id
from ilmek.machines.automated_loom.supports import within
from ilmek.machines.shedding import stack
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.steady import Steady, steady_of, steady_stations
from ilmek.part.placement import UPRIGHT, placement
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.report import Check, at_most

SAFETY = 2.0
"""Of a post against yielding; assumed by this project."""

SWAY = 1 / 1000
"""Allowed deflection of a post over its height, and of the beam over its length; assumed by this project."""

_CURE = "set a lower tension, or a narrower carpet"


@record
class SteadyPost:
    """A post: section, height over the beam and of the force on it [m], the force [N]; along: of the beam [m], number
    of posts.
    """

    section: HollowSquare
    height: float
    arm: float
    force: float
    along: float
    number: int


def cam_beam(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> complex:
    """Axis of the beam behind the cams in the side view: between spacer and lowest cam bracket, behind all cams [m].

    It is in the columns or behind them, but under the posts of steadies it is as near to these as it has room.
    """
    side, half, (highest, lowest) = loom.side, cam_beam_section(frame, made).side / 2, _between(made)
    height = (highest + lowest) / 2
    behind = min(cam.at.real - cam.guide_radius for cam in side.cams) - ROOM - half
    rears = [rear - half - ROOM for rear, *_ in _held(loom)]
    return complex(min(behind, *(rears or [side.column])), height)


def cam_beam_section(frame: LoomFrame, made: Brackets) -> HollowSquare:
    """Section of the beam: the columns', or the largest that has room between the brackets."""
    highest, lowest = _between(made)
    return within(frame.column, lowest - highest - 2 * ROOM)


def _between(made: Brackets) -> tuple[float, float]:
    """Heights of the upper end of the spacer's bracket and of the lower end of the lowest cam bracket [m]."""
    spacer, _, *of_cams = made.shafts
    lowest = min(float(cam.nodes.imag.min()) - cam.radius for cam in of_cams)
    return float(spacer.nodes.imag.max()) + spacer.radius, lowest


def _held(loom: LoomDesign) -> Iterator[tuple[float, float, Steady, CamShaft]]:
    """Back of the block of each steady in the side view [m], its axis' height, the steady and its shaft."""
    for cam, shaft in zip(loom.side.cams, loom.shedding.shafts, strict=True):
        own = steady_of(shaft)
        if own is not None:
            yield cam.at.real - own.rear, cam.at.imag, own, shaft


def steady_post(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> SteadyPost | None:
    """The posts, of the lightest section that keeps its checks, else the widest as the beam; None without a steady."""
    held = tuple(_held(loom))
    if not held:
        return None
    bottom = cam_beam(loom, frame, made).imag + cam_beam_section(frame, made).side / 2
    height = max(y + own.half_height for _, y, own, _ in held) - bottom
    arm, force = max(y for _, y, _, _ in held) - bottom, sum(shaft.shaft.seat.reaction for *_, shaft in held)
    number = held[0][3].params.spans - 1
    offered = [square for square in ascending() if square.side <= frame.column.side]
    posts = (SteadyPost(one, height, arm, force, 2 * made.face, number) for one in offered)
    chosen = (post for post in posts if all(check.ok for check in _post_checks(post)))
    return next(chosen, SteadyPost(offered[-1], height, arm, force, 2 * made.face, number))


def _post_checks(own: SteadyPost) -> tuple[Check, Check]:
    parts = (part_id("steady-post"),)
    stress = own.force * own.arm * own.section.side / 2 / own.section.inertia
    sway = own.force * own.arm**3 / (3 * STEEL.modulus * own.section.inertia)
    limit, most = STEEL.strength / SAFETY, SWAY * own.arm
    source, height = "yield of S235 over 2, assumed by this project", "height over 1000, assumed by this project"
    return (
        at_most("stress of a steady's post", stress, limit, "MPa", source).with_cure(_CURE, *parts),
        at_most("deflection of a steady's post", sway, most, "mm", height).with_cure(_CURE, *parts),
    )


def steady_checks(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> tuple[Check, ...]:
    """Strength and stiffness of the posts, and of the beam on which they stand."""
    own = steady_post(loom, frame, made)
    if own is None:
        return ()
    load = own.force * own.number / own.along
    bow = float(uniform.deflection_max(load, own.along, STEEL.modulus, cam_beam_section(frame, made).inertia))
    source, parts = "length over 1000, assumed by this project", (part_id("beam"),)
    bent = at_most("bow of the beam behind the cams", bow, SWAY * own.along, "mm", source).with_cure(_CURE, *parts)
    rollers = (one.check(stack.part_id("steady", index)) for index, (*_, one, _) in enumerate(_held(loom)))
    return (*_post_checks(own), bent, *rollers)


def steady_posts(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    """The posts behind the steadies' blocks; they belong to the frame's body."""
    own, held = steady_post(loom, frame, made), tuple(_held(loom))
    if own is None:
        return
    depth = min(rear for rear, *_ in held) - own.section.side / 2
    shaft, beam = held[0][3], cam_beam(loom, frame, made)
    aside = held[0][2].roller.width / 2 + own.section.side / 2
    post = member("steady-post", "post of the steadies", own.section, own.height)
    stations = steady_stations(shaft.params.spans, shaft.shaft.length)
    places = (
        placement(-z - aside, beam.imag + cam_beam_section(frame, made).side / 2, depth).after(UPRIGHT)
        for z in stations
    )
    yield Occurrence(post, tuple(places))
