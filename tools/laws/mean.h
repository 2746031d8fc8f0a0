#pragma once
// Estimates with their variance.

#include <algorithm>
#include <cmath>

namespace pbrt::laws {

// A mean that a random experiment estimates, and how sure it is (Welford 1962).
class Mean {
 public:
  void add(double x) {
    ++n_;
    const double delta = x - mean_;
    mean_ += delta / n_;
    squares_ += delta * (x - mean_);
  }
  double mean() const { return mean_; }
  double variance() const { return squares_ / (n_ * std::max(1.0, n_ - 1)); }  // of the mean
  double error() const { return std::sqrt(variance()); }                       // of the mean

 private:
  double n_ = 0, mean_ = 0, squares_ = 0;
};

}  // namespace pbrt::laws
