#pragma once
// Means and straight lines with their standard errors.

#include <cmath>
#include <optional>
#include <span>

namespace pbrt {

struct Estimate {
  double value = 0;
  std::optional<double> error;  // standard error; empty if one value says nothing about it
};

// The mean of the values; there is one at least.
inline Estimate meanOf(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  if (values.size() < 2) return {mean, {}};
  return {mean, std::sqrt(squares / (n - 1) / n)};
}

// The slope of the line through points (x, y) by least squares. Its error is that of independent y
// of equal variance, taken from how far they are off the line. Empty for fewer than three points or
// if all x are the same.
inline std::optional<Estimate> slopeOf(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  const double meanX = meanOf(x).value, meanY = meanOf(y).value;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - meanX) * (x[i] - meanX);
    xy += (x[i] - meanX) * (y[i] - meanY);
    yy += (y[i] - meanY) * (y[i] - meanY);
  }
  if (x.size() < 3 || !(xx > 0)) return {};
  const double slope = xy / xx;
  const double residual = std::max(0.0, yy - slope * xy);
  return Estimate{slope, std::sqrt(residual / (n - 2) / xx)};
}

}  // namespace pbrt
