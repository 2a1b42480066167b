"""Files in and out.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "read_cyclogram": "ilmek.io.cyclogram_file",
    "write_cyclogram": "ilmek.io.cyclogram_file",
    "write_dxf": "ilmek.io.dxf",
    "read_mechanism": "ilmek.io.mechanism_file",
    "write_mechanism": "ilmek.io.mechanism_file",
    "read_path": "ilmek.io.path_file",
    "read_picture": "ilmek.io.picture",
    "open_programme": "ilmek.io.programme_file",
    "write_programme": "ilmek.io.programme_file",
    "write_step": "ilmek.io.step",
    "csv_text": "ilmek.io.table_csv",
    "default_yarns": "ilmek.io.yarn_file",
    "read_yarns": "ilmek.io.yarn_file",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.io.cyclogram_file import read_cyclogram as read_cyclogram
    from ilmek.io.cyclogram_file import write_cyclogram as write_cyclogram
    from ilmek.io.dxf import write_dxf as write_dxf
    from ilmek.io.mechanism_file import read_mechanism as read_mechanism
    from ilmek.io.mechanism_file import write_mechanism as write_mechanism
    from ilmek.io.path_file import read_path as read_path
    from ilmek.io.picture import read_picture as read_picture
    from ilmek.io.programme_file import open_programme as open_programme
    from ilmek.io.programme_file import write_programme as write_programme
    from ilmek.io.step import write_step as write_step
    from ilmek.io.table_csv import csv_text as csv_text
    from ilmek.io.yarn_file import default_yarns as default_yarns
    from ilmek.io.yarn_file import read_yarns as read_yarns
