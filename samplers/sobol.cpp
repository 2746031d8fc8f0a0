// Sobol's sequence in sets of four dimensions, Owen-scrambled anew for every pixel (Burley 2020,
// "Practical Hash-based Owen Scrambling"): the first four numbers of a sample are spread well as
// points of four dimensions, so are the next four, and sets are independent of each other.

#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

class SobolSampler final : public Sampler {
 public:
  SobolSampler(Params& p, const Setup& setup)
      : Sampler(sampleCount(p, setup, 16)),
        keys_(samplerSeed(p, setup)),
        how_(randomization(p)),
        count_(static_cast<std::uint32_t>(samplesPerPixel())) {}

  std::unique_ptr<Sampler> clone() const override { return std::make_unique<SobolSampler>(*this); }

  void start(Point2i pixel, std::uint32_t index) override {
    keys_.start(pixel, index);
    index_ = index;
    dimension_ = kSobolDimensions;
  }

  // The first set keeps the order of the sequence: any 2^k first samples are spread well.
  Point2 pixel2D() override {
    startSet();
    element_ = partOfPixel(index_);
    const float x = next();
    return {x, next()};
  }

  float get1D() override {
    if (dimension_ == kSobolDimensions) startShuffledSet();
    return next();
  }

  // Both of one set.
  Point2 get2D() override {
    if (dimension_ + 2 > kSobolDimensions) startShuffledSet();
    const float x = next();
    return {x, next()};
  }

  // A sample has 2^k consecutive elements of a set of its own, in any order.
  void get2D(std::span<Point2> points) override {
    const auto size = std::bit_ceil(static_cast<std::uint32_t>(points.size()));
    if (std::uint64_t{count_} * size > std::uint64_t{1} << 32U) return Sampler::get2D(points);
    startSet();
    const std::uint32_t run = shuffled() * size;
    const std::uint64_t order = keys_.sample();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const std::uint32_t element = partOfPixel(run + permute(i, size, order));
      points[i] = {coordinate(element, 0), coordinate(element, 1)};
    }
    dimension_ = kSobolDimensions;
  }

 private:
  void startSet() {
    keys_.nextDimension();
    dimension_ = 0;
  }
  void startShuffledSet() {
    startSet();
    element_ = partOfPixel(shuffled());
  }

  // The sample's index in another order of the pixel's samples, without any structure: see
  // lowdiscrepancy.cpp.
  std::uint32_t shuffled() const {
    const std::uint32_t place = index_ % count_;
    return index_ - place + permute(place, count_, keys_.pixel());
  }

  // Points that are not randomised are other ones in every pixel all the same.
  std::uint32_t partOfPixel(std::uint32_t element) const {
    if (how_ != Randomization::none) return element;
    return element ^ static_cast<std::uint32_t>(keys_.pixel() << std::bit_width(count_ - 1U));
  }

  float coordinate(std::uint32_t element, std::size_t dimension) const {
    const std::uint64_t key = mixBits(keys_.pixel() + dimension + 1);
    return uniformFloat(randomize(sobol(element, dimension), how_, key));
  }
  float next() {
    const std::size_t d = dimension_++;
    return coordinate(element_, d);
  }

  SampleKeys keys_;  // a dimension of theirs is a set here
  Randomization how_;
  std::uint32_t count_;
  std::uint32_t index_ = 0, element_ = 0;
  std::size_t dimension_ = 0;  // of the set, the next one
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::SobolSampler, "sobol",
            "Sobol's sequence, Owen-scrambled in every pixel, in sets of four dimensions")
