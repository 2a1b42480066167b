"""Common parts of dyads: two bodies, one or both attached to known bodies by pins."""

from collections.abc import Mapping
from dataclasses import dataclass

from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.groups.group import Columns, Known, Step
from ilmek.linkage.groups.shift import SlideTrack
from ilmek.linkage.groups.turn import pinned


@dataclass(frozen=True, slots=True)
class PinnedPair(Step):
    """Two bodies, each attached by a pin to a known body.

    hinges  known pins in the frames of the bodies in `on` [m]      at  the same pins in the bodies' own frames [m]
    """

    links: tuple[str, str]
    on: tuple[str, str]
    hinges: tuple[complex, complex]
    at: tuple[complex, complex]

    @property
    def bodies(self) -> tuple[str, ...]:
        """Both bodies."""
        return self.links

    @property
    def parents(self) -> tuple[str, ...]:
        """The bodies to which they are attached."""
        return self.on

    def pins(self, known: Known) -> tuple[PointMotion, PointMotion]:
        """Motions of the known pins."""
        return known[self.on[0]].carry(self.hinges[0]), known[self.on[1]].carry(self.hinges[1])

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The bodies, anchored at the known pins."""
        return {
            link: pinned(known[on], hinge, at, columns[link])
            for link, on, hinge, at in zip(self.links, self.on, self.hinges, self.at, strict=True)
        }


@dataclass(frozen=True, slots=True)
class SliderPair(Step):
    """A link attached by a pin to a known body, and a slider on another (or the same) known body.

    hinge  known pin in the frame of the body to which the link is attached [m]      at  the same pin in the link's [m]
    track  the slider on its guide
    """

    link: str
    slider: str
    on: tuple[str, str]
    hinge: complex
    at: complex
    track: SlideTrack

    @property
    def bodies(self) -> tuple[str, ...]:
        """Link and slider."""
        return self.link, self.slider

    @property
    def parents(self) -> tuple[str, ...]:
        """The body with the known pin, and the guide."""
        return self.on

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The link, anchored at the known pin, and the slider, anchored at its point on the guide."""
        return {
            self.link: pinned(known[self.on[0]], self.hinge, self.at, columns[self.link]),
            self.slider: self.track.locate(known[self.on[1]], columns[self.slider]),
        }
