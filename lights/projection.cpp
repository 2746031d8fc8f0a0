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
    intensity_ *= readTotal(p, "power", flux(), "flux of the whole picture, for I = 1", "lm");
  }

  // Of the picture, for I = 1. At the point (x, y) of the plane z = 1 a small area a spans the
  // solid angle a cos^3 = a / (1 + x^2 + y^2)^(3/2).
  float flux() const {
    double sum = 0;
    const int w = picture_.width(), h = picture_.height();
    // A picture of few pixels is cut finer than they are.
    const int cut = 1 + 256 / std::max(w, h);
    const Vec2 side = 2.F * half_ / Vec2(w * cut, h * cut);
    for (int y = 0; y < h * cut; ++y)
      for (int x = 0; x < w * cut; ++x) {
        const Vec2 at = (Vec2(x, y) + 0.5F) * side - half_;
        sum += luminance(picture_.pixel(x / cut, y / cut)) * side.x * side.y /
               std::pow(1 + double{lengthSquared(at)}, 1.5);
      }
    return static_cast<float>(sum);
  }

  Spectrum intensity_;
  Picture picture_;
  glm::mat3 toLight_;
  Point3 position_{};
  Vec2 half_{1};  // of the sides of the picture in the plane z = 1 of light space
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Projection, "projection", "a point that throws a picture, like a slide")
