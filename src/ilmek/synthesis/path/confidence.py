"""Estimated probability that a search missed a better optimum, from how many of its independent runs met the best one.

    p = (1 - m / (K + 1)) / (m + 1)        K runs, m of them ended at the best optimum known

The first factor is the rule of succession of Laplace: the share of runs that end elsewhere. The second is the
probability that an optimum unknown so far is better than one that was met m times, of m + 1 in any order. The formula
is a model; `benchmarks.bench_path_confidence` compares it with longer searches.                     [this project]
"""

SOUGHT = 0.05
"""Probability at which a search ends whose number of starts is not given."""


def probability_missed(runs: int, agreed: int) -> float:
    """Probability p of K runs of which m agreed; 1 where none did.

    >>> probability_missed(4, 4), round(probability_missed(4, 2), 3), probability_missed(4, 0)
    (0.04, 0.2, 1.0)
    """
    return (runs + 1 - agreed) / ((agreed + 1) * (runs + 1))


def share_excluded(runs: int) -> float:
    """Share q of the runs with (1 - q)^runs = 5 %: an optimum that more lead to would have been met with 95 %.

    >>> round(share_excluded(4), 3), round(share_excluded(16), 3)
    (0.527, 0.171)
    """
    return float(1.0 - 0.05 ** (1.0 / runs))
