"""The summary of a carpet that `weave` and `chart` print: how its picture was read, and its yarn."""

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.carving import carved_length
from ilmek.carpet.chart import Chart
from ilmek.carpet.tally import SMALL_PATCH
from ilmek.cli.terminal import show_table
from ilmek.jobs.chart import ChartResult
from ilmek.units import counted, format_number, format_quantity, g


def carpet_pairs(charted: ChartResult) -> list[tuple[str, str]]:
    """Carpet, knots, reading of the picture, what was changed, colours and yarn, one line each."""
    chart, made, bill = charted.chart, charted.chart.reading, charted.bill
    return [
        ("carpet", f"{chart.size}, {chart.quality}, {chart.knot} knot"),
        ("knots", knots_in_words(chart)),
        *([] if chart.cells is None else [("cells", cells_in_words(charted))]),
        *carving_pair(charted),
        ("read as", f"{made.kind}: {made.reason}"),
        ("fit", made.fit.words),
        ("changes", changes_in_words(chart)),
        *([("overlay", overlay_in_words(chart))] if len(chart.overlay) else []),
        ("colours", f"{yarns_in_words(charted)}, {colours_in_words(chart)}"),
        ("yarn", f"{format_quantity(bill.mass, 'kg', 3)}, pile {format_quantity(bill.pile_mass, 'kg', 3)}"),
        ("carpet mass", mass_in_words(bill)),
        ("to buy", to_buy_in_words(charted)),
    ]


def knots_in_words(chart: Chart) -> str:
    """The knots of a chart, and its grid."""
    across = counted(chart.columns, "cell") if chart.tally().knots < chart.knots.size else str(chart.columns)
    return f"{chart.tally().knots:,} ({chart.rows} rows of {across})"


def cells_in_words(charted: ChartResult) -> str:
    """The cells of each kind, and the edge of a shape."""
    cells, bill = charted.chart.cells, charted.bill
    assert cells is not None
    kinds = ", ".join(f"{kind} {count:,}" for kind, count in zip(cells.kinds, cells.counts, strict=True))
    bound = f"; {format_quantity(bill.area, 'm^2')}, edge of {format_quantity(bill.edge, 'm')} to bind"
    return kinds + (bound if bill.edge else "")


def carving_pair(charted: ChartResult) -> list[tuple[str, str]]:
    """Length and groove of the carved lines, and the yarn that is cut away; none for a carpet without them."""
    cells = charted.chart.cells
    carving = None if cells is None else cells.carving
    if carving is None:
        return []
    length, mass = carved_length(charted.chart), sum(need.carved for need in charted.bill.pile)
    groove = f"{format_quantity(carving.depth, 'mm')} deep at {format_quantity(carving.angle, 'deg')}"
    return [
        ("carving", f"{format_quantity(length, 'm', 3)} of lines, {groove}; {format_quantity(mass, 'g', 3)} cut away")
    ]


def overlay_in_words(chart: Chart) -> str:
    """The half knots and jufti knots of a chart, and all its knots: a half cell has two, two jufti cells one."""
    tied = chart.tied
    half, jufti = counted(sum(tied.half), "half knot"), counted(sum(tied.jufti), "jufti knot")
    return f"{half}, {jufti}; {counted(tied.total, 'knot')} to tie"


def changes_in_words(chart: Chart) -> str:
    """Knots that the reading and a recipe changed, knots of a foreign colour, small patches."""
    reading = chart.reading
    parts = [f"{counted(reading.changed, 'knot')} changed" if reading.changed else "no knot changed"]
    if reading.edited:
        parts.append(f"{reading.edited:,} edited")
    if reading.foreign is not None:
        parts.append(
            f"{reading.foreign:,} of a colour foreign to its cell" if reading.foreign else "none foreign to its cell"
        )
    parts.append(f"{counted(chart.small_patches, 'patch', 'patches')} of at most {SMALL_PATCH} knots")
    return ", ".join(parts)


def yarns_in_words(charted: ChartResult) -> str:
    """The number of yarns that are used, of a list or dyed to order."""
    chart, dyed = charted.chart, charted.chart.dyed
    if dyed:
        return f"{counted(chart.colours, 'yarn')}, {dyed} dyed to order"
    return f"{chart.colours} of {len(charted.order.yarns)} yarns"


def colours_in_words(chart: Chart) -> str:
    """The yarns' difference to the picture; of a drawing the colour that is farthest from its yarn."""
    made = chart.reading
    mean = f"mean ΔE {made.mean_delta_e:.2f} (least {made.least_delta_e:.2f})"
    if made.edges_kept is not None:
        mean += f", {format_quantity(made.edges_kept, '%', 3)} of the edges kept"
    if not made.matches:
        return mean
    worst = max(made.matches, key=lambda match: match.delta_e)
    if worst.delta_e < 0.05:
        return f"{mean}, each exactly a colour of the picture"
    return f"{mean}, worst {worst.hex} {worst.delta_e:.1f} from {chart.yarns[worst.yarn].name}"


def pile_in_words(charted: ChartResult) -> str:
    """The pile's height and counts, given or by the quality, and the share of the ground filled."""
    plan, fill = charted.order.order.plan, charted.checks[0]
    height = format_quantity(charted.pile.pile_height, "mm", 3)
    counts = ", ".join(dict.fromkeys(need.count for need in charted.bill.pile))
    filled = f"{format_quantity(fill.value, fill.unit, 3)} of the ground filled"
    by_quality = " (by the quality)"
    return (
        f"{height} high{'' if plan.pile_height is not None else by_quality}, "
        f"Nm {counts}{by_quality if charted.usual_counts else ''}, {filled}"
    )


def mass_in_words(bill: YarnBill) -> str:
    """The mass of the finished carpet over its area, beside the published one."""
    mass = format_quantity(bill.mass_per_area, "kg/m^2", 3)
    if bill.band is None:
        return f"{mass} (none is published for this density)"
    return f"{mass} (published: {format_number(bill.band.least, 3)} to {format_number(bill.band.most, 3)})"


def to_buy_in_words(charted: ChartResult) -> str:
    """Mass to buy with its reserve, its price, and the dye lots of the yarn of most knots."""
    bill, plan = charted.bill, charted.order.order.plan
    to_buy = format_quantity(sum(need.to_buy for need in bill.needs), "kg", 3)
    price = "" if bill.price is None else f", {bill.price:,.2f} {bill.currency}"
    lots = f"{bill.field.lots} dye lots" if bill.field.lots > 1 else "one dye lot"
    reserve = format_quantity(plan.reserve, "%", 3)
    return f"{to_buy} with a reserve of {reserve}{price}; {bill.field.name}: {lots}"


def show_yarn(bill: YarnBill) -> None:
    """Print the yarn bill as a table, with the dye lots where a yarn has more than one."""
    several = any(need.lots > 1 for need in bill.needs)
    rows = [
        (need.name, need.use, f"{need.knots:,}" if need.knots else "", _amount(need.length), _amount(need.mass / g),
         _amount(need.to_buy / g), str(need.hanks), *([str(need.lots)] if several else []),
         "" if need.price is None else f"{need.price:,.2f}")
        for need in bill.needs
    ]  # fmt: skip
    lots = ("lots",) if several else ()
    names = ("yarn", "use", "knots", "metres", "grams", "to buy", "hanks", *lots, bill.currency)
    show_table(names, rows, right=tuple(range(2, len(names))))


def _amount(value: float) -> str:
    """A whole number, or one decimal below 10."""
    return f"{value:,.{0 if value >= 10 else 1}f}"
