"""Types of what the verbs of `import ilmek` return, for annotations; those of one field are in its own namespace."""

from ilmek.lazy import lazy_names

__all__, __getattr__, __dir__ = lazy_names(__name__, __file__)
