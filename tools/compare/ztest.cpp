#include "tools/compare/ztest.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace pbrt {

namespace {

constexpr std::array<int, 4> kSizes{1, 8, 32, 0};

// Of fewer samples than this, a few that happen to be alike pass for a sure mean too often.
constexpr int kLeastSamples = 16;

// What a picture says about a channel and its noise.
struct Side {
  const float* values = nullptr;
  const float* variances = nullptr;  // null: the picture is exact
  double samples = 0;                // per pixel
  double kappa = 1;                  // "filterNoise"

  // The n of 1 / n: an exact picture has infinitely many samples.
  double inverseSamples() const { return variances ? 1 / samples : 0; }
};

Side sideOf(const Image& image, const std::string& channel) {
  Side side;
  side.values = image.channel(channel)->data();
  const auto* variances = image.channel("Variance." + channel);
  const double samples = image.number("samplesPerPixel", 0);
  if (variances == nullptr || !(samples >= 2)) return side;
  side.variances = variances->data();
  side.samples = samples;
  side.kappa = image.number("filterNoise", 1);
  return side;
}

// Sums over the pixels of a block. With a filter wider than a pixel, the noise of neighbours is
// correlated: a pixel's variance is kappa s^2 / n, s^2 being the variance of a sample and n the
// samples per pixel, while the mean of P >> 1 pixels has the variance s^2 / (n P). For smaller
// blocks that is too much, which is safe; for one pixel we know better.
//
// The variance of the difference of two means is estimated in two ways, and the larger one counts.
// `separate`, s_a^2 / n_a + s_b^2 / n_b, fails where the picture of fewer samples missed the rare
// bright ones: its mean is too low, and so is its variance. `pooled` takes all samples as of one
// distribution, as they are if the pictures agree:
//   s^2 (1 / n_a + 1 / n_b),
//   s^2 = ((n_a - 1) s_a^2 + (n_b - 1) s_b^2 + d^2 / (1 / n_a + 1 / n_b)) / (n_a + n_b - 1);
// the difference d of the means is itself a measure of s^2, with one degree of freedom (the score
// test; Rao 1948). So a pixel has |z| <= sqrt(n_a + n_b - 1) even if all its samples of either
// picture happen to be equal. It fails where one rare sample of the picture of fewer samples is
// more than the many of the other explain; `separate` does not. If the reference is exact, n_a is
// infinite and s^2 is taken about its mean: ((n_b - 1) s_b^2 + n_b d^2) / n_b.
struct Sums {
  double difference = 0;
  double separate = 0, pooled = 0;
  double magnitude = 0;

  void add(const Side& a, const Side& b, std::size_t i, bool alone) {
    const double d = double{b.values[i]} - double{a.values[i]};
    double within = 0, freedom = a.variances && b.variances ? -1 : 0;
    for (const Side* s : {&a, &b}) {
      if (s->variances == nullptr) continue;
      const double variance = s->variances[i];
      // What is no variance makes z not a number, which fails.
      if (!(variance >= 0 && variance < kInfinity && s->kappa > 0 && s->kappa < kInfinity))
        separate = std::numeric_limits<double>::quiet_NaN();
      separate += alone ? variance : variance / s->kappa;
      within += (s->samples - 1) * s->samples * variance / s->kappa;
      freedom += s->samples;
    }
    const double between = sqr(d) / (a.kappa * a.inverseSamples() + b.kappa * b.inverseSamples());
    pooled += (within + between) / freedom *
              (alone ? a.kappa * a.inverseSamples() + b.kappa * b.inverseSamples()
                     : a.inverseSamples() + b.inverseSamples());
    difference += d;
    magnitude += std::max(std::abs(a.values[i]), std::abs(b.values[i]));
  }

  // Rounding is noise as well: it lets equal pictures agree that have no other. Between compilers
  // and machines it moves a pixel by up to some hundred units in the last place of a float.
  double z() const {
    constexpr double rounding = 1e-5;
    const double variance = std::max(separate, pooled) + sqr(rounding * magnitude);
    const double z = variance == 0 ? 0 : difference / std::sqrt(variance);
    return std::isnan(z) ? std::numeric_limits<double>::infinity() : z;
  }
};

// The chance that noise alone makes |z| as large.
double probability(double z) {
  return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

bool worse(const BlockZ& a, const BlockZ& b) {
  return std::abs(a.z) > std::abs(b.z);
}

// z of all blocks of a size (0: the whole picture), of which noise alone makes one fail with
// probability alpha at most.
ZScale testScale(const Image& reference, const Image& test,
                 const std::vector<std::string>& channels, int size, double alpha) {
  const Bounds2i& window = reference.window;
  ZScale scale{.size = size};
  const int step = size ? size : std::max(window.width(), window.height());
  std::size_t beyond = 0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const Side a = sideOf(reference, channels[c]), b = sideOf(test, channels[c]);
    if (size == 1 && std::max(a.inverseSamples(), b.inverseSamples()) * kLeastSamples > 1) continue;
    for (int y = 0; y < window.height(); y += step)
      for (int x = 0; x < window.width(); x += step) {
        Sums sums;
        for (int v = y; v < std::min(y + step, window.height()); ++v)
          for (int u = x; u < std::min(x + step, window.width()); ++u)
            sums.add(a, b, static_cast<std::size_t>(v) * window.width() + u, step == 1);
        const BlockZ block{window.lo + Point2i(x, y), static_cast<int>(c),
                           static_cast<float>(sums.z())};
        beyond += std::abs(block.z) > 3;
        if (scale.n++ == 0 || worse(block, scale.worst)) scale.worst = block;
        if (probability(block.z) <= alpha) scale.failures.push_back(block);
      }
  }
  if (scale.n) scale.beyond3 = static_cast<double>(beyond) / static_cast<double>(scale.n);

  // Of n blocks, the one with the k-th smallest probability, k from 0, fails if that is below
  // alpha / (n - k), and all before it failed (Holm 1979).
  std::sort(scale.failures.begin(), scale.failures.end(), worse);
  std::size_t k = 0;
  while (k < scale.failures.size() &&
         probability(scale.failures[k].z) <= alpha / static_cast<double>(scale.n - k))
    ++k;
  scale.failures.resize(k);
  return scale;
}

}  // namespace

bool ZTest::agree() const {
  return std::all_of(scales.begin(), scales.end(),
                     [](const ZScale& scale) { return scale.failures.empty(); });
}

std::optional<ZTest> zTest(const Image& reference, const Image& test, double alpha) {
  if (reference.window != test.window || reference.window.empty())
    throw Error("the pictures do not have the same pixels", Failure::usage);
  if (!(alpha > 0 && alpha < 1))
    throw Error(fmt::format("the chance of a false alarm must be between 0 and 1, not {}", alpha),
                Failure::usage);
  ZTest result{.referenceIsExact = true, .testIsExact = true};
  for (const std::string& name : reference.names) {
    if (test.channel(name) == nullptr) continue;
    const bool noisyReference = sideOf(reference, name).variances != nullptr;
    const bool noisyTest = sideOf(test, name).variances != nullptr;
    if (noisyReference) result.referenceIsExact = false;
    if (noisyTest) result.testIsExact = false;
    if (noisyReference || noisyTest) result.channels.push_back(name);
  }
  if (result.channels.empty()) return std::nullopt;

  // Each scale has an equal share of alpha, so that the many small blocks do not raise the limit
  // for the few large ones, which see a small bias best.
  for (std::size_t s = 0; s < kSizes.size(); ++s)
    result.scales[s] = testScale(reference, test, result.channels, kSizes[s],
                                 alpha / static_cast<double>(kSizes.size()));
  return result;
}

}  // namespace pbrt
