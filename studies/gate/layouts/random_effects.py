"""How much of the spread of log times is due to layouts: one-way random effects, with trimmed means."""

import functools
import math
import statistics

TRIMMED = 0.2  # share at each end, as in the gate


def _continued_fraction(a, b, x):
    """The continued fraction of the incomplete beta function, by Lentz's method (Press et al. 2007, section 6.4)."""
    tiny = 1e-300
    c, d = 1.0, 1 / max(1 - (a + b) * x / (a + 1), tiny)
    result = d
    for m in range(1, 300):
        for numerator in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                          -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1 / ((1 + numerator * d) or tiny)
            c = (1 + numerator / c) or tiny
            result *= c * d
        if abs(c * d - 1) < 1e-14:
            break
    return result


def incomplete_beta(a, b, x):
    """The regularized incomplete beta function."""
    if x <= 0 or x >= 1:
        return float(x >= 1)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x))
    if x < (a + 1) / (a + b + 2):
        return front * _continued_fraction(a, b, x) / a
    return 1 - front * _continued_fraction(b, a, 1 - x) / b


def _quantile(distribution, p):
    """The value at which the distribution function of a positive variable reaches p."""
    high = 1.0
    while distribution(high) < p:
        high *= 2
    low = 0.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if distribution(middle) < p else (low, middle)
    return low


def f_quantile(p, between, within):
    """The p-quantile of the F distribution with these degrees of freedom."""
    return _quantile(lambda f: incomplete_beta(between / 2, within / 2, between * f / (between * f + within)), p)


def chi_squared_quantile(p, freedom):
    # From the F distribution with very many degrees of freedom in the denominator; correct to seven digits.
    return freedom * f_quantile(p, freedom, 1e9)


@functools.cache
def t_quantile(p, freedom):
    """The p-quantile of Student's t distribution, for p above 1/2."""
    return math.sqrt(f_quantile(2 * p - 1, 1, freedom))


def trimmed_mean(values):
    cut = int(TRIMMED * len(values))
    return statistics.fmean(sorted(values)[cut:len(values) - cut])


def trimmed_variance(values):
    """The variance of the trimmed mean (Yuen 1974; Wilcox 2017, section 3.3)."""
    ordered = sorted(values)
    cut = int(TRIMMED * len(ordered))
    kept = len(ordered) - 2 * cut
    low, high = ordered[cut], ordered[-1 - cut]
    winsorized = [min(max(value, low), high) for value in ordered]
    mean = statistics.fmean(winsorized)
    return sum((value - mean) ** 2 for value in winsorized) / (kept * (kept - 1))


def t_interval(values, confidence):
    """Student's interval of a trimmed mean (Tukey and McLaughlin 1963)."""
    freedom = len(values) - 2 * int(TRIMMED * len(values)) - 1
    half = t_quantile((1 + confidence) / 2, freedom) * math.sqrt(trimmed_variance(values))
    mean = trimmed_mean(values)
    return mean - half, mean + half


def random_effects(groups, confidence=0.95):
    """Standard deviations of groups of equal size: between groups, with an interval (Williams 1962), and within one.

    Trimmed means and their variances are used, because a few runs are much slower than the others.
    """
    means = [trimmed_mean(group) for group in groups]
    variance, noise = statistics.variance(means), statistics.fmean(trimmed_variance(group) for group in groups)
    size, count = len(groups[0]), len(groups)
    freedom = count - 1, count * (size - 2 * int(TRIMMED * size) - 1)
    tail = (1 - confidence) / 2

    def bound(p):
        rest = 1 - f_quantile(p, *freedom) * noise / variance if variance > 0 else 0
        return math.sqrt(max(0, freedom[0] * variance * rest / chi_squared_quantile(p, freedom[0])))

    return {"between": math.sqrt(max(0, variance - noise)), "low": bound(1 - tail), "high": bound(tail),
            "of_means": math.sqrt(noise), "within": math.sqrt(noise * size),
            "largest_difference": max(means) - min(means), "groups": count, "runs": size}


def without_rounds(rows):
    """Converts rows to groups, and removes what all values of a row have in common.

    A row is one round and has one value of each group.
    """
    shifts = [statistics.median(row) for row in rows]
    middle = statistics.median(shifts)
    return [[value - shift + middle for value, shift in zip(group, shifts)] for group in zip(*rows)]


def without_noise_of_means(groups, noise=1.0):
    """Moves the trimmed means of the groups to the spread that random effects estimate. `noise` scales the noise.

    Otherwise the means, which come from few runs and so also differ by chance, would look like an effect of layouts.
    """
    means = [trimmed_mean(group) for group in groups]
    center = statistics.fmean(means)
    spread = statistics.stdev(means)
    share = random_effects(groups)["between"] / spread if spread > 0 else 0
    size = len(groups[0])
    scale = noise * math.sqrt(size / (size - 1))
    return [[center + share * (mean - center) + scale * (value - mean) for value in group]
            for mean, group in zip(means, groups)]
