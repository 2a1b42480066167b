"""A carpet is woven: the runtime that joins controller, loom and journal, and what it shows to others."""
