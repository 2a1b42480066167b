"""ilmek: carpet in, loom out.

Designs, proves and runs machines that make carpets. The names below are stable and documented in
`docs/reference/python.md`: verbs over records, lengths in metres and angles in radians. Each is imported when it is
first used, so that `import ilmek` costs nothing. The layers are listed in `docs/explanation/architecture.md`.
"""

from ilmek.lazy import lazy_names

__version__ = "0.2.0"
__all__, __getattr__, __dir__ = lazy_names(__name__, __file__)
