#include "core/api/lobes.h"
#include "core/plugin/plugin.h"

namespace pbrt {

namespace {

// The conductor without absorption that reflects r at normal incidence:
// r = ((eta - 1) / (eta + 1))^2, solved for eta. Black is no exception: it still mirrors towards
// grazing angles.
ApproximateConductorFresnel fromReflectance(const Spectrum& r) {
  const Spectrum root = glm::sqrt(glm::clamp(r, 0.F, 0.999F));
  return {(1.F + root) / (1.F - root), Spectrum(0)};
}

}  // namespace

class ShinyMetal final : public Material {
 public:
  explicit ShinyMetal(Params& p)
      : kr_(p.spectrumTexture("Kr", Spectrum(1), "reflectance of the mirror, seen frontally")),
        ks_(p.spectrumTexture("Ks", Spectrum(1), "reflectance of the gloss, seen frontally")),
        roughness_(
            p.floatTexture("roughness", 0.1F, "of the gloss; its Blinn exponent is 1 / roughness")),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    using Gloss = MicrofacetReflection<Blinn, ApproximateConductorFresnel>;
    using Mirror = SpecularReflection<ApproximateConductorFresnel>;
    bsdf.add(place<Gloss>(scratch, Spectrum(1), Blinn(roughness_(at)), fromReflectance(ks_(at))));
    bsdf.add(place<Mirror>(scratch, Spectrum(1), fromReflectance(kr_(at))));
  }
  bool filters() const override {
    return kr_.filters() || ks_.filters() || roughness_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> kr_, ks_;
  Textured<float> roughness_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::ShinyMetal, "shinymetal",
            "polished metal: a mirror with a glossy highlight about every lamp")
