#pragma once
// The clear coat that pbrt-v4's coated materials share.

#include "core/api/lobes_coat.h"
#include "core/plugin/roughness_params.h"

namespace pbrt {

// pbrt-v4 follows light at random through the layers. The sums over all its paths, which a diffuse
// base has in closed form (core/api/lobes_coat.h), need no such walk, and give the same mean but
// for what may be in the coat: a medium, there of the optical depth `thickness` and of the albedo
// `albedo`, is left out. By default there is none.
class Coat {
 public:
  Coat(Params& p, const std::string& prefix)
      : roughness_(p, 0, prefix),
        eta_(p.refractiveIndex(prefix + "eta", 1.5F, "index of refraction of the coat")),
        smooth_(eta_) {
    if (!(eta_ >= 1)) p.fail(prefix + "eta", "must be at least 1");
    if (!roughness_.none()) rough_ = RoughCoatTable::shared(eta_);
    constexpr std::string_view clear = "of a medium in the coat: has no effect";
    p.floatTexture("thickness", 0.01F, clear);
    p.floatTexture("g", 0, clear);
    constexpr int most = std::numeric_limits<int>::max();
    p.integer("maxdepth", 10, 0, most, "of a walk in the coat: has no effect");
    p.integer("nsamples", 1, 0, most, "of a walk in the coat: has no effect");
    const auto albedo = p.optionalSpectrumTexture("albedo", "of a medium in the coat: left out");
    if (albedo && (albedo->texture() || !isBlack((*albedo)({}))))
      p.warn("albedo", "the coat is clear here: the medium in it is left out");
  }

  float eta() const { return eta_; }
  FacetWidths widths(const SurfaceInteraction& at, const RoughnessMap& map) const {
    FacetWidths widths = map(roughness_(at));
    widths.smooth |= eta_ - 1 < MicrofacetTransmission<TrowbridgeReitz>::kLeastBend;
    return widths;
  }
  // Adds the reflection by the coat.
  CoatBoundary add(const FacetWidths& widths, Bsdf& bsdf, Scratch& scratch) const {
    using Mirror = SpecularReflection<TwoSidedFresnel>;
    using Gloss = MicrofacetReflection<TrowbridgeReitz, TwoSidedFresnel>;
    const TwoSidedFresnel fresnel{eta_};
    if (widths.smooth) {
      bsdf.add(place<Mirror>(scratch, Spectrum(1), fresnel));
      return smooth_;
    }
    bsdf.add(place<Gloss>(scratch, Spectrum(1), widths.facets(), fresnel));
    return rough_->boundary(std::sqrt(widths.x * widths.y));
  }
  bool filters() const { return roughness_.filters(); }

 private:
  Roughness roughness_;
  float eta_;
  CoatBoundary smooth_;
  std::shared_ptr<const RoughCoatTable> rough_;  // where it is not smooth everywhere
};

}  // namespace pbrt
