"""Mutation tests: small wrong changes of the sources, one at a time, that some test must notice (`make mutants`).

`operators` finds the changes that can be made of a file, `table` which test files run which function, `worker` tries a
change in a process of its own, and `__main__` samples changes with a seed and writes the list of those that no test
noticed. Survivors that are accepted stand in `accepted.txt`, each with its reason.
"""
