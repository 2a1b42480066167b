"""The table of units that the studio's client reads quantities with, made from `ilmek.units`."""

import json
from pathlib import Path

from ilmek.units import GREATEST, HIGHEST_POWER, LEAST, LONGEST, UNITS

TABLE = Path(__file__).parents[2] / "studio/src/ui/units.json"


def client_units() -> str:
    """The table as JSON: limits, and of each symbol its factor to SI and its dimension."""
    about = {"longest": LONGEST, "greatest": GREATEST, "least": LEAST, "highestPower": HIGHEST_POWER}
    rows = ",\n".join(f"    {json.dumps(name, ensure_ascii=False)}: {json.dumps(made)}" for name, made in UNITS.items())
    limits = ",\n".join(f"  {json.dumps(name)}: {value:g}" for name, value in about.items())
    return f'{{\n{limits},\n  "units": {{\n{rows}\n  }}\n}}\n'


if __name__ == "__main__":
    TABLE.write_text(client_units(), encoding="utf-8")
