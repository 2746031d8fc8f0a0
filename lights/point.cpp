#include "core/plugin/light_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class PointLight final : public Light {
 public:
  PointLight(Params& p, const Setup& setup)
      : intensity_(p.emission("I", Spectrum(1), "radiant intensity")) {
    intensity_ *= readLightScale(p);
    intensity_ *= readTotal(p, "power", 4 * kPi, "flux in all directions, for I = 1", "lm");
    position_ = setup.toRender.point(p.point("from", Point3(0), "where it is"));
  }

  LightSample sample(const Point3& p, Point2 /*u*/) const override {
    LightSample s;
    const Vec3 w = position_ - p;
    const float d2 = lengthSquared(w);
    if (!(d2 > 0)) return s;
    s.L = intensity_ / d2;
    s.wi = w / std::sqrt(d2);
    s.p = position_;
    s.pdf = 1;
    return s;
  }
  double power(double /*sceneRadius*/) const override { return 4 * kPi * luminance(intensity_); }
  LightBounds bounds() const override { return boundsOfPoint(position_, luminance(intensity_)); }

 private:
  Spectrum intensity_;
  Point3 position_{};
};

}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::PointLight, "point", "a point that shines equally into all directions")
