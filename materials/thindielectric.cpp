#include "core/api/lobes.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class ThinDielectric final : public Material {
 public:
  explicit ThinDielectric(Params& p)
      : pane_{p.refractiveIndex("eta", 1.5F, "index of refraction of the pane")},
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& /*at*/, Bsdf& bsdf, Scratch& scratch) const override {
    bsdf.add(place<SpecularReflection<PaneFresnel>>(scratch, Spectrum(1), pane_));
    bsdf.add(place<StraightTransmission<PaneFresnel>>(scratch, Spectrum(1), pane_));
  }
  bool filters() const override { return bump_ && bump_->filters(); }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  PaneFresnel pane_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::ThinDielectric, "thindielectric",
            "a window pane as a single surface: it mirrors, and light goes straight on")
