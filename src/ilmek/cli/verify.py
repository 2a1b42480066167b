"""`ilmek verify`: whether the record of a carpet is as it was written and signed."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import file_option, json_option, text_option
from ilmek.cli.terminal import note, show_pairs
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict

EXAMPLES = """\b
Examples:
  ilmek verify order/kazak-madder/record-1.json
  ilmek verify order/kazak-madder/record-1.json --code ilmek:1:0b3e...:77aa...:51c0...
  ilmek verify ilmek:1:0b3e...:77aa...:51c0... --records order
"""


@click.command(epilog=EXAMPLES)
@click.argument("record", metavar="RECORD.json|CODE")
@text_option("--code", "CODE", "Compare with the code of the printed label.")
@file_option("--records", "DIR", "Where the record of a label's code is looked for; default: this folder.")
@text_option("--key", "KEY", "Public key, or its fingerprint, that must have signed it.")
@json_option
def command(record: str, *, code: str | None, records: Path | None, key: str | None, json_to: str | None) -> int:
    """Verify the RECORD of a carpet, or the record that the CODE of a label leads to; no network is needed.

    Each entry is compared with its digest, all digests with the signature, the file with the one form in which it is
    written, and all with the label where its code is given: a changed byte is found, and what was changed is named.

    Ends with 3 where something was changed.
    """
    from ilmek.jobs.ordering.verify import verify_json, verify_record

    with call_outputs({"--json": json_to}) as call:
        done = verify_record(record, code=code, records=records, key=key)
        call.give_json(lambda: verify_json(done))
    if call.quiet:
        note_verdict(done.checks)
    else:
        show_verdict(done.checks)
        show_pairs(done.in_words)
    for warning in done.warnings:
        note(warning)
    return exit_code(done.checks)
