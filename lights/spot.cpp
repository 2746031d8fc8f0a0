#include "core/plugin/light_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Spot final : public Light {
 public:
  Spot(Params& p, const Setup& setup)
      : intensity_(p.emission("I", Spectrum(1), "radiant intensity along the axis")),
        toLight_(setup.toRender.inverseMatrix()) {
    intensity_ *= readLightScale(p);
    const float cone =
        p.inRange("coneangle", 30, 0, 180, "from the axis to where the light ends", "degrees");
    if (cone == 0) p.fail("coneangle", "must be above 0");
    const float delta = p.inRange("conedeltaangle", std::min(5.F, cone), 0, cone,
                                  "width of the soft edge, inside the cone", "degrees");
    cosEnd_ = std::cos(radians(cone));
    cosStart_ = std::cos(radians(cone - delta));
    constexpr std::string_view falloffs[] = {"quartic", "smoothstep"};
    smooth_ = p.choice("falloff", falloffs, "quartic",
                       "over the soft edge: the fourth power, or 3 x^2 - 2 x^3 as in pbrt-v4") ==
              "smoothstep";
    // The fourth power has the mean 1/5 over the soft edge, the other 1/2.
    angle_ = 2 * kPi * (1 - cosStart_ + (cosStart_ - cosEnd_) * (smooth_ ? 0.5F : 0.2F));
    intensity_ *= readTotal(p, "power", angle_, "flux of the whole cone, for I = 1", "lm");

    const Point3 from = p.point("from", Point3(0), "where it is");
    const Vec3 axis = p.point("to", {0, 0, 1}, "a point that it is aimed at") - from;
    if (!(lengthSquared(axis) > 0)) p.fail("to", "must not be the same point as \"from\"");
    axis_ = glm::normalize(axis);
    position_ = setup.toRender.point(from);
    cone_ = coneInRender(setup.toRender);
  }

  LightSample sample(const Point3& p, Point2 /*u*/) const override {
    LightSample s;
    const Vec3 w = p - position_;
    const float d2 = lengthSquared(w);
    const float share = falloff(w);
    if (!(d2 > 0) || share == 0) return s;
    s.L = intensity_ * (share / d2);
    s.wi = -w / std::sqrt(d2);
    s.p = position_;
    s.pdf = 1;
    return s;
  }
  double power(double /*sceneRadius*/) const override { return angle_ * luminance(intensity_); }
  LightBounds bounds() const override {
    return boundsOfPoint(position_, luminance(intensity_), cone_);
  }

 private:
  // Holds the directions of render space that it shines into: as wide as the rim is anywhere.
  DirectionCone coneInRender(const Transform& toRender) const {
    if (cosEnd_ <= 0) return {};
    DirectionCone cone{glm::normalize(toRender.vector(axis_)), 1};
    const Frame frame = Frame::fromZ(axis_);
    const float sine = safeSqrt(1 - sqr(cosEnd_));
    constexpr int n = 32;
    for (int i = 0; i < n; ++i) {
      const float phi = 2 * kPi * static_cast<float>(i) / n;
      const Vec3 rim = frame.fromLocal({sine * std::cos(phi), sine * std::sin(phi), cosEnd_});
      cone.cosine = std::min(
          cone.cosine, glm::dot(cone.axis, Vec3(glm::normalize(toRender.vector(DVec3(rim))))));
    }
    return cone;
  }

  // From 1 inside the soft edge to 0 at the end of the cone, by how far the cosine has come. The
  // angle is that of light space.
  float falloff(const Vec3& w) const {
    const float c = glm::dot(axis_, glm::normalize(toLight_ * w));
    if (!(c > cosEnd_)) return 0;
    if (c >= cosStart_) return 1;
    const float x = (c - cosEnd_) / (cosStart_ - cosEnd_);
    return smooth_ ? sqr(x) * (3 - 2 * x) : sqr(sqr(x));
  }

  Spectrum intensity_;
  glm::mat3 toLight_;
  Vec3 axis_{};  // unit, in light space
  Point3 position_{};
  float cosStart_ = 1, cosEnd_ = 1;
  bool smooth_ = false;  // the falloff, smoothstep
  float angle_ = 0;      // solid angle, weighted by the falloff
  DirectionCone cone_;
};

}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Spot, "spot", "a point that shines into a cone with a soft edge")
