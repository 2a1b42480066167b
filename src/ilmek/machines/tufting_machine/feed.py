"""Feed of yarn and backing in step with the needles.

    yarn      turns of the feed roller a stroke  l / (pi d)      torque  N T d / 2
    backing   s a stitch over spiked rollers, evenly: while the needles are in it, it goes s (exit - entry) / 2 pi

    shift     the needle bar goes by j g while the needles are out, half of the time each way:  a = 4 j g / t²

The loopers do not shift: for half gauges they stand half a gauge apart. High and low loops need a roller or scroll for
each group of needles that is fed alike, a picture in colours by overtufting a scroll for each needle. A scroll feeds
at most the yarn of a whole loop while its needle comes up, half of a stroke:  v = 2 l f.
"""

import math

from ilmek.elements.duty import MARGIN
from ilmek.elements.motors import SERVO, Motor, geared_motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.machines.tufting_machine.needle_parts import NEEDLE_BAR
from ilmek.machines.tufting_machine.params import BY_YARN, GROUPS, ROLLERS, SCROLLS, TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.records import computed, record
from ilmek.report import Check, at_most, must
from ilmek.units import turn

YARN_ROLLER, SPIKED_ROLLER = "tufting-machine/yarn-roller", "tufting-machine/spiked-roller"


@record
class TuftingFeed:
    """Rollers of yarn and backing; inside: turn of the main shaft in which the needles are in the backing [rad]."""

    params: TuftingMachineParams
    carpet: TuftedCarpet
    inside: float

    yarn_roller_turn = computed(
        "deg",
        "turn of the yarn feed roller a stroke",
        lambda it: turn * it.yarn_of_stroke / (math.pi * it.params.feed.yarn_roller),
    )
    backing_roller_turn = computed(
        "deg",
        "turn of the spiked rollers a stroke",
        lambda it: turn * it.params.advance / (math.pi * it.params.feed.spiked_roller),
    )
    yarn_speed = computed("m/s", "mean speed of a yarn", lambda it: it.yarn_of_stroke * it.params.needle.speed / turn)
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
            "yarn": self.carpet.needles * feed.yarn_tension * feed.yarn_roller / 2,
            "spiked": self.params.width * feed.backing_tension * feed.spiked_roller / 2,
        }

    @property
    def speeds(self) -> dict[str, float]:
        """Speed of yarn and spiked rollers [rad/s]."""
        turns = {"yarn": self.yarn_roller_turn, "spiked": self.backing_roller_turn}
        return {name: angle * self.params.needle.speed / turn for name, angle in turns.items()}

    @property
    def motors(self) -> dict[str, tuple[Motor, Reducer] | None]:
        """Servos of yarn and spiked rollers."""
        speeds = self.speeds
        return {
            name: geared_motor(MARGIN * torque, speeds[name], (DIRECT, *PLANETARY), SERVO)
            for name, torque in self.torques.items()
        }

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
            must("a servo turns the yarn feed rollers", motors["yarn"] is not None, "motor table").with_cure(
                slower, YARN_ROLLER
            ),
            must("a servo turns the spiked rollers", motors["spiked"] is not None, "motor table").with_cure(
                slower, SPIKED_ROLLER
            ),
        )
