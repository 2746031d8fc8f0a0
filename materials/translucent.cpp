#include "core/api/lobes_microfacet.h"
#include "core/plugin/plugin.h"
#include "core/plugin/roughness_params.h"

namespace pbrt {

class Translucent final : public Material {
 public:
  explicit Translucent(Params& p)
      : kd_(p.spectrumTexture("Kd", Spectrum(0.25F), "diffuse scattering, to both sides")),
        ks_(p.spectrumTexture("Ks", Spectrum(0.25F), "scales the glossy scattering")),
        reflect_(p.spectrumTexture("reflect", Spectrum(0.5F), "share of both that is reflected")),
        transmit_(p.spectrumTexture("transmit", Spectrum(0.5F), "share that is let through")),
        roughness_(p.floatTexture("roughness", 0.1F, "0 is the sharpest highlight")),
        map_(p),
        facets_(p),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum reflect = glm::max(reflect_(at), 0.F), transmit = glm::max(transmit_(at), 0.F);
    const Spectrum kd = glm::max(kd_(at), 0.F), ks = glm::max(ks_(at), 0.F);
    const auto add = [&]<class Lobe>(const Lobe& lobe, const Spectrum& scale) {
      if (!isBlack(scale)) bsdf.add(place<Lobe>(scratch, lobe));
    };
    add(Lambertian(kd * reflect), kd * reflect);
    add(Through(Lambertian(kd * transmit)), kd * transmit);
    facets_.with(Vec2(roughness_(at)), map_, [&]<class Distribution>(const Distribution& facets) {
      if constexpr (std::is_same_v<Distribution, Blinn>) {
        // As with plastic, pbrt-v1 and v2 have the denser medium outside.
        constexpr TwoSidedFresnel fresnel{1 / kIndex};
        add(MicrofacetReflection(ks * reflect, facets, fresnel), ks * reflect);
        add(Through(MicrofacetReflection(ks * transmit, facets, fresnel)), ks * transmit);
      } else {
        constexpr DielectricFresnel fresnel{kIndex};
        add(MicrofacetReflection(ks * reflect, facets, fresnel), ks * reflect);
        add(MicrofacetTransmission(ks * transmit, facets, kIndex), ks * transmit);
      }
    });
  }
  bool filters() const override {
    return kd_.filters() || ks_.filters() || reflect_.filters() || transmit_.filters() ||
           roughness_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  static constexpr float kIndex = 1.5F;

  Textured<Spectrum> kd_, ks_, reflect_, transmit_;
  Textured<float> roughness_;
  RoughnessMap map_;
  Facets facets_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Translucent, "translucent",
            "a leaf or a lampshade: diffuse and glossy, both ways")
