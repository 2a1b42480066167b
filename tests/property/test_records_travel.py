"""Results of the public face travel: by pickle, to a process that starts anew as by spawn, and by Dask's protocol."""

import io
import pickle
from functools import cache
from pathlib import Path
from typing import Any, ClassVar

import pytest
from distributed.protocol import deserialize, serialize
from processes import printed, python
from public_calls import CALLS

from ilmek.errors import IlmekError

SHORT = [name for name, call in CALLS.items() if not call.long]
ECHO = """
import pickle, sys
from pathlib import Path
path = Path(sys.argv[1])
results = pickle.loads(path.read_bytes())
path.write_bytes(pickle.dumps(results))
print(len(results))
"""


@cache
def result(name: str) -> Any:
    """What a public call gives; an error of the package is a result too."""
    call = CALLS[name]
    try:
        return call.function(*(kind.value for kind in call.positional), **{k: v.value for k, v in call.named.items()})
    except IlmekError as error:
        return error


class _Plain(pickle._Pickler):  # type: ignore[name-defined]  # the one in C has no hook for sets
    """Writes a result without references to what is written already, and sets in the order of their texts.

    Both depend on what the process has read before: whether equal texts are one object, how a set was filled.
    """

    dispatch: ClassVar[dict[type, Any]] = dict(pickle._Pickler.dispatch)  # type: ignore[attr-defined]

    def ordered(self, members: frozenset[Any]) -> None:
        self.save(sorted(members, key=repr))

    dispatch[set] = dispatch[frozenset] = ordered


def written(found: object) -> bytes:
    """A result as bytes that are the same for the same result, as of one that has travelled."""
    file = io.BytesIO()
    pickler = _Plain(file)
    pickler.fast = True
    pickler.dump(pickle.loads(pickle.dumps(found)))
    return file.getvalue()


@pytest.mark.parametrize("name", SHORT)
@pytest.mark.one_in(2)
def test_a_result_is_the_same_by_pickle_and_by_dask(name: str) -> None:
    found = result(name)
    assert type(pickle.loads(pickle.dumps(found))) is type(found)
    assert written(deserialize(*serialize(found))) == written(found)


def test_a_new_process_reads_and_writes_them(tmp_path: Path) -> None:
    found, path = {name: written(result(name)) for name in SHORT}, tmp_path / "results"
    path.write_bytes(pickle.dumps({name: pickle.loads(one) for name, one in found.items()}))
    assert int(printed(python("-c", ECHO, str(path)))) == len(SHORT)
    again = pickle.loads(path.read_bytes())
    assert {name: type(one) for name, one in again.items()} == {name: type(result(name)) for name in SHORT}
