#include "core/api/lobes.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Mirror final : public Material {
 public:
  explicit Mirror(Params& p)
      : kr_(p.spectrumTexture("Kr", Spectrum(0.9F), "reflectance, the same at every angle")),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum kr = glm::max(kr_(at), 0.F);
    if (!isBlack(kr)) bsdf.add(place<SpecularReflection<NoFresnel>>(scratch, kr, NoFresnel{}));
  }
  bool filters() const override { return kr_.filters() || (bump_ && bump_->filters()); }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> kr_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Mirror, "mirror", "a perfect mirror")
