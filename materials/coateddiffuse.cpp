#include "core/api/lobes_coat.h"
#include "core/plugin/coat_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class CoatedDiffuseMaterial final : public Material {
 public:
  explicit CoatedDiffuseMaterial(Params& p)
      : reflectance_(p.spectrumTexture("reflectance", Spectrum(0.5F), "of the diffuse base")),
        map_(p),
        coat_(p, ""),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const CoatBoundary boundary = coat_.add(coat_.widths(at, map_), bsdf, scratch);
    const Spectrum reflectance = glm::clamp(reflectance_(at), 0.F, 1.F);
    if (!isBlack(reflectance)) bsdf.add(place<CoatedDiffuse>(scratch, reflectance, boundary));
  }
  bool filters() const override {
    return reflectance_.filters() || coat_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> reflectance_;
  RoughnessMap map_;
  Coat coat_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::CoatedDiffuseMaterial, "coateddiffuse",
            "a diffuse surface under a clear varnish, smooth or rough")
