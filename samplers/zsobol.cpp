// Owen-scrambled Sobol points that are dealt out to the pixels along Morton's curve (Ahmed and
// Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical
// Ordering of Pixels"). Each pixel has a net of its own, and so have each 2 x 2, 4 x 4, 8 x 8 ...
// pixels together: the errors of neighbours cancel, and what is left is fine grain.

#include "core/base/sobol.h"
#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

// Blocks of 2^6 by 2^6 pixels have a curve each: what is coarser than that is not seen as noise.
constexpr int kLevels = 6;
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

// Permutations of {0, 1, 2, 3}, of which a random one is picked. On two bits all 24 are a linear
// map and a shift. The map is made of three steps, each taken or not, that add one bit to the
// other. So the upper bit, which tells the halves of the next finer order apart, becomes that of q
// in 3/8 of all cases, the lower one in 2/8, their sum in 3/8.
constexpr std::uint32_t permuteQuarter(std::uint32_t q, std::uint32_t which) {
  std::uint32_t upper = q >> 1U, lower = q & 1U;
  upper ^= lower & which;
  lower ^= upper & which >> 1U;
  upper ^= lower & which >> 2U;
  return (upper << 1U | lower) ^ which >> 3U;
}
using Permutations = std::array<std::array<std::uint8_t, 4>, 32>;
constexpr Permutations kPermutations = [] {
  Permutations all{};
  for (std::uint32_t which = 0; which < 32; ++which)
    for (std::uint32_t q = 0; q < 4; ++q)
      all[which][q] = static_cast<std::uint8_t>(permuteQuarter(q, which));
  return all;
}();

// Random numbers below 32 from hashes, another function of them for each key: any two of its values
// are independent (Dietzfelbinger 1996).
class Choice {
 public:
  explicit Choice(std::uint64_t key) : factor_(key | 1U), term_(mixBits(key)) {}
  std::uint32_t operator()(std::uint64_t h) const {
    return static_cast<std::uint32_t>((factor_ * h + term_) >> 59U);
  }

 private:
  std::uint64_t factor_, term_;
};

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
    for (int level = 0; level <= kLevels; ++level)
      quadrants_[level] = quadrant(morton_ >> 2 * (kLevels - level), level);
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

  static std::uint64_t quadrant(std::uint64_t number, int level) {
    return mixBits(number << 6U | static_cast<unsigned>(level));
  }

  // Which element of the block's part of the sequence is at place `i` of the 2^bits that the pixel
  // has on the curve: the quadrants of a quadrant, down to the pixel, the quarters of its places,
  // and of those, are in random order, another order for each. An odd number of bits ends in a
  // half.
  std::uint64_t element(std::uint32_t i, int bits, Choice choice) const {
    std::uint64_t e = 0;
    for (int level = 0; level < kLevels; ++level)
      e = e << 2U |
          kPermutations[choice(quadrants_[level])][morton_ >> 2 * (kLevels - 1 - level) & 3U];
    std::uint64_t h = quadrants_[kLevels];
    for (int level = kLevels; bits >= 2;
         h = quadrant(std::uint64_t{morton_} << 32U | i >> bits, ++level)) {
      bits -= 2;
      e = e << 2U | kPermutations[choice(h)][i >> bits & 3U];
    }
    return bits ? e << 1U | ((i ^ choice(h)) & 1U) : e;
  }

  Point2 point(std::uint32_t i, int bits) const {
    const std::uint64_t key = curve_.sample();
    const std::uint64_t e = element(i, bits, Choice(key));
    // Bits from the 33rd on are too fine for the first coordinate; in the second they count as
    // those 32 places before them, since sobolSecond() adds over supersets.
    const std::uint32_t x = reverseBits(static_cast<std::uint32_t>(e));
    const std::uint32_t y = sobolSecond(x ^ reverseBits(static_cast<std::uint32_t>(e >> 32U)));
    return {uniformFloat(randomize(x, how_, mixBits(key + 1))),
            uniformFloat(randomize(y, how_, mixBits(key + 2)))};
  }

  SampleKeys keys_;   // of the pixel
  SampleKeys curve_;  // of the block: what orders and randomises its points
  Randomization how_;
  std::uint32_t count_;
  int bits_;  // of a sample's index
  std::uint32_t morton_ = 0, index_ = 0;
  std::array<std::uint64_t, kLevels + 1> quadrants_{};  // hashes of those that hold the pixel
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::ZSobolSampler, "zsobol",
            "Sobol points dealt out so that neighbouring pixels' errors cancel")
