#pragma once
// What the tests of samplers draw.

#include "core/base/lowdiscrepancy.h"
#include "tests/support.h"

namespace pbrt::test {

inline std::unique_ptr<Sampler> sampler(const std::string& name, const ParamList& list = {},
                                        std::optional<int> samplesPerPixel = {},
                                        std::uint64_t seed = 0) {
  return make<Sampler>(name, list, {seed, samplesPerPixel, {64, 64}});
}

// Two-dimensional number `d` (0: the place in the pixel) of samples [begin, end) of a pixel.
inline std::vector<Point2> draw(Sampler& s, Point2i pixel, int d, std::uint32_t begin,
                                std::uint32_t end) {
  std::vector<Point2> points;
  for (std::uint32_t i = begin; i < end; ++i) {
    s.start(pixel, i);
    Point2 p = s.pixel2D();
    for (int k = 0; k < d; ++k) p = s.get2D();
    points.push_back(p);
  }
  return points;
}

// All sets of `n` points that samples [0, count) of a pixel ask for as their third dimensions.
inline std::vector<Point2> drawSets(Sampler& s, Point2i pixel, std::size_t n, std::uint32_t count) {
  std::vector<Point2> points(n * count);
  for (std::uint32_t i = 0; i < count; ++i) {
    s.start(pixel, i);
    s.pixel2D();
    s.get1D();
    s.get2D(std::span(points).subspan(i * n, n));
  }
  return points;
}

// Whether the boxes of a grid hold the same number of points each.
inline bool evenlyShared(std::span<const Point2> points, int columns, int rows) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(columns) * rows);
  for (const Point2& p : points)
    ++counts[static_cast<std::size_t>(p.y * static_cast<float>(rows)) * columns +
             static_cast<std::size_t>(p.x * static_cast<float>(columns))];
  return std::all_of(counts.begin(), counts.end(),
                     [&](std::size_t c) { return c * counts.size() == points.size(); });
}

// Whether the points are a net in base 2: evenly shared by every grid of 2^a by 2^b equal boxes
// that has as many boxes as there are points.
inline bool isNet(std::span<const Point2> points) {
  const int n = static_cast<int>(points.size());
  for (int columns = 1; columns <= n; columns *= 2)
    if (!evenlyShared(points, columns, n / columns)) return false;
  return true;
}

}  // namespace pbrt::test
