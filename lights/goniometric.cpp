// A point whose intensity differs with the direction, as measured of a lamp.

#include "core/base/picture.h"
#include "core/base/sphere_map.h"
#include "core/plugin/light_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

class Goniometric final : public Light {
 public:
  Goniometric(Params& p, const Setup& setup) : Goniometric(p, setup, readLightPicture(p)) {}

  LightSample sample(const Point3& p, Point2 /*u*/) const override {
    LightSample s;
    const Vec3 w = p - position_;
    const float d2 = lengthSquared(w);
    if (!(d2 > 0)) return s;
    s.L = intensity_ * share(glm::normalize(toLight_ * DVec3(w))) / d2;
    s.wi = -w / std::sqrt(d2);
    s.p = position_;
    s.pdf = 1;
    return s;
  }
  double power(double /*sceneRadius*/) const override { return luminance(intensity_ * flux_); }
  LightBounds bounds() const override {
    return boundsOfPoint(position_, power(0) / (4 * std::numbers::pi));
  }

 private:
  Goniometric(Params& p, const Setup& setup, const std::filesystem::path& file)
      : intensity_(p.emission("I", Spectrum(1), "radiant intensity where the picture is 1")),
        picture_(file.empty() ? Picture(Spectrum(1)) : Picture(file)),
        toLight_(setup.toRender.inverseMatrix()),
        position_(setup.toRender.point(DPoint3(0))) {
    constexpr std::string_view maps[] = {"latlong", "equalarea"};
    const bool square = picture_.width() == picture_.height() && picture_.width() > 1;
    map_ = p.choice("mapping", maps, p.has("filename") && square ? "equalarea" : "latlong",
                    "how the sphere fills the picture: by the angles to +y (the top row) and about "
                    "it, or as pbrt-v4 has it") == "equalarea"
               ? SphereMap::equalarea
               : SphereMap::latlong;
    intensity_ *= readLightScale(p);
    flux_ = flux();
    intensity_ *=
        readTotal(p, "power", luminance(flux_), "flux in all directions, for I = 1", "lm");
  }

  // w is a unit direction of light space.
  Spectrum share(const DVec3& w) const {
    const bool latlong = map_ == SphereMap::latlong;
    const DVec3 aboutY(w.x, w.z, w.y);
    return picture_.at(Point2(squareFromSphere(map_, latlong ? aboutY : w)),
                       latlong ? Wrap::latlong : Wrap::octahedral);
  }

  // The mean of the picture over the sphere, a sum over cells of equal solid angle.
  Spectrum flux() const {
    DVec3 sum(0);
    const int w = picture_.width(), h = picture_.height();
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const double pi = std::numbers::pi;
        const double angle = map_ == SphereMap::equalarea
                                 ? 4 * pi / h
                                 : 2 * pi * (std::cos(pi * y / h) - std::cos(pi * (y + 1) / h));
        sum += DVec3(picture_.pixel(x, y)) * (angle / w);
      }
    return Spectrum(sum);
  }

  Spectrum intensity_;
  Picture picture_;
  SphereMap map_ = SphereMap::latlong;
  glm::dmat3 toLight_;
  Point3 position_{};
  Spectrum flux_{0};  // of the picture, for I = 1
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Goniometric, "goniometric",
            "a point whose light differs with the direction, as a picture says")
