"""Motion laws, one file each."""
