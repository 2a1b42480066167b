"""A varied parameter: a range, a list of values, or a distribution, each as a function of a share of probability."""

import numpy as np
from scipy import stats

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.params import Value
from ilmek.records import record
from ilmek.units import format_quantity

UNIFORM, NORMAL, TRIANGULAR = "uniform", "normal", "triangular"

SIGMAS = 3.0
"""Standard deviations of half a tolerance that is normally distributed: 0.27 % of the parts are outside."""


@record
class Variable:
    """A varied parameter.

    low, high  bounds [SI]; of a normal distribution its tolerance limits; of choices 0 and their number less 1
    whole      only whole numbers
    choices    texts or listed numbers [SI]; empty: any number between the bounds
    spread     distribution of the values
    nominal    value of the design that the study starts from [SI]; of choices the number of one
    """

    name: str
    unit: str
    low: float
    high: float
    nominal: float
    whole: bool = False
    choices: tuple[Value, ...] = ()
    spread: str = UNIFORM

    def __post_init__(self) -> None:
        if not self.low < self.high and len(self.choices) != 1:
            given = f"{self.name} varies from {self.shown(self.low)} to {self.shown(self.high)}"
            raise ParameterError(given, allowed="a range of some length", do="give the lower value first")

    def at(self, share: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Values [SI] at shares of probability, 0 to 1: the inverse of the cumulative distribution.

        >>> Variable("swing", "deg", 0.5, 1.0, 0.6).at(np.array([0.0, 0.5])).tolist()
        [0.5, 0.75]
        """
        if self.spread == UNIFORM or not self.continuous:
            return self.across(share)
        half, length = (self.high - self.low) / 2, self.high - self.low
        if self.spread == NORMAL:
            return np.asarray(stats.norm.ppf(share, self.low + half, half / SIGMAS))
        return np.asarray(stats.triang.ppf(share, (self.nominal - self.low) / length, self.low, length))

    @property
    def deviation(self) -> float:
        """Standard deviation of the distribution [SI]; of choices of their numbers."""
        length = self.high - self.low
        if not self.continuous:
            return float(np.sqrt(((length + 1) ** 2 - 1) / 12))
        if self.spread == TRIANGULAR:
            return float(stats.triang.std((self.nominal - self.low) / length, 0.0, length))
        return length / (2 * SIGMAS) if self.spread == NORMAL else length / float(np.sqrt(12.0))

    def across(self, share: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Values [SI] at shares of the range, whatever the distribution."""
        if self.continuous:
            return np.asarray(self.low + share * (self.high - self.low))
        return np.asarray(np.minimum(np.floor(self.low + share * (self.high - self.low + 1)), self.high))

    def share(self, value: float) -> float:
        """The share of the range of a value [SI], of a whole number or a choice the middle of its part."""
        if self.continuous:
            return (value - self.low) / (self.high - self.low)
        return (value - self.low + 0.5) / (self.high - self.low + 1)

    def setting(self, value: float) -> Value:
        """The value as the parameter takes it: a choice, a whole number, or a number [SI]."""
        if self.choices:
            return self.choices[int(value)]
        return int(value) if self.whole else float(value)

    def column(self, points: Float[np.ndarray, " n"]) -> np.ndarray:
        """The values of many designs: numbers [SI], or the texts of choices."""
        return np.array(self.choices)[points.astype(int)] if self.choices else points

    def shown(self, value: float) -> str:
        """The value in words, with its unit, so exact that it is read again as it is."""
        setting = self.setting(value)
        return format_quantity(setting, self.unit, 17) if isinstance(setting, float) else str(setting)

    @property
    def continuous(self) -> bool:
        """Whether every number between the bounds is a value."""
        return not (self.whole or self.choices)


def settings_of(variables: tuple[Variable, ...], point: FloatArray) -> dict[str, Value]:
    """Values by name of one design, a row of values of the variables."""
    return {variable.name: variable.setting(value) for variable, value in zip(variables, point, strict=True)}
