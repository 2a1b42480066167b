"""The project: a folder of text files that the command line reads too."""
