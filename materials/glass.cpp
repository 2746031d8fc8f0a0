#include "core/api/lobes.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Glass final : public Material {
 public:
  explicit Glass(Params& p)
      : kr_(p.spectrumTexture("Kr", Spectrum(1), "scales the reflected light")),
        kt_(p.spectrumTexture("Kt", Spectrum(1), "scales the transmitted light")),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {
    const auto eta = p.optionalFloatTexture("eta", "another name of index, which it overrides");
    index_ = p.floatTexture("index", 1.5F,
                            "index of refraction on the side that the normal points away from, "
                            "over that of the other side");
    if (eta) index_ = *eta;
    if (!index_.texture() && !(index_({}) > 0)) p.fail(eta ? "eta" : "index", "must be above 0");
    for (const char* name : {"uroughness", "vroughness"}) {
      const auto roughness = p.floatTexture(name, 0, "must be 0: rough glass is not made yet");
      if (roughness.texture() || roughness({}) != 0)
        p.fail(name, "must be 0: this glass is smooth, rough glass is not made yet");
    }
    p.flag("remaproughness", true, "has no effect on smooth glass");
  }

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum kr = glm::max(kr_(at), 0.F), kt = glm::max(kt_(at), 0.F);
    float index = index_(at);
    if (!(index > 0)) index = 1;  // a texture's odd value: no boundary
    if (!isBlack(kr))
      bsdf.add(place<SpecularReflection<DielectricFresnel>>(scratch, kr, DielectricFresnel{index}));
    if (!isBlack(kt)) bsdf.add(place<SpecularTransmission>(scratch, kt, index));
  }
  bool filters() const override {
    return kr_.filters() || kt_.filters() || index_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> kr_, kt_;
  Textured<float> index_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Glass, "glass", "clear glass or water: it mirrors and refracts")
