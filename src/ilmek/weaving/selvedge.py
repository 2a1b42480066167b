"""The turn of a weft at the edge of the cloth: does it hold the outermost warp?

Two wefts alternate: one always in the even shed, the other in the odd. A weft therefore leaves and enters the cloth at
an edge in the same shed, on the same side of every warp: behind a lifted one, in front of the other. Its turn is held
by the other weft alone, which lies between its two rows on the other side of each warp. Pulled inwards, the turn slips
past a warp as long as it can stay on the side of the other weft on which it crossed it outside:

    at warp k from the edge the weft is in front (+) or behind (-) in turn; there the other weft is on the opposite side
    the turn passes warp k only where it crosses the other weft on the same side as it passes the warp

so that it lets go of no warp where it crosses on the other side than it passes the outermost, and of one where it
crosses on the same side; without the other weft it would slip out.                     [derived; tested by brute force]
"""


def in_front(warp: int, shed: int) -> bool:
    """Whether a weft lies in front of a warp.

    warp  index from the left      shed  0: even warps are lifted before the weft, 1: odd ones
    """
    return warp % 2 != shed


def warps_let_go(front: bool, crosses_in_front: bool) -> int:
    """Outermost warps that a turn lets go of when it is pulled.

    front  whether the weft lies in front of the outermost warp     crosses_in_front  of the other weft, at its turn

    >>> warps_let_go(front=True, crosses_in_front=False), warps_let_go(front=True, crosses_in_front=True)
    (0, 1)
    """
    return int(front == crosses_in_front)
