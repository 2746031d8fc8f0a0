#pragma once
// What the rays of a picture see of a surface, and how far off that is.

#include <numbers>
#include <vector>

#include "core/base/math.h"

namespace pbrt::bench {

struct Seen {
  double t = std::numeric_limits<double>::infinity();  // distance along the ray
  DVec3 n{};                                           // unit, outward

  bool found() const { return std::isfinite(t); }
};

// Scanline order.
struct Picture {
  int size = 0;  // pixels along each side
  std::vector<Seen> seen = std::vector<Seen>(static_cast<std::size_t>(size) * size);

  Seen& at(int x, int y) { return seen[static_cast<std::size_t>(y) * size + x]; }
  const Seen& at(int x, int y) const { return seen[static_cast<std::size_t>(y) * size + x]; }
  bool found(int x, int y) const {
    return x >= 0 && y >= 0 && x < size && y < size && at(x, y).found();
  }
};

// The arc cosine of a product near one would lose half the digits.
inline double degreesBetween(const DVec3& a, const DVec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

// Of any number of pictures.
struct Errors {
  std::vector<double> distance, degrees;  // where both pictures see something
  double silhouette = 0;                  // length of the exact silhouette, in pixels
  std::size_t oneOnly = 0;                // pixels that see something in one of the two pictures
  std::size_t edge = 0;                   // pixels at the silhouette, on either side
  std::size_t inner = 0, holes = 0;       // pixels well inside it, and those that see nothing

  // `unit` is what distances are divided by.
  void add(const Picture& exact, const Picture& picture, double unit);
  // One pixel alone.
  void add(const Seen& exact, const Seen& seen, double unit) {
    if (exact.found() != seen.found()) ++oneOnly;
    if (!exact.found() || !seen.found()) return;
    distance.push_back(std::abs(seen.t - exact.t) / unit);
    degrees.push_back(degreesBetween(seen.n, exact.n));
  }

 private:
  static constexpr int kMargin = 3;  // in pixels: what is well inside
};

// By Cauchy and Crofton, a curve of length L crosses 4 L / pi lines of two families of parallels
// that are one apart, if all its directions are as frequent.
inline void Errors::add(const Picture& exact, const Picture& picture, double unit) {
  std::size_t crossings = 0;
  for (int y = 0; y < exact.size; ++y)
    for (int x = 0; x < exact.size; ++x) {
      const Seen &e = exact.at(x, y), &p = picture.at(x, y);
      add(e, p, unit);
      int differ = 0;
      for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {-1, 0}, {0, -1}}) {
        if (exact.found(x + dx, y + dy) == e.found()) continue;
        ++differ;
        if (dx + dy > 0) ++crossings;
      }
      if (differ > 0) ++edge;
      bool within = true;
      for (int j = -kMargin; within && j <= kMargin; ++j)
        for (int i = -kMargin; within && i <= kMargin; ++i) within = exact.found(x + i, y + j);
      if (!within) continue;
      ++inner;
      if (!p.found()) ++holes;
    }
  silhouette += std::numbers::pi / 4 * static_cast<double>(crossings);
}

}  // namespace pbrt::bench
