"""From a customer's order to quotation, approval sheet, and the folders of its carpets for the workshop."""

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib import resources
from pathlib import Path
from types import MappingProxyType

from ilmek.carpet.yarn import Yarn
from ilmek.errors import ParameterError, did_you_mean
from ilmek.io.carpet_record import code_of, signing_key
from ilmek.io.json_file import write_json
from ilmek.io.orders_file import FactoryOrders, read_orders
from ilmek.io.output import Outputs, joined
from ilmek.io.selling.approval import write_approval, write_card
from ilmek.io.selling.label import import_codes
from ilmek.io.selling.offer import Offer
from ilmek.io.selling.quotation import write_quotation
from ilmek.jobs.chart import job_json
from ilmek.jobs.order import recipe_parameters
from ilmek.jobs.ordering.offering import OrderLine, finished, offer_of, order_lines
from ilmek.jobs.ordering.progress import WovenRows, woven_rows
from ilmek.jobs.ordering.workshop import WorkshopTerms, wage_sheet, write_workshop
from ilmek.jobs.plan import PlanResult, plan_factory
from ilmek.jobs.plan_results import plan_results
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.report import Check, at_most
from ilmek.sentences import in_language

_PLAIN = str.maketrans({"ı": "i", "ß": "ss", "ø": "o", "Ø": "O", "ł": "l", "æ": "ae"})
"""Letters that have no plain form in Unicode."""

OFFER, ORDER_DATA = "offer", "order.json"
"""The folder of the papers for the customer, and the results beside them."""


UNPAID = ("the weavers' wages are in the prices as far as the cost of their looms has them; or give [wage]",)
"""Said where weavers tie and neither the order nor the looms' file has a wage."""


@record
class OrderResult:
    """Results of the job: the plan, the carpets that are offered, and the files by their folders."""

    orders: FactoryOrders
    plan: PlanResult
    lines: tuple[OrderLine, ...]
    offer: Offer
    woven: tuple[WovenRows, ...]
    codes: tuple[tuple[str, ...], ...] = ()
    files: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()

    @property
    def lots(self) -> dict[str, str]:
        """The dye lot in stock of each yarn."""
        return {yarn.name: yarn.lot for yarn in self.plan.inputs.looms_file.yarns if yarn.lot}

    @property
    def checks(self) -> tuple[Check, ...]:
        """Of every order: it is in time, washed and dry too, or why no loom weaves it; with what would save it."""
        delays = []
        for line in self.lines:
            last, due = max(finished(self.plan, self.plan.inputs.orders.index(line.planned))), line.planned.entry.due
            delay, cure = (last - due).total_seconds(), f"agree the due date {last:%Y-%m-%d %H:%M}"
            delays.append(
                at_most(f"{line.name}: delay, finished", max(0.0, delay), 0.0, "h", "the due date").with_cure(cure)
            )
        return (*self.plan.checks, *delays)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Those of the plan, labour that is not priced, and files that are left out."""
        looms = self.plan.inputs.looms_file.looms
        tied = [carpet for carpet in self.plan.plan.carpets if looms[carpet.loom].hand is not None]
        unpaid = UNPAID if tied and self.plan.inputs.wage is None else ()
        return (*self.plan.warnings, *unpaid, *self.left_out)


def work_order(
    path: Path,
    folder: Path,
    *,
    looms: Path | None = None,
    runs: Mapping[str, Path] = MappingProxyType({}),
    key: Path | None = None,
    time_limit: float | None = None,
    outputs: Outputs | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> OrderResult:
    """Work an order: plan it, and write its papers into folders below one.

    looms  the factory's file; default: that of the order, else a small workshop that comes with ilmek
    runs   folders of the runs that weave carpets, by their names in the order
    key    file of the key that signs the records, made where it is missing; default: they are not signed
    Raises an IlmekError for what cannot be read, planned, priced or written; then nothing is written.
    """
    import_codes()
    orders = read_orders(path, recipe_parameters())
    for name in runs:
        known = [order.name for order in orders.orders]
        if name not in known:
            raise ParameterError(f"no carpet of the order is named {name!r}", do=did_you_mean(name, known))
    signer = None if key is None else signing_key(key)
    with joined(outputs, force=force, progress=progress) as made:
        folders = [folder / slug for slug in slugs([order.name for order in orders.orders])]
        for one in (folder / OFFER, *folders):
            made.expect_folder(one, "--out")
        factory = looms or orders.looms or Path(str(resources.files("ilmek.data").joinpath("looms.toml")))
        limit = min(10.0, 1.0 + 0.1 * len(orders.orders)) if time_limit is None else time_limit
        plan = plan_factory(path, factory, time_limit=limit, progress=progress.part(0.0, 0.4))
        lines = order_lines(plan)
        offer = offer_of(plan, lines)
        by_name = dict(zip((order.name for order in orders.orders), folders, strict=True))
        woven = tuple(woven_rows(line.charted.chart, runs.get(line.name)) for line in lines)
        done = OrderResult(orders, plan, lines, offer, woven)
        done = _write_workshops(done, by_name, made, signer, progress.part(0.4, 0.9))
        return _write_offer(done, folder / OFFER, made)


def _write_workshops(
    done: OrderResult, folders: Mapping[str, Path], made: Outputs, signer: object, progress: Progress
) -> OrderResult:
    """The result with the files and the codes of the folders of all carpets."""
    orders = done.orders
    languages = orders.workshop_language, orders.language
    terms = WorkshopTerms(orders.customer, orders.currency, done.plan.inputs.wage, *languages, done.lots, signer)
    files, codes, left_out = list[str](), list[tuple[str, ...]](), list[str]()
    for number, (line, rows) in enumerate(zip(done.lines, done.woven, strict=True)):
        own, count = folders[line.name], len(done.lines)
        on = progress.part(number / count, (number + 1) / count, line.name)
        with made.folder(own) as work:
            names, records = write_workshop(line, terms, rows, work, before=own, left_out=left_out, progress=on)
        files += [str(own / name) for name in names]
        codes.append(tuple(str(code_of(one)) for one in records))
    return replace(done, codes=tuple(codes), files=tuple(files), left_out=tuple(left_out))


def _write_offer(done: OrderResult, folder: Path, made: Outputs) -> OrderResult:
    """The result with the papers for the customer before the other files."""
    names = ["quotation.pdf", "approval.pdf", "colour-card.pdf"] if done.lines else []
    done = replace(done, files=(*(str(folder / name) for name in (*names, ORDER_DATA)), *done.files))
    with made.folder(folder) as work, in_language(done.orders.language):
        if names:
            write_quotation(work / names[0], done.offer)
            write_approval(work / names[1], done.offer)
            write_card(work / names[2], _shelf(done.lines), done.lots, done.offer.reference)
        write_json(work / ORDER_DATA, order_json(done))
    return done


def _shelf(lines: Sequence[OrderLine]) -> tuple[Yarn, ...]:
    """The yarns that the order's lists offer, each once."""
    return tuple({yarn.name: yarn for line in lines for yarn in line.charted.order.yarns}.values())


def slugs(names: list[str]) -> list[str]:
    """A name of a folder for each name, each once.

    >>> slugs(["Kazak, 80x120cm, kırmızı", "Şah", "Sah"])
    ['kazak-80x120cm-kirmizi', 'sah', 'sah-2']
    """
    found = list[str]()
    for name in names:
        plain = unicodedata.normalize("NFKD", name.translate(_PLAIN)).encode("ascii", "ignore").decode()
        slug = re.sub(r"[^a-z0-9]+", "-", plain.lower()).strip("-") or "carpet"
        slug = f"{slug}-carpet" if slug == OFFER else slug
        same = sum(one == slug or re.fullmatch(rf"{re.escape(slug)}-\d+", one) is not None for one in found)
        found.append(f"{slug}-{same + 1}" if same else slug)
    return found


def order_results(done: OrderResult) -> JsonObject:
    """The results by their JSON names, SI; money in the currency, days ISO."""
    offer = done.offer
    planned = {order["name"]: order for order in plan_results(done.plan)["orders"]}
    return {
        "customer": offer.reference,
        "date": offer.date,
        "valid_until": offer.until,
        "currency": offer.currency,
        "margin": offer.rules.margin,
        "tax_rate": offer.rules.tax,
        "net": float(offer.net),
        "tax": float(offer.tax),
        "total": float(offer.net + offer.tax),
        "carpets": [_carpet(done, number, planned[line.name]) for number, line in enumerate(done.lines)],
        "not_offered": [order.entry.name for order in done.plan.inputs.orders if not order.possible],
    }


def _carpet(done: OrderResult, number: int, planned: JsonObject) -> JsonObject:
    line, woven = done.lines[number], done.woven[number]
    chart, bill, price, rules = line.charted.chart, line.charted.bill, line.offered.price, done.plan.inputs.wage
    index = done.plan.inputs.orders.index(line.planned)
    sheet = None if rules is None or line.wage is None else wage_sheet(line.charted, rules, done.orders.currency, woven)
    sample = line.offered.shown.sample
    return {
        "name": line.name,
        "design": line.planned.entry.design,
        "colourway": line.planned.entry.colourway and line.planned.entry.colourway.name,
        "quantity": price.quantity,
        "width": chart.size.width,
        "length": chart.size.length,
        "rows": chart.rows,
        "columns": chart.columns,
        "knots": bill.knots,
        "yarns": [chart.yarns[yarn].name for yarn in chart.used],
        **line.offered.made.as_json(),
        "mass": bill.mass_per_area * bill.area,
        "costs": {name.key.removeprefix("order.cost-"): float(cost) for name, cost in line.offered.costs},
        "cost": float(price.cost),
        "unit_price": float(price.unit),
        "discount": price.discount,
        "net": float(price.net),
        "loom": planned["loom"],
        "due": planned["due"],
        "late": planned["late"],
        "finished": [f"{time:%Y-%m-%dT%H:%M}" for time in finished(done.plan, index)],
        "delivery": line.offered.delivery,
        "strike_off": sample._asdict(),
        "wage": None if line.wage is None else float(line.wage),
        "wage_due": None if sheet is None else float(sheet.due),
        "rows_woven": woven.rows,
        "labels": list(done.codes[number]),
    }


def order_json(done: OrderResult) -> JsonObject:
    """The JSON of the job."""
    parameters = {"order": str(done.orders.path), "looms": str(done.plan.inputs.looms_file.path)}
    return job_json(
        "order",
        parameters,
        order_results(done),
        checks=done.checks,
        warnings=list(done.warnings),
        files=list(done.files),
    )
