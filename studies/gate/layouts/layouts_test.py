"""Tests of the statistics and of the simulated gates; the expected quantiles are those of tables."""

import importlib.machinery
import importlib.util
import random
import statistics
import sys
import unittest

import random_effects as effects
import simulated_gates as simulated
from programs import RELINK


class Layouts(unittest.TestCase):
    def test_quantiles(self):
        self.assertAlmostEqual(effects.t_quantile(0.975, 1), 12.7062, places=4)
        self.assertAlmostEqual(effects.t_quantile(0.975, 7), 2.36462, places=4)
        self.assertAlmostEqual(effects.f_quantile(0.95, 9, 50), 2.0734, places=3)
        self.assertAlmostEqual(effects.chi_squared_quantile(0.975, 9), 19.0228, places=3)
        self.assertAlmostEqual(effects.chi_squared_quantile(0.025, 9), 2.70039, places=4)

    def test_interval_of_a_mean(self):
        low, high = effects.t_interval([1, 2, 3, 4], 0.95)  # nothing is trimmed
        self.assertAlmostEqual(high - 2.5, 2.05426, places=4)  # 3.18245 sqrt(5 / 3 / 4)
        self.assertAlmostEqual(2.5 - low, high - 2.5)
        low, high = effects.t_interval([-90, 1, 2, 3, 100], 0.95)  # of 1, 2, 3
        # The squares of 1, 1, 2, 3, 3 add up to 4: 4.30265 sqrt(4 / 6)
        self.assertAlmostEqual(high - 2, 3.51310, places=4)
        self.assertAlmostEqual(2 - low, high - 2)

    def test_trimmed_mean_leaves_out_what_is_far_away(self):
        self.assertAlmostEqual(effects.trimmed_mean([0, 1, 2, 3, 1000]), 2)
        self.assertLess(effects.trimmed_variance([0, 1, 2, 3, 1000]), 1)

    def test_effects_are_found_and_their_interval_holds_them(self):
        drawn, inside, found = random.Random(1), 0, []
        for _ in range(40):
            groups = []
            for _ in range(12):
                shift = drawn.gauss(0, 0.01)
                groups.append([shift + drawn.gauss(0, 0.02) for _ in range(20)])
            result = effects.random_effects(groups)
            inside += result["low"] <= 0.01 <= result["high"]
            found.append(result["between"])
        self.assertGreaterEqual(inside, 34)
        self.assertAlmostEqual(sum(found) / len(found), 0.01, delta=0.001)

    def test_no_effect_is_found_where_none_is(self):
        drawn = random.Random(2)
        result = effects.random_effects([[drawn.gauss(0, 0.02) for _ in range(30)] for _ in range(12)])
        self.assertEqual(result["low"], 0)
        self.assertLess(result["between"], 0.005)
        self.assertAlmostEqual(result["within"], 0.02, delta=0.003)

    def test_rounds_are_taken_out(self):
        rows = [[shift + layout for layout in (0, 1, 2)] for shift in (5, 9, 7)]
        for layout, group in enumerate(effects.without_rounds(rows)):
            self.assertEqual(group, [7 + layout] * 3)

    def test_noise_of_means_is_taken_out(self):
        drawn = random.Random(4)
        shifts = [drawn.gauss(0, 0.03) for _ in range(30)]
        groups = [[shift + drawn.gauss(0, 0.06) for _ in range(10)] for shift in shifts]
        changed = effects.without_noise_of_means(groups)
        spread = statistics.stdev(effects.trimmed_mean(group) for group in changed)
        self.assertAlmostEqual(spread, effects.random_effects(groups)["between"])
        self.assertLess(spread, statistics.stdev(effects.trimmed_mean(group) for group in groups))

    def test_simulated_gates(self):
        drawn = random.Random(3)
        logs = {}
        for case in ("still", "moving"):
            shifts = [drawn.gauss(0, 0.02 if case == "moving" else 0) for _ in range(16)]
            logs[case] = [[shift + drawn.gauss(0, 0.001) for _ in range(10)] for shift in shifts]
        layouts = simulated.Layouts(logs, 1)
        bare = simulated.simulate(layouts, simulated.Method("bare"), 40)
        self.assertGreater(bare["worse"], 5)
        self.assertEqual(bare["found_of"]["still"], [20, 20])
        high = simulated.simulate(layouts, simulated.Method("high", dict.fromkeys(logs, 0.2)), 40)
        self.assertEqual(high["worse"] + high["found"], 0)
        several = simulated.simulate(layouts, simulated.Method("several", layouts=8), 40)
        self.assertLess(several["worse"], 3)
        self.assertGreater(several["found"], 30)

    def test_floor_of_layouts(self):
        self.assertAlmostEqual(simulated.layout_floor(0.015, 10), 2.8782 * 2**0.5 * 0.015, places=5)

    def test_padding_follows_from_the_seed(self):
        loader = importlib.machinery.SourceFileLoader("relink", str(RELINK[-1]))
        relink = importlib.util.module_from_spec(importlib.util.spec_from_loader("relink", loader))
        loader.exec_module(relink)
        self.assertEqual(relink.padding_source(random.Random("1 base")), relink.padding_source(random.Random("1 base")))
        self.assertNotEqual(relink.padding_source(random.Random("1 base")),
                            relink.padding_source(random.Random("1 head")))


def main():
    unittest.main(module=__name__, argv=sys.argv[:1])
