"""The loom's programme.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "Programme": "ilmek.loom.programme",
    "Times": "ilmek.loom.times",
    "least_heads": "ilmek.loom.programme",
    "make_programme": "ilmek.loom.programme",
    "weaving_time": "ilmek.loom.programme",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.loom.programme import Programme as Programme
    from ilmek.loom.programme import least_heads as least_heads
    from ilmek.loom.programme import make_programme as make_programme
    from ilmek.loom.programme import weaving_time as weaving_time
    from ilmek.loom.times import Times as Times
