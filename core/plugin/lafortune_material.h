#pragma once
// What the measured materials of pbrt-v1 share.

#include "core/api/lobes.h"
#include "core/api/lobes_lafortune.h"
#include "core/plugin/params.h"

namespace pbrt {

class LafortuneMaterial : public Material {
 public:
  LafortuneMaterial(Params& p, const LafortuneFit& fit)
      : model_(fit),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& /*at*/, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum& diffuse = model_.fit().diffuse;
    if (!isBlack(diffuse)) bsdf.add(place<Lambertian>(scratch, diffuse));
    for (int l = 0; l < LafortuneFit::kLobes; ++l)
      bsdf.add(place<LafortuneLobe>(scratch, model_, l));
  }
  bool filters() const override { return bump_ && bump_->filters(); }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  LafortuneModel model_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt
