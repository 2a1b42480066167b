"""Drawing sheets as files: a PDF book, and a DXF for each."""
