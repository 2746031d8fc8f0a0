#include "core/api/lobes.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class DiffuseTransmission final : public Material {
 public:
  explicit DiffuseTransmission(Params& p)
      : reflectance_(p.spectrumTexture("reflectance", Spectrum(0.25F), "share sent back")),
        transmittance_(p.spectrumTexture("transmittance", Spectrum(0.25F), "share let through")),
        scale_(p.nonNegative("scale", 1, "multiplies both")),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum r = glm::clamp(scale_ * reflectance_(at), 0.F, 1.F);
    const Spectrum t = glm::clamp(scale_ * transmittance_(at), 0.F, 1.F);
    if (!isBlack(r)) bsdf.add(place<Lambertian>(scratch, r));
    if (!isBlack(t)) bsdf.add(place<Through<Lambertian>>(scratch, Lambertian(t)));
  }
  bool filters() const override {
    return reflectance_.filters() || transmittance_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> reflectance_, transmittance_;
  float scale_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::DiffuseTransmission, "diffusetransmission",
            "paper or cloth: light is scattered evenly to both sides")
