// Halton's sequence: the radical inverse of the sample index in another prime base for every
// dimension, its digits scrambled anew for every pixel.

#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

constexpr std::size_t kBases = 256;

// A prime below 2^11, and what divides by it.
struct Base {
  std::uint32_t prime = 0;
  std::uint32_t factor = 0;  // 2^shift / prime, rounded up
  int shift = 0;
  double inverse = 0;

  // floor(v / prime) for v < 2^31: the factor is too large by less than 1 and shift >= 31 +
  // log2(prime), so the product is too large by less than 2^shift / prime
  // (Granlund and Montgomery 1994, theorem 4.2).
  std::uint32_t quotient(std::uint32_t v) const {
    return static_cast<std::uint32_t>(std::uint64_t{v} * factor >> shift);
  }
};

constexpr std::array<Base, kBases> makeBases() {
  std::array<Base, kBases> bases;
  std::size_t n = 0;
  for (std::uint32_t v = 2; n < kBases; ++v) {
    bool prime = true;
    for (std::size_t i = 0; i < n && sqr(bases[i].prime) <= v; ++i)
      prime &= v % bases[i].prime != 0;
    if (!prime) continue;
    const int shift = 31 + std::bit_width(v - 1);
    bases[n++] = {v, static_cast<std::uint32_t>(((std::uint64_t{1} << shift) + v - 1) / v), shift,
                  1.0 / v};
  }
  return bases;
}

constexpr std::array<Base, kBases> kBase = makeBases();

class HaltonSampler final : public Sampler {
 public:
  HaltonSampler(Params& p, const Setup& setup)
      : Sampler(sampleCount(p, setup, 16)),
        keys_(samplerSeed(p, setup)),
        how_(randomization(p)),
        atCentre_(p.flag("samplepixelcenter", false, "every sample at its pixel's centre")) {
    for (std::size_t i = 0; i < kBases; ++i)
      digits_[i] = static_cast<std::uint8_t>(digits(kBase[i], samplesPerPixel()));
  }

  std::unique_ptr<Sampler> clone() const override { return std::make_unique<HaltonSampler>(*this); }

  // Indices count modulo 2^31.
  void start(Point2i pixel, std::uint32_t index) override {
    keys_.start(pixel, index);
    // What is not randomised is another part of the sequence in every pixel all the same.
    if (how_ == Randomization::none) index += static_cast<std::uint32_t>(keys_.pixel());
    index_ = index & 0x7fffffffU;
    dimension_ = 0;
  }

  Point2 pixel2D() override {
    const Point2 p = get2D();
    return atCentre_ ? Point2(0.5F) : p;
  }

  float get1D() override {
    keys_.nextDimension();
    const std::size_t d = dimension_++;
    if (d >= kBases) return uniformPoint(keys_.sample()).x;
    return radicalInverse(d, digits_[d], index_, keys_.pixel());
  }

  Point2 get2D() override {
    const float x = get1D();
    return {x, get1D()};
  }

  // Sample i has elements i n to (i + 1) n of one sequence of points.
  void get2D(std::span<Point2> points) override {
    if (dimension_ + 2 > kBases) return Sampler::get2D(points);
    const std::size_t d = dimension_;
    dimension_ += 2;
    const auto n = static_cast<std::uint32_t>(points.size());
    const std::int64_t count = std::min(std::int64_t{samplesPerPixel()} * n, std::int64_t{1} << 31);
    const int digitsX = digits(kBase[d], count), digitsY = digits(kBase[d + 1], count);
    keys_.nextDimension();
    const std::uint64_t keyX = keys_.pixel();
    keys_.nextDimension();
    const std::uint64_t keyY = keys_.pixel();
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t index = (index_ * n + i) & 0x7fffffffU;
      points[i] = {radicalInverse(d, digitsX, index, keyX),
                   radicalInverse(d + 1, digitsY, index, keyY)};
    }
  }

 private:
  // How many digits number `count` samples.
  static int digits(const Base& base, std::int64_t count) {
    int n = 0;
    for (std::int64_t power = 1; power < count; power *= base.prime) ++n;
    return n;
  }

  // Owen's scrambling (1995): every digit goes through a random permutation that depends on the
  // digits before it. The permutations are affine, d -> a d + b mod p, which is as good as any:
  // the variance depends on the joint distribution of pairs only, and two different digits go to
  // every pair of different digits with the same probability (Matousek 1998, "On the
  // L2-Discrepancy for Anchored Boxes"). What follows the digits of the largest index is random.
  float radicalInverse(std::size_t dimension, int digits, std::uint32_t index,
                       std::uint64_t key) const {
    if (dimension == 0) return uniformFloat(randomize(reverseBits(index), how_, key));
    const Base& base = kBase[dimension];
    const std::uint32_t p = base.prime;
    std::int64_t reversed = 0;
    double scale = 1;
    for (std::uint32_t rest = index; digits > 0 || rest > 0; --digits) {
      const std::uint32_t next = base.quotient(rest);
      const std::uint32_t digit = rest - next * p;
      std::uint32_t permuted = digit;
      if (how_ != Randomization::none) {
        const auto a = 1 + scaleBits(static_cast<std::uint32_t>(key), p - 1);
        const auto b = scaleBits(static_cast<std::uint32_t>(key >> 32U), p);
        const std::uint32_t affine = a * digit + b;
        permuted = affine - base.quotient(affine) * p;
        key = mixBits(how_ == Randomization::owen ? key + digit : key);
      }
      reversed = reversed * p + permuted;
      scale *= base.inverse;
      rest = next;
    }
    const double tail =
        how_ == Randomization::none ? 0 : uniformFloat(static_cast<std::uint32_t>(key));
    return std::min(static_cast<float>((static_cast<double>(reversed) + tail) * scale),
                    kOneMinusEpsilon);
  }

  SampleKeys keys_;
  Randomization how_;
  bool atCentre_;
  std::array<std::uint8_t, kBases> digits_{};  // of samplesPerPixel() - 1, in each base
  std::uint32_t index_ = 0;
  std::size_t dimension_ = 0;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::HaltonSampler, "halton",
            "Halton's sequence: evenly spread for any number of samples")
