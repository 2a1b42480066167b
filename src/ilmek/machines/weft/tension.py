"""Tension of a weft while it is drawn off.

    T = (T0 + mu v²) e^(f w)                        from a bobbin in the shuttle, which leaves the weft behind at rest
    T = (T0 + mu v²) e^(f w) + mu L a               from a package at rest: what is drawn is accelerated too

T0 behind the brake, mu mass per length, v speed, f friction on eyes and guides, w angle of wrap about them, L length in
the shed, a acceleration. Over the end of a bobbin the yarn turns about the axis; brake and speed of the yarn outweigh
its balloon at these speeds.  [momentum of the yarn that is set in motion, mu v² a second; capstan equation; derived]
"""

from ilmek.elements.carpet_yarns import YarnProperties
from ilmek.machines.weft.params import WeftParams
from ilmek.weaving.tension import capstan


def braked(params: WeftParams, yarn: YarnProperties) -> float:
    """Tension of a weft behind its brake [N]: as given, or a share of its breaking force."""
    return params.brake_share * yarn.breaking_force if params.brake is None else params.brake


def draw_off_tension(  # noqa: PLR0917
    yarn: YarnProperties, brake: float, speed: float, wrap: float, length: float = 0.0, acceleration: float = 0.0
) -> float:
    """Largest tension [N] of a weft.

    brake  T0 [N]      speed  v [m/s]      wrap  w [rad]      length  L [m]      acceleration  a [m/s²]

    >>> from ilmek.elements.carpet_yarns import yarn
    >>> draw_off_tension(yarn("cotton", 1e-3), 0.3, 10.0, 0.0)
    0.4
    """
    drawn = (brake + yarn.linear_density * speed**2) * capstan(yarn.friction, wrap)
    return drawn + yarn.linear_density * length * acceleration
