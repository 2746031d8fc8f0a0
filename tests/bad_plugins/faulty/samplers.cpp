// The middle of every pixel; fails in one sample of one pixel.

#include "fault.h"

namespace pbrt {

class FaultySampler final : public Sampler {
 public:
  FaultySampler(Params& p, const Setup& setup)
      : Sampler(
            setup.samplesPerPixel.value_or(p.integer("pixelsamples", 1, 1, 1 << 20, "a pixel"))),
        fault_(std::make_shared<Fault>(p)),
        pixel_(p.integers("pixel", "the pixel that fails: x and y")),
        index_(p.integer("sample", 0, 0, 1 << 20, "the sample that does")) {}
  std::unique_ptr<Sampler> clone() const override { return std::make_unique<FaultySampler>(*this); }
  void start(Point2i pixel, std::uint32_t index) override {
    const bool hit = pixel_.empty() || pixel == Point2i(pixel_[0], pixel_[1]);
    fails_ = hit && static_cast<int>(index) == index_;
  }
  float get1D() override { return 0.5F * (fails_ ? fault_->number(0) : 1); }
  Point2 get2D() override { return Point2(get1D()); }

 private:
  std::shared_ptr<Fault> fault_;
  std::vector<int> pixel_;
  int index_;
  bool fails_ = false;
};

}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::FaultySampler, "faulty", "a sampler that fails")
