#include "core/api/lobes.h"
#include "core/plugin/plugin.h"
#include "core/plugin/roughness_params.h"

namespace pbrt {

class Plastic final : public Material {
 public:
  explicit Plastic(Params& p)
      : kd_(p.spectrumTexture("Kd", Spectrum(0.25F), "diffuse reflectance")),
        ks_(p.spectrumTexture("Ks", Spectrum(0.25F), "scales the glossy reflection")),
        roughness_(p.floatTexture("roughness", 0.1F, "0 is the sharpest highlight")),
        map_(p),
        facets_(p),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum kd = glm::max(kd_(at), 0.F), ks = glm::max(ks_(at), 0.F);
    if (!isBlack(kd)) bsdf.add(place<Lambertian>(scratch, kd));
    if (isBlack(ks)) return;
    // pbrt-v1 and v2 take the denser medium for the incident side, so that the facets reflect
    // totally beyond the critical angle; pictures of plastic agree with theirs only so.
    const TwoSidedFresnel fresnel{facets_.blinn() ? 1 / 1.5F : 1.5F};
    facets_.with(Vec2(roughness_(at)), map_, [&]<class Distribution>(const Distribution& facets) {
      using Gloss = MicrofacetReflection<Distribution, TwoSidedFresnel>;
      bsdf.add(place<Gloss>(scratch, ks, facets, fresnel));
    });
  }
  bool filters() const override {
    return kd_.filters() || ks_.filters() || roughness_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> kd_, ks_;
  Textured<float> roughness_;
  RoughnessMap map_;
  Facets facets_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Plastic, "plastic",
            "a coloured, dull body with white glossy highlights")
