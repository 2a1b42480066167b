"""Feed of yarn and backing in step with the needles.

    yarn      turns of the feed roller a stroke  l / (pi d)      torque  N T d / 2, N needles on a roller
    backing   s a stitch over spiked rollers, evenly: while the needles are in it, it goes s (exit - entry) / 2 pi

    shift     the needle bar goes by j g while the needles are out, half of the time each way:  a = 4 j g / t²

The loopers do not shift: for half gauges they stand half a gauge apart. High and low loops need a roller or scroll for
each group of needles that is fed alike, a picture in colours by overtufting a scroll for each needle. A scroll feeds
at most the yarn of a whole loop while its needle comes up, half of a stroke:  v = 2 l f.
"""

import math

from ilmek.elements.duty import MARGIN
from ilmek.elements.motors import SERVO, STEPPER, Motor, geared_motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.machines.tufting_machine.needle_parts import NEEDLE_BAR
from ilmek.machines.tufting_machine.params import BY_YARN, GROUPS, ROLLERS, SCROLLS, TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.records import computed, record
from ilmek.report import Check, at_most, must
from ilmek.units import mm, turn

SCROLL_DIAMETER = 25 * mm
"""Diameter of a scroll; assumed by this project."""

YARN_ROLLER, SPIKED_ROLLER = "tufting-machine/yarn-roller", "tufting-machine/spiked-roller"


@record
class TuftingFeed:
    """Rollers of yarn and backing; inside: turn of the main shaft in which the needles are in the backing [rad]."""

    params: TuftingMachineParams
    carpet: TuftedCarpet
    inside: float

    yarn_roller_turn = computed(
        "deg",
        "mean turn of the yarn feed rollers or scrolls a stroke",
        lambda it: turn * it.yarn_of_stroke / (math.pi * it.yarn_diameter),
    )
    yarn_rollers = computed("1", "yarn feed rollers or scrolls", lambda it: it.yarn_shafts)
    backing_roller_turn = computed(
        "deg",
        "turn of the spiked rollers a stroke",
        lambda it: turn * it.params.advance / (math.pi * it.params.feed.spiked_roller),
    )
    yarn_speed = computed("m/s", "mean speed of a yarn", lambda it: it.yarn_of_stroke * it.params.needle.speed / turn)
    yarn_speed_max = computed(
        "m/s", "greatest speed of a yarn: a whole loop in half of a stroke, where loops differ", lambda it: it.fastest
    )
    backing_speed = computed(
        "m/s", "speed of the backing", lambda it: it.params.advance * it.params.needle.speed / turn
    )
    advance_in_needles = computed(
        "mm", "travel of the backing while needles are in it", lambda it: it.params.advance * it.inside / turn
    )

    shift_acceleration = computed(
        "m/s^2",
        "acceleration of the needle bar in its shift along the shafts",
        lambda it: 4 * it.params.bar_step / it.outside**2,
    )

    @property
    def yarn_of_stroke(self) -> float:
        """Mean yarn of a needle at a stroke [m]."""
        return self.carpet.yarn_of_stitch / self.params.pattern.colours

    @property
    def outside(self) -> float:
        """Time of a stitch in which the needles are out of the backing [s]."""
        return (turn - self.inside) / self.params.needle.speed

    @property
    def torques(self) -> dict[str, float]:
        """Torque of yarn and spiked rollers [N m]."""
        feed = self.params.feed
        return {
            "yarn": math.ceil(self.carpet.needles / self.yarn_shafts) * feed.yarn_tension * self.yarn_diameter / 2,
            "spiked": self.params.width * feed.backing_tension * feed.spiked_roller / 2,
        }

    @property
    def speeds(self) -> dict[str, float]:
        """Speed of yarn and spiked rollers [rad/s]."""
        backing = self.backing_roller_turn * self.params.needle.speed / turn
        return {"yarn": self.fastest / (self.yarn_diameter / 2), "spiked": backing}

    @property
    def motors(self) -> dict[str, tuple[Motor, Reducer] | None]:
        """Servos of yarn and spiked rollers; of scrolls steppers."""
        speeds, scrolls = self.speeds, self.params.pattern.attachment == SCROLLS
        return {
            name: geared_motor(
                MARGIN * torque,
                speeds[name],
                (DIRECT,) if scrolls and name == "yarn" else (DIRECT, *PLANETARY),
                STEPPER if scrolls and name == "yarn" else SERVO,
            )
            for name, torque in self.torques.items()
        }

    @property
    def yarn_shafts(self) -> int:
        """Shafts that feed yarn: rollers, or a scroll for each needle."""
        pattern = self.params.pattern
        return {ROLLERS: 1, GROUPS: min(pattern.groups, self.carpet.needles), SCROLLS: self.carpet.needles}[
            pattern.attachment
        ]

    @property
    def yarn_diameter(self) -> float:
        """Diameter of yarn rollers or scrolls [m]."""
        return SCROLL_DIAMETER if self.params.pattern.attachment == SCROLLS else self.params.feed.yarn_roller

    @property
    def fastest(self) -> float:
        """Greatest speed of a yarn [m/s]."""
        mean, params = self.yarn_of_stroke * self.params.needle.speed / turn, self.params
        if params.pattern.attachment == ROLLERS:
            return mean
        whole = 2 * (params.pile_height + params.backing_thickness) + params.back_stitch * params.bar_step
        return 2 * max(whole, self.yarn_of_stroke) * params.needle.speed / turn

    @property
    def attachments(self) -> tuple[str, ...]:
        """Attachments that feed each yarn as its loops need, the simplest first."""
        params = self.params
        if params.pattern.colours > 1 and params.pattern.selection == BY_YARN:
            return (SCROLLS,)
        return (ROLLERS, GROUPS, SCROLLS) if params.low_height is None else (GROUPS, SCROLLS)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Advance of the backing, motors."""
        slower = "set a lower needle.speed, or a lower tension"
        pattern, allowed = self.params.pattern, self.attachments
        motors = self.motors
        return (
            at_most("colours on the creel", pattern.colours, pattern.creel, "1", "parameter pattern.creel").with_cure(
                "take fewer colours, or set a larger pattern.creel", YARN_ROLLER
            ),
            must(
                "each yarn is fed as its loops need", pattern.attachment in allowed, f"by {' or '.join(allowed)}"
            ).with_cure(f"set pattern.attachment={allowed[0]}", YARN_ROLLER),
            at_most(
                "travel of the backing while needles are in it",
                self.advance_in_needles,
                self.params.feed.give,
                "mm",
                "parameter feed.give",
            ).with_cure("set more stitches over the length, or a lower pile_height", SPIKED_ROLLER),
            at_most(
                "acceleration of the needle bar in its shift",
                self.shift_acceleration,
                self.params.feed.shift_acceleration,
                "m/s^2",
                "parameter feed.shift_acceleration",
            ).with_cure("set a lower needle.speed, or a smaller shift", NEEDLE_BAR),
            must("a motor turns each yarn feed roller or scroll", motors["yarn"] is not None, "motor table").with_cure(
                slower, YARN_ROLLER
            ),
            must("a servo turns the spiked rollers", motors["spiked"] is not None, "motor table").with_cure(
                slower, SPIKED_ROLLER
            ),
        )


def scroll_motor(feed: TuftingFeed) -> Motor | None:
    """The motor of a scroll; None: none in the table is enough."""
    pair = feed.motors["yarn"]
    return pair[0] if pair else None
