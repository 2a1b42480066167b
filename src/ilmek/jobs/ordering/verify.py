"""Verify the record of a carpet, given as a file or by the code of its label."""

from pathlib import Path

from ilmek.errors import ParameterError
from ilmek.io.carpet_record import LabelCode, code_of, parse_code, read_record, record_faults
from ilmek.jobs.chart import job_json
from ilmek.records import JsonObject, record
from ilmek.report import Check, must

_MOST_FILES = 10_000
_SCHEME = "ilmek:"
_CURE = "do not trust this copy: ask who signed the record for his own"


@record
class VerifiedRecord:
    """A record with its faults, in words."""

    path: Path
    made: JsonObject
    faults: tuple[str, ...]

    @property
    def checks(self) -> tuple[Check, ...]:
        """That nothing was changed; each fault is a failed check."""
        if not self.faults:
            return (must("record as it was written", True, str(self.path)),)
        return tuple(must(f"record: {fault}", False, str(self.path)).with_cure(_CURE) for fault in self.faults)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the verification leaves open."""
        return () if self.made["signature"] else ("the record is not signed: whoever changes it can write its digests",)

    @property
    def in_words(self) -> list[tuple[str, str]]:
        """What the record is of."""
        found, code = self.made["record"], code_of(self.made)
        names = ("carpet", "order", "identity")
        key = code.fingerprint if self.made["signature"] else "not signed"
        return [*((name, str(found.get(name, ""))) for name in names), ("key", key), ("code", str(code))]


def verify_record(
    given: str, *, code: str | None = None, records: Path | None = None, key: str | None = None
) -> VerifiedRecord:
    """Verify a record.

    given  path of the record, or the code of its label, whose record is looked for below `records`
    code   of the label      key  public key, or its fingerprint, that must have signed it
    Raises ParameterError for what is no record or no code, and where no record belongs to a code.
    """
    label = None if code is None else parse_code(code)
    if given.startswith(_SCHEME):
        label = parse_code(given)
        path = _record_of(label, records or Path())
    else:
        path = Path(given)
    made, text = read_record(path)
    return VerifiedRecord(path, made, tuple(record_faults(made, text, label, key)))


def _record_of(label: LabelCode, folder: Path) -> Path:
    for number, path in enumerate(sorted(folder.rglob("*.json"))):
        if number == _MOST_FILES:
            break
        try:
            found = read_record(path)[0]
        except ParameterError:
            continue
        if found["record"]["identity"] == label.identity:
            return path
    do = "give --records, the folder of the order"
    raise ParameterError(f"no record of the carpet {label.identity} in {folder}", do=do)


def verify_json(done: VerifiedRecord) -> JsonObject:
    """The JSON of the job."""
    code = code_of(done.made)
    results = {**code._asdict(), "faults": list(done.faults), "carpet": done.made["record"].get("carpet")}
    return job_json("verify", {"record": str(done.path)}, results, checks=done.checks, warnings=list(done.warnings))
