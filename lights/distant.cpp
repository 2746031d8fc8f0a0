#include "core/plugin/light_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Distant final : public Light {
 public:
  Distant(Params& p, const Setup& setup)
      : L_(p.emission("L", Spectrum(1), "irradiance of a surface that faces it")) {
    L_ *= readLightScale(p);
    L_ *= readTotal(p, "illuminance", 1, "of a surface that faces it, for L = 1", "lx");
    const Point3 from = p.point("from", Point3(0), "with \"to\": the direction the light takes");
    const Vec3 back = from - p.point("to", {0, 0, 1}, "see \"from\"");
    if (!(lengthSquared(back) > 0)) p.fail("to", "must not be the same point as \"from\"");
    wi_ = glm::normalize(setup.toRender.vector(back));
  }

  LightSample sample(const Point3& /*p*/, Point2 /*u*/) const override {
    LightSample s;
    s.L = L_;
    s.wi = wi_;
    s.finite = false;
    s.pdf = 1;
    return s;
  }
  double power(double sceneRadius) const override { return kPi * sqr(sceneRadius) * luminance(L_); }
  LightBounds bounds() const override { return {{}, luminance(L_)}; }

 private:
  Spectrum L_;
  Vec3 wi_{};  // unit, towards the light
};

}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Distant, "distant", "parallel light from infinitely far, like the sun's")
