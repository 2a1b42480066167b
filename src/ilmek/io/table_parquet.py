"""Columns of numbers and texts as Apache Parquet, for programs that read very many rows; needs the extra parquet."""

from collections.abc import Mapping
from importlib import import_module

import numpy as np

from ilmek.errors import OutputError


def parquet_bytes(columns: Mapping[str, np.ndarray]) -> bytes:
    """Columns by heading as a Parquet file, numbers to the last bit. Raises OutputError without the extra."""
    try:
        arrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    except ImportError:
        raise OutputError("--parquet needs the extra parquet", do="pip install 'ilmek[parquet]', or --csv") from None
    sink = arrow.BufferOutputStream()
    parquet.write_table(arrow.table(dict(columns)), sink)
    written: bytes = sink.getvalue().to_pybytes()
    return written
