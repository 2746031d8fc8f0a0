#pragma once
// Pearson's chi-square test: do counts follow the expected ones?

#include <cmath>
#include <span>
#include <vector>

namespace pbrt::laws {

// By how many standard deviations the statistic exceeds its mean, by the normal approximation of
// Wilson and Hilferty (1931). Fair counts give more than 4 once in 30000 tests. Every expected
// count should be at least 5.
inline double chiSquareDeviation(std::span<const double> counts, std::span<const double> expected) {
  double statistic = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  const double freedom = static_cast<double>(counts.size()) - 1;
  const double variance = 2 / (9 * freedom);
  return (std::cbrt(statistic / freedom) - (1 - variance)) / std::sqrt(variance);
}

// The same for cells that are equally likely.
inline double uniformDeviation(std::span<const double> counts) {
  double sum = 0;
  for (const double c : counts) sum += c;
  const std::vector<double> expected(counts.size(), sum / static_cast<double>(counts.size()));
  return chiSquareDeviation(counts, expected);
}

}  // namespace pbrt::laws
