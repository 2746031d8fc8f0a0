#include "core/api/lobes.h"
#include "core/plugin/index_params.h"
#include "core/plugin/plugin.h"
#include "core/plugin/roughness_params.h"

namespace pbrt {

class Metal final : public Material {
 public:
  explicit Metal(Params& p)
      : conductor_(p),
        roughness_(p, 0.01F),
        map_(p),
        facets_(p),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const ConductorFresnel fresnel = conductor_(at);
    const Vec2 roughness = roughness_(at);
    using Mirror = SpecularReflection<ConductorFresnel>;
    if (!facets_.blinn() && map_(roughness).smooth) {
      bsdf.add(place<Mirror>(scratch, Spectrum(1), fresnel));
      return;
    }
    facets_.with(roughness, map_, [&]<class Distribution>(const Distribution& facets) {
      using Gloss = MicrofacetReflection<Distribution, ConductorFresnel>;
      bsdf.add(place<Gloss>(scratch, Spectrum(1), facets, fresnel));
    });
  }
  bool filters() const override {
    return conductor_.filters() || roughness_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Conductor conductor_;
  Roughness roughness_;
  RoughnessMap map_;
  Facets facets_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Metal, "metal", "copper, gold or any other metal, polished or rough")
