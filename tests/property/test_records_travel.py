"""Results of the public face travel: by pickle, to a process that starts anew as by spawn, and by Dask's protocol."""

import io
import pickle
from functools import cache
from pathlib import Path
from typing import Any

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


def written(found: object) -> bytes:
    """The pickle of a result without references to what it has written: equal texts need not be one object."""
    file = io.BytesIO()
    pickler = pickle.Pickler(file)
    pickler.fast = True
    pickler.dump(found)
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
