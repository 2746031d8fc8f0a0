#include "core/api/lobes.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Matte final : public Material {
 public:
  explicit Matte(Params& p)
      : kd_(p.spectrumTexture("Kd", Spectrum(0.5F), "diffuse reflectance")),
        sigma_(p.floatTexture("sigma", 0,
                              "standard deviation of the slope angles of a rough surface, at "
                              "most 90; 0 is smooth",
                              "degrees")),
        bump_(p.optionalFloatTexture("bumpmap", "height by which the surface seems displaced")) {}

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum kd = glm::max(kd_(at), 0.F);
    if (isBlack(kd)) return;
    const float sigma = std::clamp(sigma_(at), 0.F, 90.F);
    if (sigma > 0)
      bsdf.add(place<OrenNayar>(scratch, kd, radians(sigma)));
    else
      bsdf.add(place<Lambertian>(scratch, kd));
  }
  bool filters() const override {
    return kd_.filters() || sigma_.filters() || (bump_ && bump_->filters());
  }
  const Textured<float>* bumpMap() const override { return bump_ ? &*bump_ : nullptr; }

 private:
  Textured<Spectrum> kd_;
  Textured<float> sigma_;
  std::optional<Textured<float>> bump_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Matte, "matte",
            "a dull surface that scatters light evenly, such as paper, plaster or clay")
