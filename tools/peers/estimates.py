"""What programs measured, and how their results are compared."""

import dataclasses
import math
import resource

import numpy as np

TARGET = 0.01  # relative standard error to which times are scaled
FLOOR = 0.01  # of the mean: errors of darker places count relative to this, where a floor is said


def child_seconds():
    """CPU time, user and system, of all programs that were started and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@dataclasses.dataclass
class Turn:
    """One measurement of a task by one method."""

    seconds: float  # CPU time that falls as 1/error²
    values: np.ndarray  # irradiance of each point or tile, W/m² or lx
    errors: np.ndarray | None  # standard errors; None if the method does not know them
    once: float = 0.0  # CPU time that does not depend on the error, s


class Estimate:
    """The turns of one method with independent random numbers, together."""

    def __init__(self, turns, weights):
        self.weights = weights / weights.sum()
        self.turns = turns
        self.values = np.mean([turn.values for turn in turns], 0)
        self.errors = None
        if turns[0].errors is not None:
            self.errors = np.sqrt(np.sum([turn.errors**2 for turn in turns], 0)) / len(turns)
        self.seconds = float(np.median([turn.seconds for turn in turns]))
        self.once = float(np.median([turn.once for turn in turns]))

    @property
    def lit(self):
        """Points and tiles with light in every turn: only there an error relative to it can be estimated."""
        return np.all([turn.values > 0 for turn in self.turns], 0)

    def relative_errors(self, where, floor=0.0):
        """Standard errors of one turn, relative to the value, or to this fraction of the mean value if that is larger.

        where: the points or tiles, all of them lit.
        """
        errors = self.errors[where] * math.sqrt(len(self.turns))
        return errors / np.maximum(self.values[where], floor * self.mean())

    def rms_error(self, where, floor=0.0):
        return math.sqrt(np.average(self.relative_errors(where, floor) ** 2, weights=self.weights[where]))

    def seconds_to(self, error):
        """From an error of a turn to the target, standard errors being proportional to 1/√time."""
        return self.once + self.seconds * (error / TARGET) ** 2

    def mean(self):
        return float(self.weights @ self.values)

    def mean_error(self):
        """Of the mean over all points or tiles, from the differences between turns: errors of tiles are correlated."""
        means = [self.weights @ turn.values for turn in self.turns]
        return float(np.std(means, ddof=1) / math.sqrt(len(means))) if len(means) > 1 else math.nan


@dataclasses.dataclass
class Agreement:
    """Of an estimate with a reference."""

    ratio: float  # of the means
    ratio_error: float  # standard error; nan if one of them is unknown
    rms_deviation: float  # root mean square of the weighted differences, relative to the mean of the reference
    median_deviation: float  # median of the absolute differences, each relative to its value
    compared: int = 0  # points or tiles of which both errors are known well enough for the next two
    chi2: float = math.nan  # mean of z²: 1 if the standard errors are right and the methods agree
    beyond_3: float = math.nan  # fraction of |z| > 3; 0.0027 if z is normal


def agreement(estimate, reference, where, largest_error=0.1):
    """where: the points or tiles to compare, lit in both.

    largest_error: relative standard error above which a value rests on too few samples for a normal z.
    """
    ratio = estimate.mean() / reference.mean()
    ratio_error = ratio * math.hypot(estimate.mean_error() / estimate.mean(), reference.mean_error() / reference.mean())
    differences = estimate.values[where] - reference.values[where]
    rms = math.sqrt(np.average(differences**2, weights=reference.weights[where])) / reference.mean()
    found = Agreement(ratio, ratio_error, rms, float(np.median(np.abs(differences) / reference.values[where])))
    if estimate.errors is None or reference.errors is None:
        found.ratio_error = math.nan
        return found
    spread = np.hypot(estimate.errors, reference.errors)
    known = where & (spread > 0)
    for one in (estimate, reference):
        known &= one.errors < largest_error * one.values
    z = (estimate.values[known] - reference.values[known]) / spread[known]
    found.compared, found.chi2, found.beyond_3 = int(known.sum()), float(np.mean(z**2)), float(np.mean(np.abs(z) > 3))
    return found
