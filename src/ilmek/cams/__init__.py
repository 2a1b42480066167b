"""Motion laws and cam profiles."""
