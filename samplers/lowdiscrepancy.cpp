// Sobol's (0,2)-sequence in every pair of dimensions: any 2^k first samples of a pixel lie one
// each in the boxes of every grid of 2^a by 2^(k - a) equal boxes.

#include "core/base/lowdiscrepancy.h"

#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

class LowDiscrepancySampler final : public Sampler {
 public:
  LowDiscrepancySampler(Params& p, const Setup& setup)
      : Sampler(count(p, setup)),
        keys_(setup.seed),
        resolution_(std::bit_width(static_cast<unsigned>(samplesPerPixel())) - 1) {
    p.integer("dimensions", 4, 0, std::numeric_limits<int>::max(),
              "of no effect: every dimension is as good as the first");
  }

  std::unique_ptr<Sampler> clone() const override {
    return std::make_unique<LowDiscrepancySampler>(*this);
  }

  void start(Point2i pixel, std::uint32_t index) override {
    keys_.start(pixel, index);
    index_ = index;
    reversed_ = reverseBits(index);
  }

  float get1D() override { return get2D().x; }

  Point2 get2D() override {
    keys_.nextDimension();
    return point(reversed_, keys_.pixel(), keys_.sample(), resolution_);
  }

  // Sample i has points i n to (i + 1) n of one sequence, with n a power of two.
  void get2D(std::span<Point2> points) override {
    if (points.empty()) return;
    keys_.nextDimension();
    const int log = std::bit_width(points.size() - 1);
    const int resolution = std::min(resolution_ + log, 31);
    const std::uint64_t shuffle = keys_.pixel();
    std::uint64_t jitter = keys_.sample();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      points[i] = point(reverseBits((index_ << log) + i), shuffle, jitter, resolution);
      jitter = mixBits(jitter + i);
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

  // A shuffle of the indices decorrelates the dimensions, a random shift of the digits the pixels
  // (Kollig and Keller 2002, "Efficient Multidimensional Sampling", section 3). The whole lies on
  // a lattice of 2^-resolution; a random rest below it makes the estimate unbiased and is worth
  // as much for smooth integrands as Owen's scrambling, at a third of its time.
  static Point2 point(std::uint32_t reversedIndex, std::uint64_t key, std::uint64_t jitter,
                      int resolution) {
    const std::uint32_t x = nestedScramble(reversedIndex, key);
    const std::uint64_t shift = key * 0x9e3779b97f4a7c15ULL;
    const auto shiftX = static_cast<std::uint32_t>(shift >> 32U);
    const auto shiftY = static_cast<std::uint32_t>(shift >> 8U) ^ static_cast<std::uint32_t>(key);
    return {uniformFloat(x ^ shiftX ^ static_cast<std::uint32_t>(jitter) >> resolution),
            uniformFloat(sobolSecond(x) ^ shiftY ^
                         static_cast<std::uint32_t>(jitter >> 32U) >> resolution)};
  }

  SampleKeys keys_;
  int resolution_;  // samplesPerPixel() is 2 to this power
  std::uint32_t index_ = 0, reversed_ = 0;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::LowDiscrepancySampler, "lowdiscrepancy",
            "a shuffled (0,2)-sequence in every pair of dimensions")
