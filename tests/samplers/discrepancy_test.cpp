// How evenly every sampler's numbers are spread, and how its errors are spread over the picture.

#include <complex>

#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::sampler;

class SamplerSpread : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, SamplerSpread,
                         testing::ValuesIn(test::loader().available(PluginKind::sampler)),
                         [](const auto& test) { return test.param; });

// The L2 star discrepancy squared (Warnock 1972): the mean square, over all boxes from the origin,
// of the part of the points in the box less its area. Of n random points it is
// (1 / 4 - 1 / 9) / n.
double discrepancy2(std::span<const Point2> points) {
  double single = 0, pairs = 0;
  for (const Point2& p : points) {
    single += (1 - sqr(double{p.x})) * (1 - sqr(double{p.y}));
    for (const Point2& q : points) pairs += (1.0 - std::max(p.x, q.x)) * (1.0 - std::max(p.y, q.y));
  }
  const auto n = static_cast<double>(points.size());
  return 1.0 / 9 - single / (2 * n) + pairs / (n * n);
}
// The same in one dimension: of random points 1 / (6 n).
double discrepancy1(std::span<const Point2> points) {
  double single = 0, pairs = 0;
  for (const Point2& p : points) {
    single += 1 - sqr(double{p.x});
    for (const Point2& q : points) pairs += 1.0 - std::max(p.x, q.x);
  }
  const auto n = static_cast<double>(points.size());
  return 1.0 / 3 - single / n + pairs / (n * n);
}

// One-dimensional numbers `a` and `b` of all samples of a pixel.
std::vector<Point2> drawPair(Sampler& s, Point2i pixel, int a, int b) {
  std::vector<Point2> points;
  for (int i = 0; i < s.samplesPerPixel(); ++i) {
    s.start(pixel, static_cast<std::uint32_t>(i));
    s.pixel2D();
    Point2 p;
    for (int d = 0; d <= b; ++d) {
      const float u = s.get1D();
      if (d == a) p.x = u;
      if (d == b) p.y = u;
    }
    points.push_back(p);
  }
  return points;
}

// Mean of a discrepancy over pixels, relative to random points.
template <class Measure>
double relative(Measure measure, double ofRandom, int n) {
  constexpr int pixels = 100;
  double sum = 0;
  for (int t = 0; t < pixels; ++t) sum += measure(t);
  return sum / pixels * n / ofRandom;
}

TEST_P(SamplerSpread, DiscrepancyIsThatOfRandomPointsOrLess) {
  const bool random = GetParam() == "random";
  for (const int n : {16, 64, 100, 256}) {
    const auto s = sampler(GetParam(), {}, n);
    const int count = s->samplesPerPixel();
    const auto points = [&](int t, int d) {
      return draw(*s, {t, 40}, d, 0, static_cast<std::uint32_t>(count));
    };
    for (const int d : {0, 1, 12}) {
      const double line =
          relative([&](int t) { return discrepancy1(points(t, d)); }, 1.0 / 6, count);
      const double square =
          relative([&](int t) { return discrepancy2(points(t, d)); }, 5.0 / 36, count);
      const std::string name = std::to_string(n) + "_" + std::to_string(d);
      RecordProperty("line_" + name, std::to_string(line));
      RecordProperty("square_" + name, std::to_string(square));
      // With fewer samples than their bases Halton's dimensions are random.
      const double most = random || (GetParam() == "halton" && d == 12) ? 1.4 : 0.6;
      EXPECT_LT(line, most) << name;
      EXPECT_LT(square, most) << name;
    }
  }
}

// Pairs of dimensions far out: no two are alike, as those of Halton's and Sobol's sequences are
// before they are randomised.
TEST_P(SamplerSpread, PairsOfHighDimensionsAreAsGoodAsRandomPoints) {
  for (const int n : {16, 64}) {
    const auto s = sampler(GetParam(), {}, n);
    double worst = 0;
    for (const Point2i pair : {Point2i(20, 21), Point2i(22, 23), Point2i(24, 31), Point2i(28, 36),
                               Point2i(40, 42), Point2i(60, 61)}) {
      const auto measure = [&](int t) {
        return discrepancy2(drawPair(*s, {t, 9}, pair.x, pair.y));
      };
      worst = std::max(worst, relative(measure, 5.0 / 36, n));
    }
    RecordProperty("worst_" + std::to_string(n), std::to_string(worst));
    EXPECT_LT(worst, 1.4) << n;
  }
}

// The picture of the errors of a test integral: its power at low frequencies, up to 1/8 of a cycle
// per pixel, over that of independent samples, and over what it would be if its own power were the
// same at all frequencies.
struct CoarseGrain {
  double ofIndependent, ofWhite;
};
CoarseGrain coarseGrain(Sampler& s, int dimension) {
  constexpr int side = 64;
  constexpr double area = 0.32;
  std::vector<double> error;
  double squares = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      double sum = 0;
      const auto points =
          draw(s, {x, y}, dimension, 0, static_cast<std::uint32_t>(s.samplesPerPixel()));
      for (const Point2& p : points) sum += p.x + p.y < 0.8F ? 1 : 0;
      error.push_back(sum / s.samplesPerPixel() - area);
      squares += sqr(error.back());
    }
  std::vector<std::complex<double>> wave;
  for (int i = 0; i < side; ++i) wave.push_back(std::polar(1.0, 2 * std::numbers::pi * i / side));
  double power = 0;
  int frequencies = 0;
  for (int v = 0; v <= 8; ++v)
    for (int u = -8; u <= 8; ++u) {
      if ((u == 0 && v == 0) || u * u + v * v > 64) continue;
      std::complex<double> sum = 0;
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          sum += error[static_cast<std::size_t>(y * side + x)] *
                 wave[static_cast<std::size_t>((u * x + v * y) & (side - 1))];
      power += std::norm(sum);
      ++frequencies;
    }
  power /= frequencies;
  return {power * s.samplesPerPixel() / (area * (1 - area) * side * side), power / squares};
}

// Nowhere more of it than independent pixels have; of zsobol, which claims so, much less.
TEST_P(SamplerSpread, ErrorsOfThePictureHaveNoCoarseGrain) {
  const bool fine = GetParam() == "zsobol";
  for (const int n : {1, 4, 8, 16})
    for (const int d : {0, 3, 25}) {
      double ofIndependent = 0, ofWhite = 0;
      constexpr int seeds = 4;
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const CoarseGrain grain = coarseGrain(*sampler(GetParam(), {}, n, seed), d);
        ofIndependent += grain.ofIndependent / seeds;
        ofWhite += grain.ofWhite / seeds;
      }
      const std::string name = std::to_string(n) + "_" + std::to_string(d);
      RecordProperty("independent_" + name, std::to_string(ofIndependent));
      RecordProperty("white_" + name, std::to_string(ofWhite));
      EXPECT_LT(ofIndependent, fine ? 0.5 : 1.3) << n << " samples, dimension " << d;
      EXPECT_LT(ofWhite, fine ? 0.6 : 1.3) << n << " samples, dimension " << d;
    }
}

}  // namespace
}  // namespace pbrt
