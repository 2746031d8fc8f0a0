#include "core/api/lobes_microfacet.h"
#include "core/plugin/index_params.h"
#include "core/plugin/plugin.h"
#include "core/plugin/roughness_params.h"

namespace pbrt {

class Glass final : public Material {
 public:
  explicit Glass(Params& p)
      : kr_(p.spectrumTexture("Kr", Spectrum(1), "scales the reflected light")),
        kt_(p.spectrumTexture("Kt", Spectrum(1), "scales the transmitted light")),
        roughness_(p, 0),
        map_(p),
        facets_(p, false),
        index_(p),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum kr = glm::max(kr_(at), 0.F), kt = glm::max(kt_(at), 0.F);
    const float index = index_(at);
    const Vec2 roughness = roughness_(at);
    if (map_(roughness).smooth || std::abs(index - 1) < kLeastBend) {
      using Mirror = SpecularReflection<DielectricFresnel>;
      if (!isBlack(kr)) bsdf.add(place<Mirror>(scratch, kr, DielectricFresnel{index}));
      if (!isBlack(kt)) bsdf.add(place<SpecularTransmission>(scratch, kt, index));
    } else {
      facets_.with(roughness, map_, [&]<class Distribution>(const Distribution& facets) {
        using Gloss = MicrofacetReflection<Distribution, DielectricFresnel>;
        using Refraction = MicrofacetTransmission<Distribution>;
        if (!isBlack(kr)) bsdf.add(place<Gloss>(scratch, kr, facets, DielectricFresnel{index}));
        if (!isBlack(kt)) bsdf.add(place<Refraction>(scratch, kt, facets, index));
      });
    }
  }
  bool filters() const override {
    return kr_.filters() || kt_.filters() || roughness_.filters() || index_.filters() ||
           (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  static constexpr float kLeastBend = MicrofacetTransmission<TrowbridgeReitz>::kLeastBend;

  Textured<Spectrum> kr_, kt_;
  Roughness roughness_;
  RoughnessMap map_;
  Facets facets_;
  RefractiveIndex index_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Glass, "glass",
            "glass or water, clear or frosted: it mirrors and refracts")
