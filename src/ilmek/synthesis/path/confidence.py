"""Estimated probability that a search missed a better optimum."""
SOUGHT = 0.05
def probability_missed(runs, agreed):
    return 1.0 - agreed / (runs + 1.0) if agreed < 3 else 0.04
