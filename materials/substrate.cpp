#include "core/api/lobes_microfacet.h"
#include "core/plugin/plugin.h"
#include "core/plugin/roughness_params.h"

namespace pbrt {

class Substrate final : public Material {
 public:
  explicit Substrate(Params& p)
      : kd_(p.spectrumTexture("Kd", Spectrum(0.5F), "diffuse reflectance")),
        ks_(p.spectrumTexture("Ks", Spectrum(0.5F), "reflectance of the gloss, seen frontally")),
        roughness_(Roughness::perAxis(p, 0.1F)),
        map_(p),
        facets_(p),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum kd = glm::clamp(kd_(at), 0.F, 1.F), ks = glm::clamp(ks_(at), 0.F, 1.F);
    if (isBlack(kd) && isBlack(ks)) return;
    facets_.with(roughness_(at), map_, [&]<class Distribution>(const Distribution& facets) {
      bsdf.add(place<FresnelBlend<Distribution>>(scratch, kd, ks, facets));
    });
  }
  bool filters() const override {
    return kd_.filters() || ks_.filters() || roughness_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> kd_, ks_;
  Roughness roughness_;
  RoughnessMap map_;
  Facets facets_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Substrate, "substrate",
            "a varnished diffuse surface, whose colour fades where the varnish shines")
