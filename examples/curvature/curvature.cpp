// How surfaces bend, in false colours: what bulges out is red, what is hollow is blue, what is flat
// is white. Fine for finding dents and seams that a shaded picture hides.

#include <array>

#include "core/api/integrator.h"
#include "core/plugin/plugin.h"

namespace {

using namespace pbrt;

class Curvature final : public SamplingIntegrator {
 public:
  explicit Curvature(Params& p)
      : radius_(p.positive("radius", 1, "a ball of this radius is half as red as can be",
                           "scene units")) {
    constexpr std::array<std::string_view, 2> kinds = {"mean", "gaussian"};
    gaussian_ =
        p.choice("curvature", kinds, "mean",
                 "mean: of all directions; gaussian: red where both principal curvatures "
                 "bend one way, blue where they bend opposite ways, as in a saddle") == "gaussian";
  }

  bool usesLights() const override { return false; }

  // Called from many threads at once. `hit` is where the ray first meets the scene.
  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler&,
              Scratch&) const override {
    if (!hit.found()) return Spectrum(0.02F);
    const SurfaceInteraction at = world.surface(ray, hit);
    // By a lamp at the eye, so that one sees the form.
    return colour(bend(at)) * (0.25F + 0.75F * std::abs(glm::dot(at.wo, at.n)));
  }

 private:
  // The curvature times the radius (gaussian: its square), above zero where the surface bulges out.
  // With the fundamental forms I = (E F; F G) of dp and II = (L M; M N) of dp and dn, the mean
  // curvature is half the trace of II / I, and Gauss's is its determinant (do Carmo 1976, section
  // 3.3; n points outwards, hence the signs). Surfaces without parameters do not bend.
  float bend(const SurfaceInteraction& at) const {
    const DVec3 pu(at.dpdu), pv(at.dpdv), nu(at.dndu), nv(at.dndv);
    const double E = glm::dot(pu, pu), F = glm::dot(pu, pv), G = glm::dot(pv, pv);
    const double L = glm::dot(nu, pu), N = glm::dot(nv, pv);
    const double M = 0.5 * (glm::dot(nu, pv) + glm::dot(nv, pu));
    const double area2 = E * G - F * F;
    if (!(area2 > 1e-12 * E * G)) return 0;
    const double bent = gaussian_ ? (L * N - M * M) / area2 * radius_ * radius_
                                  : (L * G - 2 * M * F + N * E) / (2 * area2) * radius_;
    return static_cast<float>(bent);
  }

  // White at 0, half way to red at 1, and to blue at -1.
  static Spectrum colour(float x) {
    const float share = std::abs(x) / (1 + std::abs(x));
    const Spectrum full = x > 0 ? Spectrum(0.8F, 0.05F, 0.02F) : Spectrum(0.02F, 0.1F, 0.8F);
    return glm::mix(Spectrum(0.8F), full, share);
  }

  float radius_;
  bool gaussian_ = false;
};

}  // namespace

PBRT_PLUGIN(Integrator, Curvature, "curvature", "how surfaces bend: red outwards, blue inwards")
