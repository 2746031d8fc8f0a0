#include "core/base/picture.h"
#include "core/plugin/light_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

class Projection final : public Light {
 public:
  Projection(Params& p, const Setup& setup) : Projection(p, setup, readLightPicture(p)) {}

  LightSample sample(const Point3& p, Point2 /*u*/) const override {
    LightSample s;
    const Vec3 w = p - position_;
    const float d2 = lengthSquared(w);
    const Vec3 light = toLight_ * w;
    if (!(d2 > 0 && light.z > 0)) return s;
    const Vec2 screen = Vec2(light) / light.z;
    if (std::abs(screen.x) > half_.x || std::abs(screen.y) > half_.y) return s;
    // The picture's top row is at the low end of y, as in every pbrt.
    s.L = intensity_ * picture_.at(0.5F * screen / half_ + 0.5F, Wrap::clamp) / d2;
    s.wi = -w / std::sqrt(d2);
    s.p = position_;
    s.pdf = 1;
    return s;
  }
  double power(double /*sceneRadius*/) const override { return luminance(intensity_ * flux_); }
  LightBounds bounds() const override { return boundsOfPoint(position_, power(0) / angle_, cone_); }

 private:
  Projection(Params& p, const Setup& setup, const std::filesystem::path& file)
      : intensity_(p.emission("I", Spectrum(1), "radiant intensity where the picture is 1")),
        picture_(file.empty() ? Picture(Spectrum(1)) : Picture(file)),
        toLight_(setup.toRender.inverseMatrix()),
        position_(setup.toRender.point(DPoint3(0))) {
    const float fov =
        p.inRange("fov", 45, 0, 180, "angle of the picture's shorter side; along +z", "degrees");
    if (fov == 0 || fov == 180) p.fail("fov", "must be between 0 and 180");
    const float half = std::tan(radians(0.5F * fov));
    const auto w = static_cast<float>(picture_.width()), h = static_cast<float>(picture_.height());
    half_ = half * Vec2(w, h) / std::min(w, h);
    intensity_ *= readLightScale(p);
    throwPicture();
    intensity_ *=
        readTotal(p, "power", luminance(flux_), "flux of the whole picture, for I = 1", "lm");

    // The corners are what is farthest from the axis.
    const auto inRender = [&](float x, float y) {
      return Vec3(glm::normalize(setup.toRender.vector(DVec3(x * half_.x, y * half_.y, 1))));
    };
    cone_ = {inRender(0, 0), 1};
    for (const float x : {-1.F, 1.F})
      for (const float y : {-1.F, 1.F})
        cone_.cosine = std::min(cone_.cosine, glm::dot(cone_.axis, inRender(x, y)));
  }

  // The picture's flux and solid angle. At the point (x, y) of the plane z = 1 a small area a spans
  // the solid angle a cos^3 = a / (1 + x^2 + y^2)^(3/2).
  void throwPicture() {
    DVec3 sum(0);
    const int w = picture_.width(), h = picture_.height();
    // A picture of few pixels is cut finer than they are.
    const int cut = 1 + 256 / std::max(w, h);
    const Vec2 side = 2.F * half_ / Vec2(w * cut, h * cut);
    for (int y = 0; y < h * cut; ++y)
      for (int x = 0; x < w * cut; ++x) {
        const Vec2 at = (Vec2(x, y) + 0.5F) * side - half_;
        const double angle = double{side.x} * side.y / std::pow(1 + double{lengthSquared(at)}, 1.5);
        sum += DVec3(picture_.pixel(x / cut, y / cut)) * angle;
        angle_ += angle;
      }
    flux_ = Spectrum(sum);
  }

  Spectrum intensity_;
  Picture picture_;
  glm::mat3 toLight_;
  Point3 position_{};
  Spectrum flux_{0};  // for I = 1
  double angle_ = 0;
  DirectionCone cone_;  // holds the directions of render space that it shines into
  Vec2 half_{1};        // of the sides of the picture in the plane z = 1 of light space
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Projection, "projection", "a point that throws a picture, like a slide")
