#pragma once
// What the tests of materials share: a surface, its bsdf, and what it reflects.

#include "core/base/warp.h"
#include "tests/support.h"
#include "tools/laws/scattering.h"

namespace pbrt::test {

using laws::direction;
using laws::flatSurface;
using laws::Mean;

// Of a material by its name, too.
class Scattering : public laws::Scattering {
 public:
  using laws::Scattering::Scattering;
  explicit Scattering(const std::string& name, const ParamList& list = {})
      : laws::Scattering(std::shared_ptr<const Material>(make<Material>(name, list))) {}
};

inline double albedo(const Bsdf& bsdf, const Vec3& wo, int samples,
                     std::uint8_t wanted = kAllLobes) {
  return laws::albedo(bsdf, wo, samples, wanted).mean();
}

}  // namespace pbrt::test
