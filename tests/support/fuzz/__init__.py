"""`make fuzz`: hostile and random inputs for every command, in processes that may die.

An input is a command line with its files (`Case`). It follows from a number alone (`inputs`), is run in a folder of its
own as a process would run it (`execution`), and what comes out is judged (`oracles`). A finding is reduced to the part
that matters (`reduction`) and written as a case that a test replays.
"""
