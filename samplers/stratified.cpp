// Samples that are shared out evenly over the cells of a grid, in every dimension.

#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

class StratifiedSampler final : public Sampler {
 public:
  StratifiedSampler(Params& p, const Setup& setup) : StratifiedSampler(read(p), p, setup) {}

  std::unique_ptr<Sampler> clone() const override {
    return std::make_unique<StratifiedSampler>(*this);
  }

  void start(Point2i pixel, std::uint32_t index) override {
    keys_.start(pixel, index);
    round_ = index / count_ * 0xd1342543de82ef95ULL;
    cell_ = index % count_;
  }

  float get1D() override {
    keys_.nextDimension();
    return std::min((cell() + offset().x) * cellWidth_, kOneMinusEpsilon);
  }

  Point2 get2D() override {
    keys_.nextDimension();
    return strata_.point(cell(), offset());
  }

  // One point in each cell of a grid for the set, and there in the cells of the pixel's grid, one
  // after the other: both the set and all the samples together are stratified.
  void get2D(std::span<Point2> points) override {
    if (points.empty()) return;
    const auto count = static_cast<std::uint32_t>(points.size());
    const Strata set(squarest(count));
    const std::uint64_t order = mixBits(keys_.sample());
    for (std::uint32_t i = 0; i < count; ++i)
      points[permute(i, count, order)] = set.point(i, get2D());
  }

 private:
  static Point2i read(Params& p) {
    constexpr int most = std::numeric_limits<int>::max();
    const Point2i g{p.integer("xsamples", 4, 1, most, "cells across a pixel"),
                    p.integer("ysamples", 4, 1, most, "cells down a pixel")};
    if (g.x > most / g.y) p.fail("xsamples", "xsamples times ysamples is too large");
    return g;
  }

  StratifiedSampler(Point2i scene, Params& p, const Setup& setup)
      : Sampler(setup.samplesPerPixel.value_or(scene.x * scene.y)),
        keys_(samplerSeed(p, setup)),
        strata_(setup.samplesPerPixel ? squarest(static_cast<std::uint32_t>(*setup.samplesPerPixel))
                                      : scene),
        count_(static_cast<std::uint32_t>(samplesPerPixel())),
        cellWidth_(1.F / static_cast<float>(count_)),
        jitter_(p.flag("jitter", true, "a random place within the cell, not its centre")) {
    p.integer("dimensions", 4, 0, std::numeric_limits<int>::max(),
              "of no effect: every dimension is stratified");
  }

  // Which cell the sample takes in this dimension; new ones are shuffled once all are used up.
  std::uint32_t cell() const { return permute(cell_, count_, keys_.pixel() ^ round_); }
  Point2 offset() const { return jitter_ ? uniformPoint(keys_.sample()) : Point2(0.5F); }

  SampleKeys keys_;
  Strata strata_;
  std::uint32_t count_;
  float cellWidth_;
  bool jitter_;
  std::uint64_t round_ = 0;  // bits that change the shuffle each time all cells are used up
  std::uint32_t cell_ = 0;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::StratifiedSampler, "stratified", "one jittered sample in each grid cell")
