#include "core/parse/numbers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>

#include "core/base/rng.h"

namespace pbrt {
namespace {

template <class T>
std::vector<T> numbers(const std::string& text) {
  const Source source{"t", text};
  std::vector<T> values;
  readNumbers({&source, 0, text.size()}, values);
  return values;
}

// Every float, shortest or with any number of digits, must be what the C library reads.
TEST(Numbers, FloatsAreTheNearest) {
  Rng rng(1);
  std::string text;
  std::vector<float> expected;
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<float>(rng.bits());
    if (!std::isfinite(value)) continue;
    const int digits = static_cast<int>(rng.uniform(20));
    const std::string written =
        i % 3 == 0 ? fmt::format("{}", value) : fmt::format("{:.{}e}", value, digits);
    const float nearest = std::strtof(written.c_str(), nullptr);
    if (std::isinf(nearest)) continue;
    text += written + (i % 5 == 0 ? "\r\n\t" : " ");
    expected.push_back(nearest);
  }
  EXPECT_EQ(numbers<float>(text), expected);
}

// Decimal numbers half way between two floats and just beside it.
TEST(Numbers, TiesAreRoundedToEven) {
  EXPECT_EQ(numbers<float>("16777217 16777219 16777217.0000000000000000000000001"),
            (std::vector<float>{16777216, 16777220, 16777218}));
}

TEST(Numbers, TooSmallIsZeroAndSubnormalsAreKept) {
  const std::vector<float> values = numbers<float>("1e-46 -1e-400 1e-45 1.1754942e-38");
  EXPECT_EQ(values[0], 0);
  EXPECT_EQ(values[1], 0);
  EXPECT_EQ(values[2], std::numeric_limits<float>::denorm_min());
  EXPECT_GT(values[3], 0);
  EXPECT_EQ(numbers<double>("1e-400"), std::vector<double>{0});
}

TEST(Numbers, TheLargestAreIn) {
  EXPECT_EQ(numbers<float>("3.4028234e38"), std::vector{std::numeric_limits<float>::max()});
  EXPECT_THROW(numbers<float>("3.4028236e38"), Error);
  EXPECT_EQ(numbers<double>("1e300"), std::vector{1e300});
  EXPECT_THROW(numbers<double>("1e309"), Error);
}

TEST(Numbers, IntegersHoldAllOfTheirRange) {
  Rng rng(2);
  std::string text;
  std::vector<int> expected;
  for (int i = 0; i < 10000; ++i) {
    expected.push_back(static_cast<int>(rng.bits() >> rng.uniform(32U)));
    text +=
        i % 4 == 0 ? fmt::format("{}.0 ", expected.back()) : fmt::format("{}\n", expected.back());
  }
  EXPECT_EQ(numbers<int>(text), expected);
}

TEST(Numbers, AppendAfterWhatIsThere) {
  const Source source{"t", "xx 1 2 yy"};
  std::vector<int> values{7};
  readNumbers({&source, 2, 5}, values);
  EXPECT_EQ(values, (std::vector{7, 1, 2}));
}

TEST(Numbers, TheBadOneIsShown) {
  const Source source{"t", "1 2\n3 4x 5"};
  std::vector<float> values;
  try {
    readNumbers({&source, 0, source.text.size()}, values);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "t:2:3: error: 4x is not a number\n 2 | 3 4x 5\n   |   ^~");
  }
}

}  // namespace
}  // namespace pbrt
