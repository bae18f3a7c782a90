"""Gates simulated from measured times of layouts, by the rules of `ccdt gate`: bench/gate/measure_times.cpp."""

import math
import random
import statistics

import random_effects as effects

THRESHOLD, LARGEST_NOISE, CONFIDENCE, AT_LEAST, AT_MOST = math.log(1.01), 0.02, 0.95, 20, 200  # the default rules
LOOKS = 4  # by which the error of a screening is divided
LAYOUT_ALARMS = 0.02  # share of gates with a false alarm because of layouts
SLOWER = math.log(1.05)


def layout_floor(sigma, cases):
    """The log ratio that the difference of layouts exceeds in at least one case in 2% of gates."""
    return statistics.NormalDist().inv_cdf(1 - LAYOUT_ALARMS / cases) * math.sqrt(2) * sigma


class Layouts:
    """The times of all cases in all layouts."""

    def __init__(self, logs, seed):
        self.cases = list(logs)
        self.logs = logs  # case -> layout -> runs
        self.count = len(next(iter(logs.values())))
        self.random = random.Random(seed)

    def two(self):
        """A layout of the base and one of the head: two of the measured layouts, which represent all layouts."""
        return self.random.sample(range(self.count), 2)

    def ratios(self, case, two, count):
        base, head = (self.random.choices(self.logs[case][layout], k=count) for layout in two)
        return [h - b for b, h in zip(base, head)]


class Method:
    """How a gate treats layouts: two builds and a floor for each case, or several builds of each program."""

    def __init__(self, name, floors=None, layouts=None):
        self.name, self.floors, self.layouts = name, floors, layouts
        # A layout has the same number of pairs in all cases. Without rebuilding, all pairs have one layout.
        self.step = -(-AT_LEAST // layouts) if layouts else AT_MOST
        self.first = layouts * self.step if layouts else AT_LEAST

    def threshold(self, case):
        return max(THRESHOLD, self.floors[case] if self.floors else 0)

    def next(self, pairs):
        wanted = min(max(self.first, pairs + pairs // 2), AT_MOST)
        return wanted if not self.layouts else max(self.layouts, -(-wanted // self.step)) * self.step


def interval(values, confidence, is_rebuilt):
    if is_rebuilt:
        return effects.t_interval(values, confidence)
    # The normal interval is close to the bootstrap interval of the gate.
    half = statistics.NormalDist().inv_cdf((1 + confidence) / 2) * math.sqrt(effects.trimmed_variance(values))
    mean = effects.trimmed_mean(values)
    return mean - half, mean + half


class Gate:
    def __init__(self, layouts, method):
        self.layouts, self.method = layouts, method
        only = layouts.two()
        # The confirmation has layouts of its own, if there are any.
        self.twos = {phase: [] if method.layouts else [only] for phase in ("screening", "confirmation")}
        self.measured = {}

    def look(self, phase, case, pairs, confidence, slower):
        twos, values = self.twos[phase], self.measured.setdefault((phase, case), [])
        step = self.method.step
        if not self.method.layouts:
            values += self.layouts.ratios(case, twos[0], pairs - len(values))
            some = values[:pairs]
        else:
            while len(twos) * step < pairs:
                twos.append(self.layouts.two())
            while len(values) * step < pairs:
                values.append(statistics.median(self.layouts.ratios(case, twos[len(values)], step)))
            some = values[:pairs // step]
        low, high = interval(some, confidence, self.method.layouts)
        return low + slower, high + slower

    def call(self, case, low, high):
        threshold = self.method.threshold(case)
        if low > threshold:
            return "worse"
        return "passed" if high <= threshold + LARGEST_NOISE else "undecided"

    def screen(self, case, slower):
        """The call of a case, its estimate, and the number of pairs."""
        pairs = self.method.first
        while True:
            low, high = self.look("screening", case, pairs, 1 - (1 - CONFIDENCE) / LOOKS, slower)
            call = self.call(case, low, high)
            if call != "undecided" or pairs >= AT_MOST:
                return call, (low + high) / 2, pairs
            pairs = self.method.next(pairs)

    def confirm(self, case, suspects, estimate, slower):
        wanted = min(max((estimate - self.method.threshold(case)) / 2, LARGEST_NOISE / 2), LARGEST_NOISE)
        pairs = self.method.first
        while True:
            low, high = self.look("confirmation", case, pairs, 1 - (1 - CONFIDENCE) / suspects, slower)
            if (high - low) / 2 <= wanted or pairs >= AT_MOST:
                return self.call(case, low, high), pairs
            pairs = self.method.next(pairs)

    def judge(self, slow_case=None):
        """The calls of all cases, and the number of pairs of the case that has the most."""
        calls, suspects, screened, confirmed = {}, {}, 0, 0
        for case in self.layouts.cases:
            slower = SLOWER if case == slow_case else 0
            calls[case], estimate, pairs = self.screen(case, slower)
            screened = max(screened, pairs)
            if calls[case] == "worse":
                suspects[case] = estimate, slower
        for case, (estimate, slower) in suspects.items():
            calls[case], pairs = self.confirm(case, len(suspects), estimate, slower)
            confirmed = max(confirmed, pairs)
        return calls, screened + confirmed


def simulate(layouts, method, gates):
    """Counts the gates that are worse or undecided, and those that find a slower case. Each case is slower in turn."""
    counts = {"gates": gates, "worse": 0, "undecided": 0, "found": 0, "slow_undecided": 0, "pairs": [], "found_of": {}}
    for n in range(gates):
        gate = Gate(layouts, method)
        calls, pairs = gate.judge()
        counts["pairs"].append(pairs)
        counts["worse"] += "worse" in calls.values()
        counts["undecided"] += "undecided" in calls.values() and "worse" not in calls.values()
        slow_case = layouts.cases[n % len(layouts.cases)]
        slow = gate.judge(slow_case)[0][slow_case]
        counts["found"] += slow == "worse"
        counts["slow_undecided"] += slow == "undecided"
        hits = counts["found_of"].setdefault(slow_case, [0, 0])
        hits[0] += slow == "worse"
        hits[1] += 1
    counts["pairs"] = statistics.median(counts["pairs"])
    return counts
