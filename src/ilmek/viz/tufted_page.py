"""The page of a carpet by a tufting machine or a gun, or as a kilim: verdict, picture, colours, cost, checks, files."""

from collections.abc import Mapping, Sequence

from ilmek.carpet.kilim_cloth import KilimCloth
from ilmek.machines.tufting_machine.picture import TuftedPicture
from ilmek.records import JsonObject
from ilmek.report import Check, Result, reasons
from ilmek.units import format_quantity, mm
from ilmek.viz.carpet_picture import DrawnCarpet
from ilmek.viz.page import FIRST_CHECKS, render
from ilmek.viz.page_pictures import address
from ilmek.viz.sections import PageVerdict, failures_first, judged
from ilmek.weaving.tufts import Cone

Amount = tuple[str, str, int]
"""A column of the table of colours: its heading, the key of its numbers, their decimals."""

YARN: tuple[Amount, ...] = (("Yarn [m]", "yarn", 0), ("Yarn [kg]", "mass", 3), ("Price [EUR]", "price", 2))


def tufted_page(
    template: str,
    title: str,
    *,
    maker: str,
    results: Sequence[Result],
    checks: Sequence[Check],
    files: Sequence[str],
    cones: Sequence[Cone],
    colours: Sequence[JsonObject],
    amounts: tuple[Amount, ...],
    cost: Mapping[str, float | None],
    apart: tuple[str, ...],
    does: str = "tuft",
    programme: str = "programme",
    **more: object,
) -> str:
    """The page as self-contained HTML.

    maker, does     who makes the carpet, and does what     programme  what is missing where it cannot be made
    results, files  declared results, and names of the files of the folder      apart  results that are shown elsewhere
    cones, colours  of the carpet, in one order                                 amounts  columns of the colours' table
    """
    return render(
        template,
        title=title,
        verdict=PageVerdict(
            f"The {maker} {does}s this carpet.",
            f"The {maker} cannot {does} this carpet as it is, and there is no {programme}.",
            len(checks),
            reasons(checks),
        ),
        colours=[{**row, "colour": cone.colour} for cone, row in zip(cones, colours, strict=True)],
        amounts=(*amounts, *YARN),
        cost=cost,
        results=[result for result in results if result.name not in apart],
        checks=failures_first(judged(checks, ())),
        first_checks_shown=FIRST_CHECKS,
        files=files,
        **more,
    )


def kilim_page(
    title: str,
    cloth: KilimCloth,
    *,
    results: Sequence[Result],
    checks: Sequence[Check],
    files: Sequence[str],
    drawn: DrawnCarpet,
) -> str:
    """The page of a kilim."""
    yarns = [yarn for yarn, mass in zip(cloth.chart.yarns, cloth.masses, strict=True) if mass]
    return tufted_page(
        "kilim.html.j2",
        f"{title}: kilim",
        maker="weaver",
        does="weave",
        programme="rows.txt",
        results=results,
        checks=checks,
        files=files,
        cones=[Cone(yarn.name, yarn.hex, None) for yarn in yarns],
        colours=cloth.kilim_colours,
        amounts=(),
        cost=cloth.kilim_cost,
        apart=("kilim_colours", "kilim_cost"),
        picture=address(drawn.jpeg, "jpeg"),
        lead=cloth.in_words,
    )


def tufting_page(
    title: str,
    tufted: TuftedPicture,
    *,
    results: Sequence[Result],
    checks: Sequence[Check],
    files: Sequence[str],
    drawn: DrawnCarpet | None,
) -> str:
    """The page of a carpet by a tufting machine; drawn: what the twin tufts, None where places are bare."""
    grid, programme = tufted.programme.grid, tufted.programme
    return tufted_page(
        "tufting.html.j2",
        f"{title}: tufted",
        maker="machine",
        results=results,
        checks=checks,
        files=files,
        cones=tufted.cones,
        colours=tufted.tufting_colours,
        amounts=(("Tufts", "tufts", 0),),
        cost=tufted.tufting_cost,
        apart=("tufting_colours", "tufting_cost"),
        picture=None if drawn is None else address(drawn.jpeg, "jpeg"),
        lead=f"{programme.columns} × {programme.rows} tufts, gauge {format_quantity(grid.gauge, 'mm')}, stitches of "
        f"{format_quantity(grid.stitch, 'mm')}, pile of {grid.height / mm:g} mm",
    )
