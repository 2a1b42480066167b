"""The sentences of a machine's papers in English."""

PAPERS = {
    "paper.index": "Index of the folder",
    "paper.pages": "Papers",
    "paper.lists": "Lists",
    "paper.drawings": "Drawings and solids",
    "paper.motions": "Motions for controllers",
    "paper.rows": "{count} rows",
    "paper.measured": "measured",
    "paper.not-released": "NOT RELEASED",
    "paper.not-released-why": "Checks of this design do not hold. Make nothing of it; the index has the reasons.",
    "paper.made-by": "Made by ilmek {version}. All numbers are computed from the design, in the units beside them.",
}
