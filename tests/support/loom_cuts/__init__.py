"""Power cuts and `kill -9` while a carpet is woven: is every knot in it once, in its yarn, at the end?

cuts       in process: the power fails at random instants, and the disc below the journal's file loses writes
processes  `ilmek run` itself, killed at random instants
"""
