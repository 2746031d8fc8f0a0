// Independent uniform numbers.

#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

class RandomSampler final : public Sampler {
 public:
  RandomSampler(Params& p, const Setup& setup)
      : Sampler(setup.samplesPerPixel.value_or(count(p))), keys_(samplerSeed(p, setup)) {}

  std::unique_ptr<Sampler> clone() const override { return std::make_unique<RandomSampler>(*this); }
  void start(Point2i pixel, std::uint32_t index) override { keys_.start(pixel, index); }
  float get1D() override { return get2D().x; }
  Point2 get2D() override {
    keys_.nextDimension();
    return uniformPoint(keys_.sample());
  }

 private:
  static int count(Params& p) {
    constexpr int most = std::numeric_limits<int>::max();
    const int samples = p.integer("pixelsamples", 4, 1, most, "samples per pixel");
    const int x = p.integer("xsamples", samples, 1, most, "factor of the samples per pixel");
    const int y = p.integer("ysamples", 1, 1, most, "factor of the samples per pixel");
    if (x > most / y) p.fail("xsamples", "xsamples times ysamples is too large");
    return x * y;
  }

  SampleKeys keys_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::RandomSampler, "random",
            "independent random numbers: the simplest, and the noisiest")
