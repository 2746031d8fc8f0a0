// Shows what a ray knows of the surface that it meets: one quantity in each colour.

#include <array>

#include "core/api/integrator.h"
#include "core/plugin/params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

// Those up to zero are pbrt-v1's, which takes absolute values of normals, as pictures are not
// negative.
enum Quantity : std::uint8_t {
  kU,
  kV,
  kNx,
  kNy,
  kNz,
  kSnx,
  kSny,
  kSnz,
  kHit,
  kOne,
  kZero,
  kDepth,
  kDpdu,
  kDpdv,
  kFront,
  kShape,
  kPrimitive
};
constexpr std::array<std::string_view, 17> kNames = {
    "u",   "v",    "nx",    "ny",   "nz",   "snx",   "sny",   "snz",      "hit",
    "one", "zero", "depth", "dpdu", "dpdv", "front", "shape", "primitive"};

class Debug final : public SamplingIntegrator {
 public:
  explicit Debug(Params& p)
      : shown_{quantity(p, "red", "u"), quantity(p, "green", "v"), quantity(p, "blue", "zero")} {}

  bool usesLights() const override { return false; }
  bool mayChooseBy(LightStrategy) const override { return false; }

  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler&,
              Scratch& scratch) const override {
    SurfaceInteraction at;
    if (hit.found()) {
      at = world.surface(ray, hit);
      world.bsdf(at, scratch);  // a bump map turns the shading normal
    }
    Spectrum L(0);
    for (int c = 0; c < 3; ++c) L[c] = value(shown_[c], ray, hit, at);
    return L;
  }

 private:
  static Quantity quantity(Params& p, const std::string& colour, std::string_view fallback) {
    const std::string name =
        p.choice(colour, kNames, fallback,
                 "of the surface: n normal, sn shading normal, dpdu dpdv lengths, front 1 outside");
    return static_cast<Quantity>(std::ranges::find(kNames, name) - kNames.begin());
  }

  static float value(Quantity quantity, const Ray& ray, const Hit& hit,
                     const SurfaceInteraction& at) {
    if (quantity == kOne) return 1;
    if (!hit.found()) return 0;
    switch (quantity) {
      case kU:
        return at.uv.x;
      case kV:
        return at.uv.y;
      case kNx:
      case kNy:
      case kNz:
        return std::abs(at.n[quantity - kNx]);
      case kSnx:
      case kSny:
      case kSnz:
        return std::abs(at.ns[quantity - kSnx]);
      case kDepth:
        return glm::distance(ray.o, at.p);
      case kDpdu:
        return glm::length(at.dpdu);
      case kDpdv:
        return glm::length(at.dpdv);
      case kFront:
        return glm::dot(at.n, at.wo) > 0 ? 1 : 0;
      case kShape:
        return static_cast<float>(hit.placed() + 1);
      case kPrimitive:
        return static_cast<float>(hit.primitive);
      case kHit:
        return 1;
      default:
        return 0;
    }
  }

  std::array<Quantity, 3> shown_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::Debug, "debug",
            "no light: shows what rays know of surfaces, such as normals, in red, green and blue")
