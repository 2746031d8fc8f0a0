#include "core/api/lobes.h"
#include "core/plugin/index_params.h"
#include "core/plugin/plugin.h"
#include "core/plugin/roughness_params.h"

namespace pbrt {

class Uber final : public Material {
 public:
  explicit Uber(Params& p)
      : kd_(p.spectrumTexture("Kd", Spectrum(0.25F), "diffuse reflectance")),
        ks_(p.spectrumTexture("Ks", Spectrum(0.25F), "scales the glossy reflection")),
        kr_(p.spectrumTexture("Kr", Spectrum(0), "scales the mirror reflection")),
        kt_(p.spectrumTexture("Kt", Spectrum(0), "scales the refracted light")),
        opacity_(p.spectrumTexture("opacity", Spectrum(1),
                                   "scales all of these; the rest of the light goes straight on")),
        roughness_(p, 0.1F),
        map_(p),
        facets_(p),
        index_(p),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum opacity = glm::clamp(opacity_(at), 0.F, 1.F), clear = 1.F - opacity;
    const Spectrum kd = opacity * glm::max(kd_(at), 0.F), ks = opacity * glm::max(ks_(at), 0.F);
    const Spectrum kr = opacity * glm::max(kr_(at), 0.F), kt = opacity * glm::max(kt_(at), 0.F);
    const float index = index_(at);
    // pbrt-v1 and v2 have the denser medium outside, as with plastic.
    const DielectricFresnel fresnel{facets_.blinn() ? 1 / index : index};
    if (!isBlack(clear))
      bsdf.add(place<StraightTransmission<NoReflection>>(scratch, clear, NoReflection{}));
    if (!isBlack(kd)) bsdf.add(place<Lambertian>(scratch, kd));
    if (!isBlack(ks)) {
      facets_.with(roughness_(at), map_, [&]<class Distribution>(const Distribution& facets) {
        using OneSided = MicrofacetReflection<Distribution, DielectricFresnel>;
        using TwoSided = MicrofacetReflection<Distribution, TwoSidedFresnel>;
        if constexpr (std::is_same_v<Distribution, Blinn>)
          bsdf.add(place<TwoSided>(scratch, ks, facets, TwoSidedFresnel{fresnel.eta}));
        else
          bsdf.add(place<OneSided>(scratch, ks, facets, fresnel));
      });
    }
    if (!isBlack(kr)) bsdf.add(place<SpecularReflection<DielectricFresnel>>(scratch, kr, fresnel));
    if (!isBlack(kt)) bsdf.add(place<SpecularTransmission>(scratch, kt, index));
  }
  bool filters() const override {
    return kd_.filters() || ks_.filters() || kr_.filters() || kt_.filters() || opacity_.filters() ||
           roughness_.filters() || index_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> kd_, ks_, kr_, kt_, opacity_;
  Roughness roughness_;
  RoughnessMap map_;
  Facets facets_;
  RefractiveIndex index_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Uber, "uber",
            "any mixture of diffuse, glossy, mirroring, refracting and see-through")
