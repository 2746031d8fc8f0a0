// Sobol's (0,2)-sequence in every pair of dimensions: a pixel's samples lie one each in the boxes
// of every grid of 2^a by 2^b equal boxes that has as many boxes as there are samples.

#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

class LowDiscrepancySampler final : public Sampler {
 public:
  LowDiscrepancySampler(Params& p, const Setup& setup)
      : Sampler(count(p, setup)),
        keys_(samplerSeed(p, setup)),
        resolution_(std::bit_width(static_cast<unsigned>(samplesPerPixel())) - 1) {
    p.integer("dimensions", 4, 0, std::numeric_limits<int>::max(),
              "of no effect: every dimension is as good as the first");
  }

  std::unique_ptr<Sampler> clone() const override {
    return std::make_unique<LowDiscrepancySampler>(*this);
  }

  void start(Point2i pixel, std::uint32_t index) override {
    keys_.start(pixel, index);
    reversed_ = reverseBits(index);
    index_ = index & (static_cast<std::uint32_t>(samplesPerPixel()) - 1U);
    round_ = reverseBits(index - index_);
  }

  // Any 2^k first samples of a pixel are spread as well as all of them.
  Point2 pixel2D() override {
    keys_.nextDimension();
    const std::uint64_t key = keys_.pixel();
    return point(nestedScramble(reversed_, key), key, keys_.sample(), resolution_);
  }

  float get1D() override { return get2D().x; }

  Point2 get2D() override {
    keys_.nextDimension();
    const std::uint64_t key = keys_.pixel();
    return point(shuffled(key), key, keys_.sample(), resolution_);
  }

  // Every sample has a run of 2^k consecutive points of one sequence, in any order: the set and
  // all sets of the pixel together have the sequence's spread.
  void get2D(std::span<Point2> points) override {
    if (points.empty()) return;
    keys_.nextDimension();
    const auto size = static_cast<std::uint32_t>(std::bit_ceil(points.size()));
    const int log = std::bit_width(size) - 1;
    const std::uint64_t key = keys_.pixel(), order = keys_.sample();
    const std::uint32_t run = shuffled(key) >> log;
    std::uint64_t jitter = order;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      jitter = mixBits(jitter + i);
      points[i] = point(leading(permute(i, size, order), log) | run, key, jitter,
                        std::min(resolution_ + log, 31));
    }
  }

 private:
  static int count(Params& p, const Setup& setup) {
    constexpr int most = 1 << 30;
    const int scene =
        p.integer("pixelsamples", 16, 1, most, "samples per pixel, rounded up to a power of two");
    const int wanted = std::min(setup.samplesPerPixel.value_or(scene), most);
    const auto rounded = static_cast<int>(std::bit_ceil(static_cast<unsigned>(wanted)));
    if (rounded != wanted)
      p.warn("pixelsamples", "rounded up to the power of two " + std::to_string(rounded));
    return rounded;
  }

  // The lowest `bits` bits of v as the first of 32.
  static std::uint32_t leading(std::uint32_t v, int bits) {
    return static_cast<std::uint32_t>(std::uint64_t{v} << (32 - bits));
  }

  // The reversed index of the sample in another order of the pixel's samples. The order is random
  // through and through: if it kept pairs of samples together, as an order for which every
  // beginning is spread well must, the two would differ by one half in every dimension at once, and
  // estimates of products of dimensions would have a quarter more variance.
  std::uint32_t shuffled(std::uint64_t key) const {
    const auto count = static_cast<std::uint32_t>(samplesPerPixel());
    return leading(permute(index_, count, key), resolution_) | round_;
  }

  // The point of the sequence whose first coordinate is x, its digits shifted at random (Kollig
  // and Keller 2002, "Efficient Multidimensional Sampling", section 3). That lies on a lattice of
  // 2^-resolution; the jitter fills the cells, so that the estimate is unbiased. For smooth
  // integrands it is worth as much as Owen's scrambling, at less than half of its time.
  static Point2 point(std::uint32_t x, std::uint64_t key, std::uint64_t jitter, int resolution) {
    const std::uint64_t shift = key * 0x9e3779b97f4a7c15ULL;
    const auto shiftX = static_cast<std::uint32_t>(shift >> 32U);
    const auto shiftY = static_cast<std::uint32_t>(shift >> 8U) ^ static_cast<std::uint32_t>(key);
    const auto jitterX = static_cast<std::uint32_t>(jitter >> 32U);
    const auto jitterY = static_cast<std::uint32_t>(jitter);
    return {uniformFloat(x ^ shiftX ^ jitterX >> resolution),
            uniformFloat(sobolSecond(x) ^ shiftY ^ jitterY >> resolution)};
  }

  SampleKeys keys_;
  int resolution_;              // samplesPerPixel() is 2 to this power
  std::uint32_t reversed_ = 0;  // the sample's index, bits reversed
  std::uint32_t index_ = 0;     // modulo samplesPerPixel()
  std::uint32_t round_ = 0;     // the rest of it, reversed
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::LowDiscrepancySampler, "lowdiscrepancy",
            "evenly spread in every pair of dimensions, for a power of two of samples")
