"""The main jobs, shared by the command line and the studio."""
