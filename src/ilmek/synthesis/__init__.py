"""From a task to link lengths: closed-form synthesis of linkages.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from ilmek.lazy import lazy_names

__all__, __getattr__, __dir__ = lazy_names(__name__, __file__)
