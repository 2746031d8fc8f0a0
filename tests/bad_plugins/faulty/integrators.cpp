// White where there is something; fails by the x of the camera ray.

#include "fault.h"

namespace pbrt {

class FaultyIntegrator final : public SamplingIntegrator {
 public:
  explicit FaultyIntegrator(Params& p)
      : fault_(p), in_(p.choice("in", kWhere, "Li", "the function that fails")) {}
  void prepare(const World&, Point2i) const override {
    if (in_ == "prepare") fault_.number(0);
  }
  void look(const World& world, std::span<const Ray* const> rays, int,
            std::span<Hit> hits) const override {
    for (const Ray* ray : rays)
      if (in_ == "look") fault_.number(ray->o.x);
    world.intersect(rays, hits);
  }
  Spectrum Li(const World&, const RayDifferential& ray, const Hit& hit, Sampler&,
              Scratch&) const override {
    const float number = in_ == "Li" ? fault_.number(ray.o.x) : 1;
    return Spectrum(hit.found() ? number : 0);
  }

 private:
  static constexpr std::array kWhere = std::to_array<std::string_view>({"prepare", "look", "Li"});

  Fault fault_;
  std::string in_;
};

}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::FaultyIntegrator, "faulty", "an integrator that fails")
