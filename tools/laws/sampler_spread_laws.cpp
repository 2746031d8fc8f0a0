// The laws of every sampler: its numbers as chance variables.

#include <array>
#include <cmath>
#include <numbers>

#include "chi_square.h"
#include "sampler_laws.h"
#include "show.h"

namespace pbrt::laws {
namespace {

// Fair numbers exceed it once in 300000 tests.
constexpr double kDeviations = 4.5;

std::size_t cell(float u, int n) {
  return static_cast<std::size_t>(u * static_cast<float>(n));
}

// The two squares that hold a pair of points, of 4 x 4: sixteen times sixteen cells.
std::size_t jointCell(Point2 a, Point2 b) {
  return (cell(a.x, 4) * 4 + cell(a.y, 4)) * 16 + cell(b.x, 4) * 4 + cell(b.y, 4);
}

template <class... Args>
void expectUniform(Judge& judge, std::span<const double> counts, fmt::format_string<Args...> what,
                   Args&&... args) {
  const double deviation = uniformDeviation(counts);
  judge.expect(deviation < kDeviations,
               "{}: the counts in {} equal cells are {:.1f} standard deviations off even ones "
               "(chi-square; chance alone hardly exceeds {})",
               fmt::format(what, std::forward<Args>(args)...), counts.size(), deviation,
               kDeviations);
}

// Whether a number can be counted; else the law ends.
template <class T>
bool countable(Judge& judge, T u, std::string_view what, Point2i pixel, std::uint32_t index) {
  return judge.expect(inUnit(u), "{} of sample {} of pixel ({}, {}) is not in [0, 1)", what, index,
                      pixel.x, pixel.y);
}

// Two-dimensional number `d` (0: the place in the pixel) of the samples of a pixel.
std::vector<Point2> drawPoints(Sampler& s, Point2i pixel, int d, int n) {
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i) {
    s.start(pixel, static_cast<std::uint32_t>(i));
    Point2 p = s.pixel2D();
    for (int k = 0; k < d; ++k) p = s.get2D();
    points.push_back(p);
  }
  return points;
}

// Mean square errors of the integrals of a smooth function and of a disk's corner, over those of
// independent points: the variance of the function by the number of points.
struct Errors {
  double smooth = 0, edge = 0;

  void add(std::span<const Point2> points) {
    const double mean = (1 - std::exp(-1)) / 2, corner = std::numbers::pi / 4;
    double smoothSum = 0, edgeSum = 0;
    for (const Point2& p : points) {
      smoothSum += std::exp(-p.x) * p.y;
      edgeSum += lengthSquared(p) < 1;
    }
    const auto n = static_cast<double>(points.size());
    smooth += sqr(smoothSum / n - mean) * n / ((1 - std::exp(-2)) / 6 - sqr(mean));
    edge += sqr(edgeSum / n - corner) * n / (corner * (1 - corner));
  }
};

void expectErrors(Judge& judge, const Errors& sum, int trials, double smooth, double edge,
                  const std::string& what) {
  const auto expectError = [&](double error, double most, const char* function) {
    judge.expect(error / trials < most,
                 "{}: the mean square error of the integral of {} is {:.2f} times that of "
                 "independent points; it should be below {}",
                 what, function, error / trials, most);
  };
  expectError(sum.smooth, smooth, "exp(-x) y");
  expectError(sum.edge, edge, "a quarter of a disk");
}

}  // namespace

// One sample of each pixel: independent draws, whatever the pattern within a pixel.
void samplesAreUniform(const Subject& subject, Judge& judge) {
  const auto s = makeSampler(subject, 16);
  for (const std::uint32_t index : {0U, 5U, 15U, 16U, 1000U, 1500000000U})
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
          if (!countable(judge, u, "a number", {x, y}, index)) return;
          if (!countable(judge, p, "a point", {x, y}, index)) return;
          ++line[cell(u, 64)];
          ++square[cell(p.x, 16) * 16 + cell(p.y, 16)];
          sum += u;
        }
      expectUniform(judge, line, "get1D() after {} points of sample {}", d + 1, index);
      expectUniform(judge, square, "point {} of sample {}", d, index);
      const double mean = sum / (side * side);
      judge.expect(std::abs(mean - 0.5) < kDeviations * std::sqrt(1.0 / 12) / side,
                   "get1D() after {} points of sample {}: the mean over {} pixels is {}, not 1/2",
                   d + 1, index, side * side, mean);
    }
}

void setsAreUniform(const Subject& subject, Judge& judge) {
  for (const std::size_t n : {std::size_t{1}, std::size_t{3}, std::size_t{16}}) {
    const auto s = makeSampler(subject, 8);
    std::vector<std::vector<double>> counts(n, std::vector<double>(64));
    std::vector<Point2> points(n);
    for (int x = 0; x < 20000; ++x) {
      s->start({x, 1}, 5);
      s->pixel2D();
      s->get2D(points);
      for (std::size_t i = 0; i < n; ++i) {
        if (!countable(judge, points[i], "a point of a set", {x, 1}, 5)) return;
        ++counts[i][cell(points[i].x, 8) * 8 + cell(points[i].y, 8)];
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      expectUniform(judge, counts[i], "point {} of sets of {}", i, n);
  }
}

void dimensionsAndPixelsAreIndependent(const Subject& subject, Judge& judge) {
  const auto s = makeSampler(subject, 16), other = makeSampler(subject, 16, 1);
  for (const std::uint32_t index : {0U, 3U, 11U}) {
    std::vector<double> dimensions(256), far(256), neighbours(256), seeds(256);
    Point2 left(0);
    for (int x = 0; x < 40000; ++x) {
      s->start({x, 2}, index);
      const Point2 a = s->pixel2D(), b = s->get2D();
      Point2 c;
      for (int d = 0; d < 5; ++d) c = s->get2D();
      other->start({x, 2}, index);
      const Point2 o = other->pixel2D();
      for (const Point2& p : {a, b, c, o})
        if (!countable(judge, p, "a point", {x, 2}, index)) return;
      ++dimensions[jointCell(a, b)];
      ++far[jointCell(b, c)];
      ++seeds[jointCell(a, o)];
      if (x % 2) ++neighbours[jointCell(left, a)];
      left = a;
    }
    expectUniform(judge, dimensions, "points 0 and 1 of sample {} together", index);
    expectUniform(judge, far, "points 1 and 6 of sample {} together", index);
    expectUniform(judge, neighbours, "sample {} of a pixel and of the next together", index);
    expectUniform(judge, seeds, "sample {} of seeds 0 and 1 together", index);
  }
}

// The estimate of a product of two dimensions is not worse than with independent numbers.
void dimensionsAreNotAligned(const Subject& subject, Judge& judge) {
  constexpr int n = 16, trials = 4000;
  // Independent: variance 1 / 144 per sample. Of n strata in random orders: n / (n - 1) times that.
  constexpr double most = 1.18;
  const auto s = makeSampler(subject, n);
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
    const double variance = squares / trials * n * 144;
    judge.expect(
        variance < most,
        "points 0 and {}, over the {} samples of a pixel: the variance of the mean of x x' "
        "is {:.2f} times that of independent numbers; more than {} means that one "
        "dimension repeats the pattern of the other",
        other, n, variance, most);
  }
}

void samplesAreWellSpread(const Subject& subject, Judge& judge) {
  constexpr int trials = 2000;
  const bool spread = !subject.traits.independentNumbers;
  for (const int n : {16, 64}) {
    const auto s = makeSampler(subject, n);
    for (int d = 0; d < 3; ++d) {
      Errors sum;
      for (int t = 0; t < trials; ++t) sum.add(drawPoints(*s, {t, d}, d, n));
      expectErrors(judge, sum, trials, spread ? 0.6 : 1.2, spread ? 0.9 : 1.2,
                   fmt::format("points {} of the {} samples of a pixel", d, n));
    }
  }
}

void setsAreWellSpread(const Subject& subject, Judge& judge) {
  if (subject.traits.independentNumbers) return judge.skip("its sets are independent points");
  constexpr std::size_t count = 16;
  constexpr int trials = 1000;
  const auto s = makeSampler(subject, count);
  for (const std::size_t n : {std::size_t{4}, std::size_t{16}}) {
    Errors set, pixel;
    std::vector<Point2> points(n * count);
    for (int t = 0; t < trials; ++t) {
      for (std::size_t i = 0; i < count; ++i) {
        s->start({t, 3}, static_cast<std::uint32_t>(i));
        s->pixel2D();
        s->get1D();
        s->get2D(std::span(points).subspan(i * n, n));
      }
      set.add(std::span(points).last(n));
      pixel.add(points);
    }
    constexpr double any = std::numeric_limits<double>::infinity();
    expectErrors(judge, set, trials, 0.7, any, fmt::format("a set of {} points", n));
    expectErrors(judge, pixel, trials, 0.5, 0.7,
                 fmt::format("the sets of {} points of all {} samples of a pixel", n, count));
  }
}

}  // namespace pbrt::laws
