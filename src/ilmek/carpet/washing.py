"""A carpet on the loom, and the finished one, shorn and washed.

    length on the loom  l (1 + e) / (1 - s_l)      width on the loom  w / (1 - s_w)

l, w of the finished carpet; e elastic strain of the warps on the loom, which goes when the carpet is cut off, and the
ground follows it; s_l, s_w shrinkage in washing. A carpet is stretched to its width while it dries, so that it is as
wide as it was woven, where nothing else is given. Rates of washing are assumed by this project.
"""

from dataclasses import dataclass

from ilmek.params import Params, kind


@dataclass(frozen=True, slots=True)
class WashParams(Params):
    """Washing of the carpet."""

    shrink_along: float = kind.ratio(
        0.01, unit="%", at_least=0.0, at_most=0.2, doc="shrinkage in washing along the warps; usual: 0 to 3 %"
    )
    shrink_across: float = kind.ratio(
        0.0,
        unit="%",
        at_least=0.0,
        at_most=0.2,
        doc="shrinkage in washing across; usual: 0, stretched to its width while it dries, to 2 %",
    )
    wash_loss: float = kind.ratio(
        0.03, unit="%", at_least=0.0, at_most=0.3, doc="share of the mass that is washed out; usual: 1 to 6 %"
    )

    def lengthening(self, strain: float = 0.0) -> float:
        """Length on the loom over that of the finished carpet [1]; strain 0: cut off, and not yet washed.

        >>> round(WashParams(shrink_along=0.02).lengthening(0.01), 6)
        1.030612
        """
        return (1 + strain) / (1 - self.shrink_along)

    @property
    def widening(self) -> float:
        """Width on the loom over that of the finished carpet [1]."""
        return 1 / (1 - self.shrink_across)
