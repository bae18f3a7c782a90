#pragma once

#include <span>
#include <vector>

#include "bench/run/statistics.h"

/// Medians with intervals that keep their confidence even if the number of samples depends on the samples.
///
/// The interval reaches from the r-th smallest to the r-th largest of n independent samples. How many of these are
/// below the median is binomial, whatever the distribution, so it misses with the probability 2 P(B(n, 1/2) < r) (David
/// and Nagaraja 2003, "Order Statistics", section 7.1; Le Boudec 2010, "Performance Evaluation", section 2.2). If the
/// distribution changes from sample to sample, it does not miss the median of the mixture more often (Hoeffding 1956).
///
/// A measurement that stops as soon as its interval is narrow stops too often at one that is narrow and wrong by
/// chance. Therefore it may stop only at a few looks, whose numbers of samples are fixed in advance. The error of 5% is
/// divided among all looks (alpha spending: Lan and DeMets 1983). With 95% confidence, the intervals of all looks are
/// right, so it does not matter by which rule the measurement stops at one of them.
namespace ccdt::bench {

/// Fewer samples have no interval: the range of five misses the median with a probability of 6.25%.
inline constexpr int fewest_for_interval = 6;

/// The numbers of samples at which a measurement may stop: the smallest with an interval, three times as many, and so
/// on, up to the largest.
/// \pre 1 <= at_least <= at_most
std::vector<int> looks_between(int at_least, int at_most);

/// The rank of the lower end of the interval, from 1; the upper end has the same rank from above. 0: none.
///
/// \param looks  in order; those with fewer samples have spent their part of the error. None: the number of samples was
///               fixed
int rank_of_interval(int samples, std::span<const int> looks = {});

/// The median with its interval; without one if there are too few samples.
/// \pre there is a sample
Estimate median_estimate(std::span<const double> samples, std::span<const int> looks = {});

/// The median of the ratios of the i-th samples of two cases that took turns. Changes that affect both, such as the
/// speed of the machine, cancel. If one case has more samples, its last ones do not count.
///
/// \pre there is a sample in each and the denominators are positive
Estimate median_ratio(std::span<const double> numerator, std::span<const double> denominator,
                      std::span<const int> looks = {});

}  // namespace ccdt::bench
