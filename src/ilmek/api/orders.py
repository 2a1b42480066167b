"""Orders of a customer and the records of their carpets."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from ilmek.arguments import Arguments, Quantity
from ilmek.jobs.ordering.verify import VerifiedRecord, verify_record
from ilmek.jobs.ordering.work import OrderResult, work_order
from ilmek.progress import SILENT, Progress


def order(
    path: str | Path,
    out: str | Path,
    *,
    looms: str | Path | None = None,
    runs: Mapping[str, str | Path] = MappingProxyType({}),
    key: str | Path | None = None,
    time_limit: Quantity | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> OrderResult:
    """Work a customer's order: quotation, approval sheet, and the workshop folder of each carpet, below a folder.

    looms  the factory's file; default: that of the order, else two frames of a small workshop
    runs   folders of the runs that weave carpets, by their names      key  file of the key that signs the records
    time_limit  of the plan [s], like "10s"                            force  replace folders that ilmek made

    Needs the extras orders and planning. Raises any IlmekError; then nothing is written; Cancelled.

    >>> import tempfile
    >>> done = order("examples/order.toml", Path(tempfile.mkdtemp()) / "order")
    >>> [line.name for line in done.lines], done.offer.net == sum(line.offered.price.net for line in done.lines)
    (['Medallion, madder', 'Medallion, indigo'], True)
    """
    given = Arguments("an order")
    return work_order(
        given.path("path", path),
        given.path("out", out),
        looms=None if looms is None else given.path("looms", looms),
        runs={name: given.path("runs", folder) for name, folder in runs.items()},
        key=None if key is None else given.path("key", key),
        time_limit=None if time_limit is None else given.number("time_limit", time_limit, "s"),
        force=given.flag("force", force),
        progress=given.record("progress", progress, Progress),
    )


def verify(
    record: str | Path, *, code: str | None = None, records: str | Path | None = None, key: str | None = None
) -> VerifiedRecord:
    """Verify the record of a carpet, or the one that the code of a label leads to; `faults` names what was changed.

    code  of the printed label      records  folder in which the record of a code is looked for
    key   public key, or its fingerprint, that must have signed it
    Raises ParameterError for what is no record or no code, and where no record belongs to a code.

    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp()) / "order"
    >>> done = order("examples/order.toml", folder)
    >>> verify(done.codes[0][0], records=folder).faults
    ()
    """
    given = Arguments("a record")
    folder = None if records is None else given.path("records", records)
    named = str(record) if isinstance(record, Path) else given.text("record", record)
    return verify_record(named, code=code, records=folder, key=key)
