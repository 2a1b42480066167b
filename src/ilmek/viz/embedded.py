"""What pages hold for their scripts, compressed: parts of the studio's client, and the data that they draw."""

import base64
import gzip
from functools import lru_cache
from importlib.resources import files

_CLIENT = "web/client/{}-page.js"


def compressed(content: bytes, level: int = 6) -> str:
    """Compressed, as base64; the same content gives the same text.

    level  of gzip: the highest takes seven times as long, and makes it 3 % smaller
    """
    return base64.b64encode(gzip.compress(content, level, mtime=0)).decode("ascii")


@lru_cache(maxsize=2)
def client(name: str) -> str:
    """The part of the client for pages, `figures` or `loom`; "" where the package has none, as before a build."""
    script = files("ilmek").joinpath(_CLIENT.format(name))
    return compressed(script.read_bytes(), 9) if script.is_file() else ""
