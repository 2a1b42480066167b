"""The code of the course's notebooks: by cells, and as modules of a folder, which mypy checks (`make types`)."""

import json
import sys
from pathlib import Path

COURSE = Path(__file__).parents[2] / "docs" / "course"
NOTEBOOKS = sorted(COURSE.glob("*.ipynb"))


def code_cells(path: Path) -> list[str]:
    """The code of a notebook by cells."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for notebook in NOTEBOOKS:
        module = folder / f"course_{notebook.stem.replace('-', '_')}.py"
        module.write_text("\n".join(code_cells(notebook)) + "\n", encoding="utf-8")
