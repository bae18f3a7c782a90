#!/usr/bin/env python3
"""Tests of methods.py; the expected values are SciPy's."""

import unittest

import methods


class Methods(unittest.TestCase):
    def test_u_test_is_that_of_scipy(self):
        # scipy.stats.mannwhitneyu(a, b, alternative='two-sided').pvalue
        a = [1.0, 2.1, 3.3, 4, 5.2, 6, 7.7, 8, 9, 10, 10, 12]
        b = [2, 3.3, 5, 6.1, 7, 8, 9.5, 11, 12, 13, 14, 15, 16]
        self.assertAlmostEqual(methods.normal_u_test(a, b), 0.12746572249626184, places=12)
        self.assertAlmostEqual(methods.normal_u_test(b, a), 0.12746572249626184, places=12)
        self.assertEqual(methods.normal_u_test([1, 1], [1, 1]), 1)

    def test_u_test_fires_on_slower_heads_only(self):
        fast, slow = [1 + i / 1000 for i in range(20)], [1.1 + i / 1000 for i in range(20)]
        self.assertTrue(methods.u_test_fires(methods.normal_u_test, fast, slow))
        self.assertFalse(methods.u_test_fires(methods.normal_u_test, slow, fast))
        self.assertFalse(methods.u_test_fires(methods.normal_u_test, fast, fast))

    def test_median_has_a_fixed_limit(self):
        self.assertTrue(methods.median_fires([1, 1, 1], [1.2, 1.2, 1]))
        self.assertFalse(methods.median_fires([1, 1, 1], [1.09, 1.09, 9]))

    def test_share_has_the_interval_of_clopper_and_pearson(self):
        # scipy.stats.binomtest(k, 200).proportion_ci()
        for hits, low, high in ((0, 0, 0.018275340), (2, 0.0012133490, 0.0356546684), (200, 0.98172466, 1)):
            value = methods.share(hits, 200)
            self.assertAlmostEqual(value[0], hits / 200)
            self.assertAlmostEqual(value[1], low, places=7)
            self.assertAlmostEqual(value[2], high, places=7)


if __name__ == "__main__":
    unittest.main()
