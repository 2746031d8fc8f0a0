// Ambient occlusion (Zhukov, Iones and Kronin 1998): how much of the sky a surface sees.

#include "core/api/integrator.h"
#include "core/base/warp.h"
#include "core/plugin/params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

class AmbientOcclusion final : public SamplingIntegrator {
 public:
  static constexpr int kMostSamples = World::kBatch;  // at a time

  explicit AmbientOcclusion(Params& p)
      : samples_(p.integer("nsamples", 64, 1, 1 << 20, "directions from each point")),
        weighted_(p.flag("weighted", true,
                         "the sky counts by the cosine, most overhead; else all of it alike")),
        byCosine_(p.flag("cossample", true,
                         "takes directions by the cosine if they count so: less noise; else all "
                         "alike") &&
                  weighted_),
        maxDistance_(
            p.positive("maxdistance", kInfinity, "what is farther hides no sky", "scene units")),
        scale_(p.nonNegative("scale", 1, "of a point that sees all of the sky")) {}

  bool usesLights() const override { return false; }
  bool mayChooseBy(LightStrategy) const override { return false; }

  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch&) const override {
    if (!hit.found()) return Spectrum(0);
    const SurfaceInteraction at = world.surface(ray, hit);
    const Frame frame = Frame::fromZ(glm::dot(at.n, at.wo) < 0 ? -at.n : at.n);
    float seen = 0;
    for (int done = 0; done < samples_; done += kMostSamples) {
      const auto n = static_cast<std::size_t>(std::min(samples_ - done, kMostSamples));
      seen += unhidden(world, at, frame, n, sampler);
    }
    return Spectrum(scale_ * seen / static_cast<float>(samples_));
  }

 private:
  // The sum over n directions.
  float unhidden(const World& world, const SurfaceInteraction& at, const Frame& frame,
                 std::size_t n, Sampler& sampler) const {
    std::array<Point2, kMostSamples> points;
    std::array<Ray, kMostSamples> rays;
    std::array<float, kMostSamples> weights{};
    const std::span<Point2> u(points.data(), n);
    sampler.get2D(u);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 w = byCosine_ ? cosHemisphere(u[i]) : uniformCone(u[i], 1);
      // The share of the sky over the density.
      const float share = weighted_ ? w.z * kInvPi : 0.5F * kInvPi;
      weights[i] = byCosine_ ? 1 : share / uniformConePdf(1);
      rays[i] = spawnRay(at, frame.fromLocal(w));
      rays[i].tMax = maxDistance_;
    }
    const std::uint32_t hidden = world.occluded({rays.data(), n});
    float sum = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (!(hidden >> i & 1U)) sum += weights[i];
    return sum;
  }

  int samples_;
  bool weighted_, byCosine_;
  float maxDistance_, scale_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::AmbientOcclusion, "ambientocclusion",
            "no lights: how much of the sky each point sees, which shows corners and contacts")
