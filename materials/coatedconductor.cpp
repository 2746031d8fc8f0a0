#include "core/api/lobes_coat.h"
#include "core/plugin/coat_params.h"
#include "core/plugin/index_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class CoatedConductorMaterial final : public Material {
 public:
  explicit CoatedConductorMaterial(Params& p)
      : map_(p),
        coat_(p, "interface."),
        conductor_(p, "conductor."),
        roughness_(p, 0, "conductor."),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    ConductorFresnel fresnel = conductor_(at);
    const float eta = coat_.eta();
    fresnel.eta /= eta;
    fresnel.k /= eta;
    const FacetWidths coat = coat_.widths(at, map_), base = map_(roughness_(at));
    if (coat.smooth && base.smooth) {
      using Mirror = SpecularReflection<CoatedConductorFresnel>;
      bsdf.add(place<Mirror>(scratch, Spectrum(1), CoatedConductorFresnel{eta, fresnel}));
      return;
    }
    const CoatBoundary boundary = coat_.add(coat, bsdf, scratch);
    // The facets of a rough coat turn light, too. Where its slope is s, they turn light by
    // (1 - 1 / eta) s on its way in and as much on its way out; the conductor's by 2 s. Variances
    // add: half of the squares of the former stand for a wider conductor.
    const float bend = coat.smooth ? 0 : 0.5F * sqr(1 - 1 / eta);
    const auto wider = [&](float own, float coats) {
      return std::sqrt(sqr(own) + bend * sqr(coats));
    };
    const float x = wider(base.smooth ? 0 : base.x, coat.x);
    const float y = wider(base.smooth ? 0 : base.y, coat.y);
    bsdf.add(place<CoatedConductor>(scratch, boundary, x, y, fresnel));
  }
  bool filters() const override {
    return coat_.filters() || conductor_.filters() || roughness_.filters() ||
           (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  RoughnessMap map_;
  Coat coat_;
  Conductor conductor_;
  Roughness roughness_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::CoatedConductorMaterial, "coatedconductor",
            "metal under a clear varnish, as on a car")
