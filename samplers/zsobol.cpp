// Owen-scrambled Sobol points that are dealt out to the pixels along Morton's curve (Ahmed and
// Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical
// Ordering of Pixels"). Each pixel has a net of its own, and so have each 2 x 2, 4 x 4, 8 x 8 ...
// pixels together: the errors of neighbours cancel, and what is left is fine grain.

#include "core/base/sobol.h"
#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

// Blocks of 2^7 by 2^7 pixels have a curve each: what is coarser than that is not seen as noise.
constexpr int kLevels = 7;
constexpr int kBlockMask = (1 << kLevels) - 1;

// The lower 8 bits of v with a zero bit above each.
constexpr std::uint32_t spreadBits(int v) {
  auto bits = static_cast<std::uint32_t>(v);
  bits = (bits | bits << 4U) & 0x0f0fU;
  bits = (bits | bits << 2U) & 0x3333U;
  return (bits | bits << 1U) & 0x5555U;
}

// The number of a pixel in its block, in which pairs of bits tell the quadrant of the block, the
// quadrant of that, and so on. The lower bit of a pair is x + y, see permuteQuarter().
constexpr std::uint32_t mortonIndex(Point2i pixel) {
  return spreadBits((pixel.x ^ pixel.y) & kBlockMask) | spreadBits(pixel.y & kBlockMask) << 1U;
}

// A random permutation of {0, 1, 2, 3}. On two bits all 24 are a linear map and a shift. The map is
// made of three steps, each taken or not, that add one bit to the other. So the upper bit, which
// tells the halves of the next finer order apart, becomes that of q in 3/8 of all cases, the lower
// one in 2/8, their sum in 3/8.
constexpr std::uint64_t permuteQuarter(std::uint64_t q, std::uint64_t random) {
  std::uint64_t upper = q >> 1U, lower = q & 1U;
  upper ^= lower & random;
  lower ^= upper & random >> 1U;
  upper ^= lower & random >> 2U;
  return (upper << 1U | lower) ^ (random >> 3U & 3U);
}

// Place `i` on a curve of 2^bits places, those of a quarter, of a quarter of that ... in random
// order: another order for each. An odd number of bits ends in a half.
constexpr std::uint64_t permutePlaces(std::uint64_t i, int bits, std::uint64_t key) {
  const auto random = [&](int below) {
    return mixBits(key ^ (i >> below << 6U | unsigned(below)));
  };
  const int half = bits % 2;
  std::uint64_t permuted = half ? (i ^ random(1)) & 1U : 0;
  for (int shift = half; shift < bits; shift += 2)
    permuted |= permuteQuarter(i >> shift & 3U, random(shift + 2)) << shift;
  return permuted;
}

class ZSobolSampler final : public Sampler {
 public:
  ZSobolSampler(Params& p, const Setup& setup)
      : Sampler(sampleCount(p, setup, 16)),
        keys_(samplerSeed(p, setup)),
        curve_(keys_),
        how_(randomization(p)),
        count_(static_cast<std::uint32_t>(samplesPerPixel())),
        bits_(std::bit_width(count_ - 1U)) {}

  std::unique_ptr<Sampler> clone() const override { return std::make_unique<ZSobolSampler>(*this); }

  // Samples beyond the last are dealt out once more, along another curve.
  void start(Point2i pixel, std::uint32_t index) override {
    keys_.start(pixel, index);
    curve_.start({pixel.x >> kLevels, pixel.y >> kLevels}, index / count_);
    morton_ = mortonIndex(pixel);
    index_ = index % count_;
  }

  // The samples fill one quarter of the pixel's places after another: a part is spread well, too.
  Point2 pixel2D() override {
    nextDimension();
    return point(index_, bits_);
  }

  float get1D() override { return get2D().x; }

  Point2 get2D() override {
    nextDimension();
    return point(shuffled(), bits_);
  }

  // A sample has a run of 2^k consecutive places on the curve, in any order.
  void get2D(std::span<Point2> points) override {
    const auto size = std::bit_ceil(static_cast<std::uint32_t>(points.size()));
    const int more = std::bit_width(size) - 1;
    if (bits_ + more > 32) return Sampler::get2D(points);
    nextDimension();
    const std::uint32_t run = shuffled() << more;
    const std::uint64_t order = keys_.sample();
    for (std::uint32_t i = 0; i < points.size(); ++i)
      points[i] = point(run | permute(i, size, order), bits_ + more);
  }

 private:
  void nextDimension() {
    keys_.nextDimension();
    curve_.nextDimension();
  }

  // The samples of the pixel in an order of this dimension's own, without any structure: see
  // lowdiscrepancy.cpp.
  std::uint32_t shuffled() const { return permute(index_, count_, keys_.pixel()); }

  // Of place `i` of the 2^bits that the pixel has on the curve.
  Point2 point(std::uint32_t i, int bits) const {
    const std::uint64_t key = curve_.sample();
    const std::uint64_t element =
        permutePlaces(std::uint64_t{morton_} << bits | i, bits + 2 * kLevels, key);
    // Bits from the 33rd on are too fine for the first coordinate; in the second they count as
    // those 32 places before them, since sobolSecond() adds over supersets.
    const std::uint32_t x = reverseBits(static_cast<std::uint32_t>(element));
    const std::uint32_t y =
        sobolSecond(x ^ reverseBits(static_cast<std::uint32_t>(element >> 32U)));
    return {uniformFloat(randomize(x, how_, mixBits(key + 1))),
            uniformFloat(randomize(y, how_, mixBits(key + 2)))};
  }

  SampleKeys keys_;   // of the pixel
  SampleKeys curve_;  // of the block: what orders and randomises its points
  Randomization how_;
  std::uint32_t count_;
  int bits_;  // of a sample's index
  std::uint32_t morton_ = 0, index_ = 0;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::ZSobolSampler, "zsobol",
            "Sobol points dealt out so that neighbouring pixels' errors cancel")
