// What every sampler must do, whatever its pattern.

#include <set>

#include "tests/chi_square.h"
#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::sampler;

class SamplerLaws : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, SamplerLaws,
                         testing::ValuesIn(test::loader().available(PluginKind::sampler)),
                         [](const auto& test) { return test.param; });

std::size_t cell(float u, int n) {
  return static_cast<std::size_t>(u * static_cast<float>(n));
}

// The two squares that hold a pair of points, of 4 x 4: sixteen times sixteen cells.
std::size_t jointCell(Point2 a, Point2 b) {
  return (cell(a.x, 4) * 4 + cell(a.y, 4)) * 16 + cell(b.x, 4) * 4 + cell(b.y, 4);
}

// One sample of each pixel: independent draws, whatever the pattern within a pixel.
TEST_P(SamplerLaws, EveryDimensionOfEverySampleIsUniform) {
  const auto s = sampler(GetParam(), {}, 16);
  for (const std::uint32_t index : {0U, 5U, 15U, 16U, 1000U, 1500000000U}) {
    for (const int d : {0, 1, 2, 7}) {
      std::vector<double> line(64), square(256);
      double sum = 0;
      constexpr int side = 160;
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          s->start({x, y}, index);
          Point2 p = s->pixel2D();
          for (int k = 0; k < d; ++k) p = s->get2D();
          const float u = s->get1D();
          ASSERT_TRUE(u >= 0 && u < 1);
          ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
          ++line[cell(u, 64)];
          ++square[cell(p.x, 16) * 16 + cell(p.y, 16)];
          sum += u;
        }
      EXPECT_LT(test::uniformDeviation(line), 4.5) << d << " of " << index;
      EXPECT_LT(test::uniformDeviation(square), 4.5) << d << " of " << index;
      EXPECT_NEAR(sum / (side * side), 0.5, 4.5 * std::sqrt(1.0 / 12) / side);
    }
  }
}

TEST_P(SamplerLaws, SetsAreUniform) {
  for (const std::size_t n : {std::size_t{1}, std::size_t{3}, std::size_t{16}}) {
    const auto s = sampler(GetParam(), {}, 8);
    std::vector<std::vector<double>> counts(n, std::vector<double>(64));
    std::vector<Point2> points(n);
    for (int x = 0; x < 20000; ++x) {
      s->start({x, 1}, 5);
      s->pixel2D();
      s->get2D(points);
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_TRUE(points[i].x >= 0 && points[i].x < 1 && points[i].y >= 0 && points[i].y < 1);
        ++counts[i][cell(points[i].x, 8) * 8 + cell(points[i].y, 8)];
      }
    }
    for (const auto& c : counts) EXPECT_LT(test::uniformDeviation(c), 4.5) << n;
  }
}

TEST_P(SamplerLaws, DimensionsAndPixelsAreIndependent) {
  const auto s = sampler(GetParam(), {}, 16);
  for (const std::uint32_t index : {0U, 3U, 11U}) {
    std::vector<double> dimensions(256), far(256), neighbours(256), seeds(256);
    const auto other = sampler(GetParam(), {}, 16, 1);
    Point2 left(0);
    for (int x = 0; x < 40000; ++x) {
      s->start({x, 2}, index);
      const Point2 a = s->pixel2D(), b = s->get2D();
      Point2 c;
      for (int d = 0; d < 5; ++d) c = s->get2D();
      ++dimensions[jointCell(a, b)];
      ++far[jointCell(b, c)];
      if (x % 2) ++neighbours[jointCell(left, a)];
      left = a;
      other->start({x, 2}, index);
      ++seeds[jointCell(a, other->pixel2D())];
    }
    EXPECT_LT(test::uniformDeviation(dimensions), 4.5) << index;
    EXPECT_LT(test::uniformDeviation(far), 4.5) << index;
    EXPECT_LT(test::uniformDeviation(neighbours), 4.5) << index;
    EXPECT_LT(test::uniformDeviation(seeds), 4.5) << index;
  }
}

// The estimate of a product of two dimensions is not worse than with independent numbers: no
// dimension repeats another's pattern over the samples of a pixel.
TEST_P(SamplerLaws, DimensionsOfAPixelAreNotAligned) {
  constexpr int n = 16, trials = 4000;
  const auto s = sampler(GetParam(), {}, n);
  for (int other = 1; other < 5; ++other) {
    double squares = 0;
    for (int t = 0; t < trials; ++t) {
      double sum = 0;
      for (std::uint32_t i = 0; i < n; ++i) {
        s->start({t, 9}, i);
        const float x = s->pixel2D().x;
        float y = 0;
        for (int d = 0; d < other; ++d) y = s->get2D().x;
        sum += (x - 0.5F) * (y - 0.5F);
      }
      squares += sqr(sum / n);
    }
    // Independent: variance 1 / 144 per sample. Of n strata in random orders: n / (n - 1) times
    // that.
    EXPECT_LT(squares / trials * n * 144, 1.18) << other;
  }
}

TEST_P(SamplerLaws, NumbersDoNotDependOnTheOrderOfPixels) {
  const auto all = [](Sampler& s, Point2i pixel, std::uint32_t index) {
    s.start(pixel, index);
    std::vector<Point2> v = {s.pixel2D(), s.get2D(), {s.get1D(), s.get1D()}, {}, {}, {}};
    s.get2D(std::span(v).last(3));
    v.push_back(s.get2D());
    return v;
  };
  const auto a = sampler(GetParam());
  const auto b = a->clone();
  ASSERT_EQ(a->samplesPerPixel(), b->samplesPerPixel());
  std::vector<std::vector<Point2>> forth, back;
  for (int x = 0; x < 30; ++x)
    for (std::uint32_t i = 0; i < 20; ++i) forth.push_back(all(*a, {x, 7}, i));
  for (std::uint32_t i = 20; i-- > 0;)
    for (int x = 30; x-- > 0;) back.push_back(all(*b, {x, 7}, i));
  for (std::size_t k = 0; k < 600; ++k)
    EXPECT_EQ(forth[k], back[(19 - k % 20) * 30 + (29 - k / 20)]);
}

TEST_P(SamplerLaws, CommandLineCountWins) {
  for (const int n : {1, 4, 64, 4096}) EXPECT_EQ(sampler(GetParam(), {}, n)->samplesPerPixel(), n);
  for (const int n : {3, 7, 1000}) EXPECT_GE(sampler(GetParam(), {}, n)->samplesPerPixel(), n);
}

TEST_P(SamplerLaws, HugeCountsCostNothing) {
  const auto s = sampler(GetParam(), {}, 1000000000);
  EXPECT_GE(s->samplesPerPixel(), 1000000000);
  for (const std::uint32_t i : {0U, 999999999U, 0xffffffffU}) {
    s->start({-5, 100000}, i);
    for (int d = 0; d < 600; ++d) {
      const float u = s->get1D();
      ASSERT_TRUE(u >= 0 && u < 1);
    }
    std::vector<Point2> set(3000);
    s->get2D(set);
    for (const Point2& p : set) ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    s->get2D(std::span<Point2>());
  }
}

// Far out in every direction: pixels, samples, counts that are no power of two, seeds.
TEST_P(SamplerLaws, NumbersAreBelowOneEverywhereAndDiffer) {
  for (const int n : {1, 3, 16, 1000})
    for (const Point2i resolution : {Point2i(1), Point2i(1, 16384), Point2i(16384)}) {
      const auto s = test::make<Sampler>(GetParam(), {}, {~std::uint64_t{0}, n, resolution});
      std::set<std::pair<float, float>> seen;
      int drawn = 0;
      for (const Point2i pixel : {Point2i(0), resolution - 1, Point2i(-3), Point2i(65535, 65536)})
        for (const std::uint32_t index : {0U, 2U, 1U << 20U, (1U << 20U) + 1U, 3000000001U}) {
          s->start(pixel, index);
          for (int d = 0; d < 50; ++d, ++drawn) {
            const Point2 p = d == 0 ? s->pixel2D() : s->get2D();
            ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
            seen.insert({p.x, p.y});
          }
        }
      // A point of 2^48 is hardly drawn twice; of resolution 1 the last pixel is the first.
      const int distinct = resolution == Point2i(1) ? drawn * 3 / 4 : drawn;
      EXPECT_GE(static_cast<int>(seen.size()), distinct - 2) << n;
    }
}

TEST_P(SamplerLaws, SeedsOfTheRenderAndOfTheSceneGiveOtherNumbers) {
  const auto first = [&](const ParamList& list, std::uint64_t seed) {
    return draw(*sampler(GetParam(), list, 16, seed), {3, 4}, 2, 0, 16);
  };
  const auto plain = first({}, 0);
  EXPECT_EQ(plain, first({}, 0));
  EXPECT_NE(plain, first({}, 1));
  const ParamList five = {test::integers("seed", {5})};
  EXPECT_EQ(first(five, 0), first(five, 0));
  EXPECT_NE(first(five, 0), plain);
  EXPECT_NE(first(five, 0), first(five, 1));
  EXPECT_NE(first(five, 0), first({test::integers("seed", {-6})}, 0));
}

TEST_P(SamplerLaws, CountsBelowOneAreErrors) {
  for (const int n : {0, -1, -2000000000})
    for (const char* name : {"pixelsamples", "xsamples"})
      EXPECT_THROW(sampler(GetParam(), {test::integers(name, {n})}), Error) << name;
}

// Mean square error of the integrals of a smooth function and of a disk's corner, times n.
struct Errors {
  double smooth = 0, edge = 0;
};
Errors errors(const std::vector<std::vector<Point2>>& trials) {
  Errors e;
  for (const auto& points : trials) {
    double smooth = 0, edge = 0;
    for (const Point2& p : points) {
      smooth += std::exp(-p.x) * p.y;
      edge += lengthSquared(p) < 1;
    }
    const auto n = static_cast<double>(points.size());
    e.smooth += sqr(smooth / n - (1 - std::exp(-1)) / 2) * n / static_cast<double>(trials.size());
    e.edge += sqr(edge / n - std::numbers::pi / 4) * n / static_cast<double>(trials.size());
  }
  return e;
}

TEST_P(SamplerLaws, IntegratesBetterThanIndependentNumbers) {
  const bool random = GetParam() == "random";
  for (const int n : {16, 64}) {
    const auto s = sampler(GetParam(), {}, n);
    const auto independent = sampler("random", {}, n);
    for (int d = 0; d < 3; ++d) {
      std::vector<std::vector<Point2>> own, reference;
      for (int t = 0; t < 2000; ++t) {
        own.push_back(draw(*s, {t, d}, d, 0, static_cast<std::uint32_t>(n)));
        reference.push_back(draw(*independent, {t, 77}, 0, 0, static_cast<std::uint32_t>(n)));
      }
      const Errors e = errors(own), r = errors(reference);
      RecordProperty("smooth_" + std::to_string(n) + "_" + std::to_string(d),
                     std::to_string(e.smooth / r.smooth));
      RecordProperty("edge_" + std::to_string(n) + "_" + std::to_string(d),
                     std::to_string(e.edge / r.edge));
      EXPECT_LT(e.smooth / r.smooth, random ? 1.2 : 0.6) << n << " samples, dimension " << d;
      EXPECT_LT(e.edge / r.edge, random ? 1.2 : 0.9) << n << " samples, dimension " << d;
    }
  }
}

TEST_P(SamplerLaws, SetsIntegrateBetterThanIndependentNumbers) {
  if (GetParam() == "random") GTEST_SKIP() << "its sets are independent points";
  constexpr std::uint32_t count = 16;
  const auto s = sampler(GetParam(), {}, count);
  for (const std::size_t n : {std::size_t{4}, std::size_t{16}}) {
    std::vector<std::vector<Point2>> sets, pixels, reference;
    const auto independent = sampler("random", {}, count);
    for (int t = 0; t < 1000; ++t) {
      pixels.push_back(test::drawSets(*s, {t, 3}, n, count));
      sets.emplace_back(pixels.back().end() - static_cast<int>(n), pixels.back().end());
      reference.push_back(test::drawSets(*independent, {t, 3}, n, count));
    }
    const Errors r = errors(reference), set = errors(sets), pixel = errors(pixels);
    EXPECT_LT(set.smooth / r.smooth, 0.7) << n;
    EXPECT_LT(pixel.smooth / r.smooth, 0.5) << n;
    EXPECT_LT(pixel.edge / r.edge, 0.7) << n;
  }
}

}  // namespace
}  // namespace pbrt
