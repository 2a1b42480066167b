# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""The instructions of a tape, each a loop over rows of samples with the groups' own leaf formulas inside.

All rows lie in one array, those of a body one after the other, `BLOCK` samples each: the compiler sees that no row
overlaps another, and works on several samples at once (measured for an RRR dyad: 2 ns a state, 17 ns one by one).
`min(count, BLOCK)` shows it that no index is negative, where Python counts from the end.

Rows are in SI units and radians; lengths a, b and offset o in m. Formulas and sources: `groups.rrr` [Norton, Design of
Machinery, sections 4.5, 6.7, 7.3] and its neighbours `rrp`, `rpr`, `prp`, `rpp`, `shift`, `turn`.
"""

from ilmek.arrays import ComplexField, FloatArray
from ilmek.linkage import body_motion
from ilmek.linkage.groups import rpp as rpp_group
from ilmek.linkage.groups import rpr as rpr_group
from ilmek.linkage.groups import rrp as rrp_group
from ilmek.linkage.groups import rrr as rrr_group
from ilmek.linkage.groups import shift
from ilmek.num import sincos as trigonometry
from ilmek.num.compiled import compiled
from ilmek.plane import vectors

BLOCK = 128
"""Samples in a row: all rows of a mechanism fit the first or second cache."""

cross, oblique = compiled(vectors.cross), compiled(vectors.oblique)
carried_velocity = compiled(body_motion.carried_velocity)
carried_acceleration = compiled(body_motion.carried_acceleration)
slid_velocity = compiled(shift.slid_velocity)
slid_acceleration = compiled(shift.slid_acceleration)
sincos = compiled(trigonometry.sincos)
first_link = compiled(rrr_group.first_link)
rrr_acceleration = compiled(rrr_group.relative_acceleration)
first_rate, second_rate = compiled(rrr_group.first_rate), compiled(rrr_group.second_rate)
rrp_reach = compiled(rrp_group.reach)
rrp_acceleration = compiled(rrp_group.relative_acceleration)
link_rate, slider_rate = compiled(rrp_group.link_rate), compiled(rrp_group.slider_rate)
sliding_distance, heading = compiled(rpr_group.sliding_distance), compiled(rpr_group.heading)
turn_rate, sliding_speed = compiled(rpr_group.turn_rate), compiled(rpr_group.sliding_speed)
rpr_acceleration = compiled(rpr_group.relative_acceleration)
gain = compiled(rpp_group.gain)


@compiled
def pair(rows: FloatArray, at: int) -> complex:
    """Read a complex sample: the real part at index `at`, the imaginary part one row further on."""
    return complex(rows[at], rows[at + BLOCK])


@compiled
def put(rows: FloatArray, at: int, value: ComplexField) -> None:
    """Write a complex sample; see `pair`."""
    rows[at] = value.real
    rows[at + BLOCK] = value.imag


@compiled
def carry(point: FloatArray, body: FloatArray, count: int, local: complex) -> None:
    """Write the motion of a body's point to six rows."""
    for i in range(min(count, BLOCK)):
        arm, omega, alpha = pair(body, 6 * BLOCK + i) * local, body[8 * BLOCK + i], body[9 * BLOCK + i]
        put(point, i, pair(body, i) + arm)
        put(point, 2 * BLOCK + i, carried_velocity(pair(body, 2 * BLOCK + i), arm, omega))
        put(point, 4 * BLOCK + i, carried_acceleration(pair(body, 4 * BLOCK + i), arm, omega, alpha))


@compiled
def turn(body: FloatArray, carrier: FloatArray, drive: FloatArray, count: int, sign: float) -> None:
    """Direction and rates of a driven body; its anchor is already written."""
    for i in range(min(count, BLOCK)):
        sine, cosine = sincos(sign * drive[i])
        put(body, 6 * BLOCK + i, pair(carrier, 6 * BLOCK + i) * complex(cosine, sine))
        body[8 * BLOCK + i] = carrier[8 * BLOCK + i] + sign * drive[BLOCK + i]
        body[9 * BLOCK + i] = carrier[9 * BLOCK + i] + sign * drive[2 * BLOCK + i]


@compiled
def rrr(dyad: FloatArray, count: int, a: float, b: float, branch: float, per_a: complex, per_b: complex) -> None:
    """Directions, rates and margin of two links, whose known pins are already written."""
    for i in range(min(count, BLOCK)):
        d = pair(dyad, 10 * BLOCK + i) - pair(dyad, i)
        u, sine = first_link(d, a, b, branch)
        v, per_sine = u - d, 1 / sine
        r: ComplexField = pair(dyad, 12 * BLOCK + i) - pair(dyad, 2 * BLOCK + i)
        wa, wb = first_rate(v, r, per_sine), second_rate(u, r, per_sine)
        r = rrr_acceleration(pair(dyad, 4 * BLOCK + i), pair(dyad, 14 * BLOCK + i), u, v, wa, wb)
        put(dyad, 6 * BLOCK + i, u * per_a)
        put(dyad, 16 * BLOCK + i, v * per_b)
        dyad[8 * BLOCK + i] = wa
        dyad[18 * BLOCK + i] = wb
        dyad[9 * BLOCK + i] = first_rate(v, r, per_sine)
        dyad[19 * BLOCK + i] = second_rate(u, r, per_sine)
        dyad[20 * BLOCK + i] = sine


@compiled
def rrp(
    dyad: FloatArray, guide: FloatArray, count: int, a: float, branch: float, per_arm: complex, lead: complex
) -> None:
    """Direction and rates of the link, margin, travel and rates of the slider; pin and zero are already written."""
    for i in range(min(count, BLOCK)):
        e, w, alpha = pair(guide, 6 * BLOCK + i) * lead, guide[8 * BLOCK + i], guide[9 * BLOCK + i]
        s, u, cosine = rrp_reach(pair(dyad, i) - pair(dyad, 21 * BLOCK + i), e, a, branch)
        r = pair(dyad, 23 * BLOCK + i) + slid_velocity(e, w, s, 0.0) - pair(dyad, 2 * BLOCK + i)
        wa, ds = link_rate(e, r, cosine), slider_rate(u, r, cosine)
        C2 = pair(dyad, 25 * BLOCK + i) + slid_acceleration(e, w, alpha, s, ds, 0.0)
        r = rrp_acceleration(pair(dyad, 4 * BLOCK + i), C2, u, wa)
        put(dyad, 6 * BLOCK + i, u * per_arm)
        dyad[8 * BLOCK + i] = wa
        dyad[9 * BLOCK + i] = link_rate(e, r, cosine)
        dyad[20 * BLOCK + i] = cosine
        dyad[27 * BLOCK + i] = s
        dyad[28 * BLOCK + i] = ds
        dyad[29 * BLOCK + i] = slider_rate(u, r, cosine)


@compiled
def slip(body: FloatArray, guide: FloatArray, travel: FloatArray, count: int, lead: complex, twist: complex) -> None:
    """A slider: its anchor moved from the root along the line; its direction and rates."""
    for i in range(min(count, BLOCK)):
        direction, w, alpha = pair(guide, 6 * BLOCK + i), guide[8 * BLOCK + i], guide[9 * BLOCK + i]
        s, ds, dds, e = travel[i], travel[BLOCK + i], travel[2 * BLOCK + i], direction * lead
        put(body, i, pair(body, i) + s * e)
        put(body, 2 * BLOCK + i, pair(body, 2 * BLOCK + i) + slid_velocity(e, w, s, ds))
        put(body, 4 * BLOCK + i, pair(body, 4 * BLOCK + i) + slid_acceleration(e, w, alpha, s, ds, dds))
        put(body, 6 * BLOCK + i, direction * twist)
        body[8 * BLOCK + i] = w
        body[9 * BLOCK + i] = alpha


@compiled
def rpr(dyad: FloatArray, count: int, o: float, branch: float, per_lead: complex, twist: complex) -> None:
    """Directions, rates and margin of two bodies that slide on one another; the known pins are already written."""
    for i in range(min(count, BLOCK)):
        d = pair(dyad, 10 * BLOCK + i) - pair(dyad, i)
        t = sliding_distance(d, o, branch)
        e = heading(d, o, t)
        r: ComplexField = pair(dyad, 12 * BLOCK + i) - pair(dyad, 2 * BLOCK + i)
        w = turn_rate(e, r, t)
        r = rpr_acceleration(pair(dyad, 14 * BLOCK + i) - pair(dyad, 4 * BLOCK + i), d, e, w, sliding_speed(e, r, w, o))
        alpha = turn_rate(e, r, t)
        direction = e * per_lead
        put(dyad, 6 * BLOCK + i, direction)
        put(dyad, 16 * BLOCK + i, direction * twist)
        for body in (0, 10):
            dyad[(body + 8) * BLOCK + i] = w
            dyad[(body + 9) * BLOCK + i] = alpha
        dyad[20 * BLOCK + i] = t


@compiled
def prp(dyad: FloatArray, one: FloatArray, two: FloatArray, count: int, lead: complex, other_lead: complex) -> None:
    """Travels and rates of two sliders pinned to one another, and the margin; the lines' zeros are already written."""
    for i in range(min(count, BLOCK)):
        e, w, alpha = pair(one, 6 * BLOCK + i) * lead, one[8 * BLOCK + i], one[9 * BLOCK + i]
        f, v, beta = pair(two, 6 * BLOCK + i) * other_lead, two[8 * BLOCK + i], two[9 * BLOCK + i]
        r: ComplexField = pair(dyad, 30 * BLOCK + i) - pair(dyad, 21 * BLOCK + i)
        s, z = oblique(r, e, f), -oblique(r, f, e)
        r = (
            pair(dyad, 32 * BLOCK + i)
            + slid_velocity(f, v, z, 0.0)
            - pair(dyad, 23 * BLOCK + i)
            - slid_velocity(e, w, s, 0.0)
        )
        ds, dz = oblique(r, e, f), -oblique(r, f, e)
        r = pair(dyad, 34 * BLOCK + i) + slid_acceleration(f, v, beta, z, dz, 0.0)
        r = r - pair(dyad, 25 * BLOCK + i) - slid_acceleration(e, w, alpha, s, ds, 0.0)
        dyad[20 * BLOCK + i] = cross(e, f)
        dyad[27 * BLOCK + i] = s
        dyad[28 * BLOCK + i] = ds
        dyad[29 * BLOCK + i] = oblique(r, e, f)
        dyad[36 * BLOCK + i] = z
        dyad[37 * BLOCK + i] = dz
        dyad[38 * BLOCK + i] = -oblique(r, f, e)


@compiled
def rpp(dyad: FloatArray, guide: FloatArray, count: int, lead: complex, second_lead: complex, twist: complex) -> None:
    """Direction and rates of the link, travel and rates of the slider; known pin and its zero are already written."""
    for i in range(min(count, BLOCK)):
        direction, w, alpha = pair(guide, 6 * BLOCK + i), guide[8 * BLOCK + i], guide[9 * BLOCK + i]
        e, f = direction * lead, direction * second_lead
        d = pair(dyad, i) - pair(dyad, 21 * BLOCK + i)
        ds = pair(dyad, 2 * BLOCK + i) - carried_velocity(pair(dyad, 23 * BLOCK + i), d, w)
        dds = gain(pair(dyad, 4 * BLOCK + i) - carried_acceleration(pair(dyad, 25 * BLOCK + i), d, w, alpha), ds, w)
        put(dyad, 6 * BLOCK + i, direction * twist)
        dyad[8 * BLOCK + i] = w
        dyad[9 * BLOCK + i] = alpha
        dyad[27 * BLOCK + i] = oblique(d, e, f)
        dyad[28 * BLOCK + i] = oblique(ds, e, f)
        dyad[29 * BLOCK + i] = oblique(dds, e, f)
