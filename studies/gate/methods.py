"""Methods that decide from the times of base and head whether head is slower, and intervals of shares."""

import math
import statistics
import sys

ALPHA = 0.05  # of Google Benchmark's compare.py
THRESHOLD = 1.10  # a fixed limit, as many projects use it
FEW = 5  # repetitions of such a limit


def normal_u_test(a, b):
    """The two-sided p-value of the Mann-Whitney test: normal, with the corrections for ties and continuity."""
    ranked = sorted((value, side) for side, values in enumerate((a, b)) for value in values)
    rank_sum, ties, i = 0.0, 0.0, 0
    while i < len(ranked):
        j = i
        while j < len(ranked) and ranked[j][0] == ranked[i][0]:
            j += 1
        rank_sum += sum(1 for _, side in ranked[i:j] if side == 0) * (i + 1 + j) / 2
        ties += (j - i) ** 3 - (j - i)
        i = j
    n, m, total = len(a), len(b), len(a) + len(b)
    u = rank_sum - n * (n + 1) / 2
    deviation = math.sqrt(n * m / 12 * (total + 1 - ties / (total * (total - 1))))
    if deviation == 0:
        return 1.0
    z = (abs(u - n * m / 2) - 0.5) / deviation
    return min(1.0, math.erfc(z / math.sqrt(2)))


def compare_py():
    """The U test of Google Benchmark's compare.py, and its name. If that or SciPy is missing, the test above."""
    sys.path.append("/usr/share/benchmark")  # of Debian's libbenchmark-tools
    try:
        from gbench.report import calc_utest
    except ImportError:
        return normal_u_test, "own U test"
    # It also expects CPU times; there are none here, and its verdict uses the real time.
    return lambda a, b: calc_utest((a, b), (a, b))[2], "compare.py"


def u_test_fires(u_test, base, head):
    return u_test(base, head) < ALPHA and statistics.median(head) > statistics.median(base)


def median_fires(base, head):
    return statistics.median(head) > THRESHOLD * statistics.median(base)


def share(hits, trials, confidence=0.95):
    """The share of hits, with the Clopper-Pearson interval."""
    tail = (1 - confidence) / 2

    def at_most(k, p):
        return sum(math.comb(trials, i) * p**i * (1 - p) ** (trials - i) for i in range(k + 1))

    def solve(holds):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if holds(middle) else (low, middle)
        return low

    low = 0.0 if hits == 0 else solve(lambda p: 1 - at_most(hits - 1, p) < tail)
    high = 1.0 if hits == trials else solve(lambda p: at_most(hits, p) > tail)
    return hits / trials, low, high
