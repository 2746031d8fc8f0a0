#pragma once
// The indices of refraction that materials share.

#include "core/base/colorimetry.h"
#include "core/base/fresnel.h"
#include "core/base/named_spectra.h"
#include "core/plugin/params.h"

namespace pbrt {

// A dielectric's: "index", or "eta", which overrides it.
class RefractiveIndex {
 public:
  explicit RefractiveIndex(Params& p) {
    const auto eta = p.optionalRefractiveIndex("eta", "another name of index, which it overrides");
    index_ = p.floatTexture("index", 1.5F,
                            "index of refraction on the side that the normal points away from, "
                            "over that of the other side");
    if (!index_.texture() && !(index_({}) > 0)) p.fail("index", "must be above 0");
    if (eta) index_ = *eta;
  }

  // Of an odd value: 1, no boundary. What is still larger or smaller has no square, or none that is
  // above 0.
  float operator()(const SurfaceInteraction& at) const {
    const float index = index_(at);
    return index > 1e-6F && index < 1e6F ? index : 1;
  }
  bool filters() const { return index_.filters(); }

 private:
  Textured<float> index_;
};

// A conductor's, by its complex index or by the reflectance that it has frontally. Outside is air.
// The names begin with `prefix`, but for "reflectance".
class Conductor {
 public:
  explicit Conductor(Params& p, const std::string& prefix = "")
      : eta_(p.spectrumTexture(prefix + "eta", named("metal-Cu-eta"),
                               "index of refraction; copper's")),
        k_(p.spectrumTexture(prefix + "k", named("metal-Cu-k"),
                             "absorption coefficient; copper's")),
        reflectance_(p.optionalSpectrumTexture(
            "reflectance", "frontal reflectance, instead of eta and k: eta = 1 with such a k")) {
    for (const char* name : {"eta", "k"})
      if (reflectance_ && p.has(prefix + name))
        p.fail(prefix + name, "cannot be given together with reflectance");
  }

  ConductorFresnel operator()(const SurfaceInteraction& at) const {
    // Values out of any use would overflow.
    if (!reflectance_) return {glm::clamp(eta_(at), 1e-3F, 1e6F), glm::clamp(k_(at), 0.F, 1e6F)};
    // r = |(1 - m) / (1 + m)|^2 = k^2 / (4 + k^2) for m = 1 + i k.
    const Spectrum r = glm::clamp((*reflectance_)(at), 0.F, 0.9999F);
    return {Spectrum(1), 2.F * glm::sqrt(r / (1.F - r))};
  }
  bool filters() const {
    return eta_.filters() || k_.filters() || (reflectance_ && reflectance_->filters());
  }

 private:
  static Spectrum named(std::string_view name) { return surfaceColour(*namedSpectrum(name)); }

  Textured<Spectrum> eta_, k_;
  std::optional<Textured<Spectrum>> reflectance_;
};

}  // namespace pbrt
