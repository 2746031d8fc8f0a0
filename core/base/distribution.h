#pragma once
// Choosing among the cells of a grid with given chances.

#include <cstdint>
#include <vector>

#include "core/base/math.h"

namespace pbrt {

class Distribution2D {
 public:
  struct Cell {
    int x = 0, y = 0;
    Point2 within{};    // what is left of the random numbers: uniform in [0, 1)^2
    double chance = 0;  // 0: there is nothing to choose from
  };

  Distribution2D() = default;  // nothing to choose from
  // Chances in proportion to the weights, which are finite and not negative, row by row.
  Distribution2D(int width, std::vector<double> weights)
      : width_(static_cast<std::size_t>(width)), sums_(std::move(weights)) {
    double total = 0;
    for (std::size_t row = 0; row < sums_.size(); row += width_) {
      for (std::size_t x = 1; x < width_; ++x) sums_[row + x] += sums_[row + x - 1];
      rows_.push_back(total += sums_[row + width_ - 1]);
    }
  }

  double total() const { return rows_.empty() ? 0 : rows_.back(); }
  double chance(int x, int y) const {
    const double* row = &sums_[static_cast<std::size_t>(y) * width_];
    return total() > 0 ? (row[x] - (x > 0 ? row[x - 1] : 0)) / total() : 0;
  }

  Cell sample(Point2 u) const {
    if (!(total() > 0)) return {};
    Cell cell;
    cell.y = choose(rows_.data(), rows_.size(), u.y, cell.within.y);
    cell.x = choose(&sums_[static_cast<std::size_t>(cell.y) * width_], width_, u.x, cell.within.x);
    cell.chance = chance(cell.x, cell.y);
    return cell;
  }

 private:
  // The first of the rising sums that is above the share u of the last one, and how far u has come
  // from the one before.
  static int choose(const double* sums, std::size_t n, float u, float& rest) {
    const double target = u * sums[n - 1];
    const double* above = std::upper_bound(sums, sums + n - 1, target);
    const double before = above == sums ? 0 : above[-1];
    rest = std::min(static_cast<float>((target - before) / (*above - before)), kOneMinusEpsilon);
    return static_cast<int>(above - sums);
  }

  std::size_t width_ = 0;
  std::vector<double> sums_;  // of the weights within each row, up to and including a cell
  std::vector<double> rows_;  // of the rows
};

}  // namespace pbrt
