// Derivatives against differences in long double, ranges of them against samples.

#include "core/base/dual.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

using Long = Dual<long double, 3>;

// Each function of Dual, alone and in company, smooth over [0.3, 1.7]^3.
const auto kFormulas = std::tuple{
    [](auto x, auto y, auto z) { return x + y - z; },
    [](auto x, auto y, auto z) { return 2 + x - 3 + 1 - y + z * 0.5 + 3 * x - (-y) / 4; },
    [](auto x, auto y, auto z) { return x * y * z; },
    [](auto x, auto y, auto z) { return x / y + 2 / z; },
    [](auto x, auto y, auto z) { return sqr(x + y) * sqr(z); },
    [](auto x, auto y, auto z) { return pow(x, 5) * pow(y, -2) + pow(z, 1) + pow(x, 0); },
    [](auto x, auto y, auto z) { return sqrt(x * y + z); },
    [](auto x, auto y, auto z) { return exp(x - y * z); },
    [](auto x, auto y, auto z) { return log(x + 2 * y) / z; },
    [](auto x, auto y, auto z) { return sin(3 * x) * cos(2 * y) + sin(z); },
    [](auto x, auto y, auto z) {
      auto f = x;
      f += y, f *= z, f -= 1, f /= x;
      return f;
    }};
// With kinks within it.
const auto kKinked =
    std::tuple{[](auto x, auto y, auto z) { return abs(x - y) + z; },
               [](auto x, auto y, auto z) { return min(x, y * z) + max(x, 0.9) * z; },
               [](auto x, auto y, auto z) { return max(min(x, y), 1 - abs(z - 1)); }};

template <class F>
void eachOf(const auto& formulas, const F& test) {
  std::apply([&](const auto&... f) { (test(f), ...); }, formulas);
}

template <class S>
std::array<Dual<S>, 3> variables(const std::array<S, 3>& p) {
  return {{{p[0], {1, 0, 0}}, {p[1], {0, 1, 0}}, {p[2], {0, 0, 1}}}};
}

TEST(Dual, SlopesAreThoseOfDifferences) {
  Rng rng(5);
  eachOf(kFormulas, [&](const auto& f) {
    for (int trial = 0; trial < 1000; ++trial) {
      std::array<double, 3> p;
      for (double& x : p) x = 0.3 + 1.4 * rng.uniform();
      const auto [x, y, z] = variables(p);
      const Dual<double> at = f(x, y, z);
      const long double h = 1e-6L;
      for (int i = 0; i < 3; ++i) {
        const auto moved = [&](long double by) {
          Long q[3] = {p[0], p[1], p[2]};
          q[i].v += by;
          return f(q[0], q[1], q[2]).v;
        };
        const long double slope = (moved(h) - moved(-h)) / (2 * h);
        EXPECT_NEAR(at.d[i], static_cast<double>(slope), 1e-9 * (1 + std::abs(at.d[i])));
      }
      EXPECT_NEAR(at.v, static_cast<double>(f(Long(p[0]), Long(p[1]), Long(p[2])).v),
                  1e-13 * (1 + std::abs(at.v)));
    }
  });
}

TEST(Dual, SecondSlopesAreThoseOfTheFirst) {
  Rng rng(6);
  eachOf(kFormulas, [&](const auto& f) {
    for (int trial = 0; trial < 100; ++trial) {
      std::array<double, 3> p;
      for (double& x : p) x = 0.3 + 1.4 * rng.uniform();
      const auto [x, y, z] = variables(p);
      using T = Dual<Dual<double>>;
      const T at = f(T(x, {1, 0, 0}), T(y, {0, 1, 0}), T(z, {0, 0, 1}));
      const double h = 1e-5;
      for (int i = 0; i < 3; ++i) {
        const auto moved = [&](double by) {
          std::array<double, 3> q = p;
          q[i] += by;
          const auto [qx, qy, qz] = variables(q);
          return f(qx, qy, qz);
        };
        const Dual<double> up = moved(h), down = moved(-h);
        for (int j = 0; j < 3; ++j) {
          EXPECT_NEAR(at.d[i].d[j], (up.d[j] - down.d[j]) / (2 * h),
                      1e-5 * (1 + std::abs(at.d[i].d[j])));
          EXPECT_NEAR(at.d[i].d[j], at.d[j].d[i], 1e-9 * (1 + std::abs(at.d[i].d[j])));
        }
      }
    }
  });
}

TEST(Dual, RangesHoldValuesAndSlopes) {
  Rng rng(7);
  const auto test = [&](const auto& f) {
    int bounded = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      std::array<Range, 3> box;
      for (Range& r : box) {
        r.lo = 0.3 + 1.4 * rng.uniform();
        r.hi = r.lo + 0.3 * rng.uniform();
      }
      const auto [X, Y, Z] = variables(box);
      const Dual<Range> range = f(X, Y, Z);
      bounded += range.v.bounded();
      for (int sample = 0; sample < 10; ++sample) {
        std::array<double, 3> p;
        for (int i = 0; i < 3; ++i) p[i] = box[i].lo + rng.uniform() * box[i].width();
        const auto [x, y, z] = variables(p);
        const Dual<double> at = f(x, y, z);
        EXPECT_TRUE(range.v.contains(at.v));
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(range.d[i].contains(at.d[i]));
      }
    }
    EXPECT_EQ(bounded, 2000);
  };
  eachOf(kFormulas, test);
  eachOf(kKinked, test);
}

// At a kink both slopes, beside it one.
TEST(Dual, KinksHaveBothSlopes) {
  using T = Dual<Range, 1>;
  const auto slope = [](const T& f) { return f.d[0]; };
  const T about({-0.1, 0.2}, {1}), beside({0.1, 0.2}, {1});
  EXPECT_LE(slope(abs(about)).lo, -1);
  EXPECT_GE(slope(abs(about)).hi, 1);
  EXPECT_GT(slope(abs(beside)).lo, 0.999);
  EXPECT_EQ(abs(about).v.lo, 0);
  EXPECT_TRUE(slope(min(about, 0)).contains(0) && slope(min(about, 0)).contains(1));
  EXPECT_EQ(slope(max(beside, -1)).lo, 1);
}

// Where a formula has a pole, or ends, the slope has no bound.
// Neither of two has a value where one has none.
TEST(Dual, LeastAndMostHaveNoValueWithoutBoth) {
  using D = Dual<double, 1>;
  const D x(2, {1}), none = sqrt(D(-1, {1}));
  for (const D& f : {min(x, none), min(none, x), max(x, none), max(none, x)})
    EXPECT_TRUE(std::isnan(f.v));
  using T = Dual<Range, 1>;
  const T about({-1, 1}, {1}), root = 5 + sqrt(about);
  for (const T& f : {min(about, root), min(root, about), max(-about, -root), max(-root, -about)})
    EXPECT_FALSE(f.d[0].bounded());
}

TEST(Dual, SlopesAreUnboundedWhereNothingIsProven) {
  using T = Dual<Range, 1>;
  const T x({-0.1, 0.2}, {1});
  for (const T& f : {1 / x, sqrt(x), log(x), 1 / x - 5 * x, max(-5, min(5, 1 / x)), exp(1 / x)})
    EXPECT_FALSE(f.d[0].bounded());
}

}  // namespace
}  // namespace pbrt
