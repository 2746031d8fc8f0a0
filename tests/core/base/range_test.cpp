// Every function of ranges against the same in long double, which has 11 bits more, at random
// places of random ranges; and what is known by hand.

#include "core/base/range.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

using Long = long double;
constexpr double kInf = std::numeric_limits<double>::infinity();

// Thin ones and wide ones, on either side of zero and around it, from 1e-`decades` to 1e+`decades`.
class Random {
 public:
  explicit Random(double decades) : decades_(decades) {}

  Range range() {
    const double a = number();
    const float kind = rng_.uniform();
    if (kind < 0.2F) return a;
    const double b = kind < 0.5F ? a * (1 + 0.1 * rng_.uniform()) : number();
    return {std::min(a, b), std::max(a, b)};
  }
  double in(const Range& r) {
    const float u = rng_.uniform();
    if (u < 0.2F) return r.lo;
    if (u < 0.4F) return r.hi;
    return std::clamp(r.lo + rng_.uniform() * r.width(), r.lo, r.hi);
  }

 private:
  double number() {
    const double size = std::pow(10, decades_ * (2 * rng_.uniform() - 1));
    return rng_.uniform() < 0.5F ? -size : size;
  }
  double decades_;
  Rng rng_{3};
};

constexpr int kTrials = 1'000'000;

template <class OfRange, class OfLong>
void holdsBinary(OfRange ofRange, OfLong ofLong, double decades = 20) {
  Random random(decades);
  int failures = 0;
  for (int i = 0; i < kTrials; ++i) {
    const Range x = random.range(), y = random.range(), r = ofRange(x, y);
    const double a = random.in(x), b = random.in(y);
    const Long exact = ofLong(Long(a), Long(b));
    const double rounded = ofLong(a, b);
    if (!(r.lo <= exact && exact <= r.hi && r.contains(rounded)) && ++failures < 4)
      ADD_FAILURE() << "[" << x.lo << ", " << x.hi << "] and [" << y.lo << ", " << y.hi << "] at "
                    << a << ", " << b << ": " << exact << " is not in [" << r.lo << ", " << r.hi
                    << "]";
    // As narrow as rounding allows where nothing varies.
    if (x.lo == x.hi && y.lo == y.hi && std::isfinite(rounded) && r.bounded()) {
      EXPECT_LE(r.width(), 0x1p-51 * std::abs(rounded) + 0x1p-1019);
    }
  }
  EXPECT_EQ(failures, 0);
}

template <class OfRange, class OfLong>
void holdsUnary(OfRange ofRange, OfLong ofLong, double decades = 20, double ulps = 16) {
  Random random(decades);
  int failures = 0;
  for (int i = 0; i < kTrials; ++i) {
    const Range x = random.range(), r = ofRange(x);
    const double a = random.in(x);
    const Long exact = ofLong(Long(a));
    const double rounded = ofLong(a);
    if (std::isnan(exact)) continue;  // outside of the domain
    if (!(r.lo <= exact && exact <= r.hi && r.contains(rounded)) && ++failures < 4)
      ADD_FAILURE() << "[" << x.lo << ", " << x.hi << "] at " << a << ": " << exact
                    << " is not in [" << r.lo << ", " << r.hi << "]";
    if (x.lo == x.hi && r.bounded()) {
      EXPECT_LE(r.width(), ulps * 0x1p-52 * std::abs(rounded) + 0x1p-1019);
    }
  }
  EXPECT_EQ(failures, 0);
}

TEST(Range, HoldsSums) {
  holdsBinary([](Range x, Range y) { return x + y; }, [](auto x, auto y) { return x + y; });
  holdsBinary([](Range x, Range y) { return x - y; }, [](auto x, auto y) { return x - y; });
}
TEST(Range, HoldsProducts) {
  holdsBinary([](Range x, Range y) { return x * y; }, [](auto x, auto y) { return x * y; });
  holdsBinary([](Range x, Range y) { return x * y; }, [](auto x, auto y) { return x * y; }, 250);
}
TEST(Range, HoldsQuotients) {
  holdsBinary([](Range x, Range y) { return x / y; }, [](auto x, auto y) { return x / y; });
  holdsBinary([](Range x, Range y) { return x / y; }, [](auto x, auto y) { return x / y; }, 250);
}
TEST(Range, HoldsLeastAndMost) {
  holdsBinary([](Range x, Range y) { return min(x, y); },
              [](auto x, auto y) { return std::min(x, y); });
  holdsBinary([](Range x, Range y) { return max(x, y); },
              [](auto x, auto y) { return std::max(x, y); });
}
TEST(Range, HoldsPowers) {
  holdsUnary([](Range x) { return abs(x); }, [](auto x) { return std::abs(x); });
  holdsUnary([](Range x) { return sqr(x); }, [](auto x) { return x * x; });
  for (const int n : {0, 1, 2, 3, 4, 7, 10, -1, -2, -3})
    holdsUnary([&](Range x) { return pow(x, n); },
               [&](auto x) { return n < 0 ? 1 / power(x, -n) : power(x, n); }, 5, 32);
  holdsUnary([](Range x) { return sqrt(x); }, [](auto x) { return std::sqrt(x); });
}
TEST(Range, HoldsExponentials) {
  holdsUnary([](Range x) { return exp(x); }, [](auto x) { return std::exp(x); }, 2.5);
  holdsUnary([](Range x) { return log(x); }, [](auto x) { return std::log(x); }, 200);
}
TEST(Range, HoldsWaves) {
  for (const double decades : {1, 3, 18}) {
    const double ulps = decades > 9 ? kInf : 16;  // no better than [-1, 1] from 1e13 on
    holdsUnary([](Range x) { return sin(x); }, [](auto x) { return std::sin(x); }, decades, ulps);
    holdsUnary([](Range x) { return cos(x); }, [](auto x) { return std::cos(x); }, decades, ulps);
  }
}

// The extremes that lie between the ends.
TEST(Range, WavesTurnWhereTheyShould) {
  for (int k = -50; k <= 50; ++k) {
    const double turn = 2 * std::numbers::pi * k;
    const Range top = cos(Range(turn - 0.1, turn + 0.2));
    EXPECT_EQ(top.hi, 1);
    EXPECT_NEAR(top.lo, std::cos(0.2), 1e-12);
    const Range rising = sin(Range(turn - 1, turn + 1.5));
    EXPECT_NEAR(rising.lo, std::sin(-1.0), 1e-12);
    EXPECT_NEAR(rising.hi, std::sin(1.5), 1e-12);
    EXPECT_EQ(sin(Range(turn - 2, turn + 1)).lo, -1);
  }
}

TEST(Range, KeepsToTheDomain) {
  const Range root = sqrt(Range(-4, 4));
  EXPECT_EQ(root.lo, 0);
  EXPECT_NEAR(root.hi, 2, 1e-15);
  EXPECT_TRUE(sqrt(Range(-4, -1)).empty());
  EXPECT_TRUE(log(Range(-4, -1)).empty());
  EXPECT_EQ(log(Range(-4, 1)).lo, -kInf);
  EXPECT_EQ(sqr(Range(-3, 2)).lo, 0);
  EXPECT_EQ(abs(Range(-3, 2)).hi, 3);
  EXPECT_EQ(pow(Range(-1, 2), 4).lo, 0);
  EXPECT_LE(pow(Range(-2, 1), 3).lo, -8);
}

// What cannot be told is everything; what is nowhere stays nowhere.
TEST(Range, DoubtIsEverything) {
  const auto isAll = [](const Range& r) { return r.lo == -kInf && r.hi == kInf; };
  EXPECT_TRUE(isAll(1 / Range(-1, 1)));
  EXPECT_TRUE(isAll(1 / Range(0)));
  EXPECT_TRUE(isAll(Range::all() * Range(0)));
  EXPECT_TRUE(isAll(Range::all() / Range::all()));
  EXPECT_TRUE(isAll(Range::all() - Range::all()));
  EXPECT_TRUE(isAll(Range(1e200, 1e250) * Range::all()));
  const Range none = Range::none();
  for (const Range& r :
       {none + 1,      none * Range::all(), none / 2,     2 / none,     -none,
        abs(none),     sqr(none),           sqrt(none),   exp(none),    log(none),
        sin(none),     cos(none),           pow(none, 2), pow(none, 3), none - none,
        abs(none) + 1, min(none, 1),        min(1, none), max(none, 1), max(1, none)}) {
    EXPECT_TRUE(r.empty());
    EXPECT_FALSE(r.contains(0));
  }
}

// Overflow goes to infinity on the outside alone, underflow across zero.
TEST(Range, ExtremesStayOutside) {
  const Range huge = sqr(Range(1e200));
  EXPECT_EQ(huge.hi, kInf);
  EXPECT_LE(huge.lo, std::numeric_limits<double>::max());
  EXPECT_GT(huge.lo, 1e307);
  const Range tiny = Range(1e-200) * Range(-1e-200);
  EXPECT_LT(tiny.lo, 0);
  EXPECT_GT(tiny.lo, -1e-300);
  EXPECT_GE(tiny.hi, 0);
  const Range sum = huge + huge - huge;
  EXPECT_FALSE(sum.empty());
  EXPECT_TRUE(exp(Range(1000)).hi == kInf && exp(Range(-1000)).lo == 0);
}

}  // namespace
}  // namespace pbrt
