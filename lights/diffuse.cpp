#include "core/plugin/light_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Diffuse final : public Light {
 public:
  Diffuse(Params& p, const Setup& setup)
      : L_(p.emission("L", Spectrum(1), "radiance that every point emits into all directions")),
        surface_(setup.surface),
        box_(setup.box) {
    L_ *= readLightScale(p);
    twoSided_ = p.flag("twosided", false, "emits on both sides, not only on the normal's");
    area_ = surface_ ? surface_->area() : 1;
    const auto flux = static_cast<float>(std::numbers::pi * area_ * (twoSided_ ? 2 : 1));
    L_ *= readTotal(p, "power", flux, "flux of the whole shape, for L = 1", "lm");
    samples_ = readLightSamples(p);
    if (!p.text("filename", "", "must be absent: a picture that the surface shows").empty())
      p.fail("filename", "is not there yet: the whole surface has one colour");
    if (!surface_ && !p.describing())
      throw Error("a \"diffuse\" light is the surface of a shape: it needs AreaLightSource");
  }

  LightSample sample(const Point3& p, Point2 u) const override {
    LightSample s;
    const AreaSample on = surface_->sample(DPoint3(p), u);
    if (!(on.pdf > 0)) return s;
    s.wi = glm::normalize(Vec3(on.p - DPoint3(p)));
    s.L = emitted(on.p, on.n, -s.wi);
    if (isBlack(s.L)) return s;
    s.p = on.p;
    s.n = on.n;
    s.error = static_cast<float>(on.error);
    s.pdf = on.pdf;
    return s;
  }
  bool isDelta() const override { return false; }

  Spectrum emitted(const Point3& /*p*/, const Normal3& n, const Vec3& w) const override {
    return twoSided_ || glm::dot(n, w) > 0 ? L_ : Spectrum(0);
  }
  float pdf(const Point3& p, const SurfaceInteraction& on) const override {
    return surface_->pdf(DPoint3(p), DPoint3(on.p), on.n);
  }
  bool mayHit(const Point3& p, const Vec3& w) const override {
    return surface_->mayHit(DPoint3(p), DVec3(w));
  }

  double power(double /*sceneRadius*/) const override {
    return luminance(L_) * area_ * std::numbers::pi * (twoSided_ ? 2 : 1);
  }
  LightBounds bounds() const override {
    return {box_, luminance(L_) * area_, surface_->normals(), 0, twoSided_};
  }

 private:
  Spectrum L_;
  bool twoSided_ = false;
  const AreaSampler* surface_;
  double area_ = 0;
  Bounds3 box_;
};

}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Diffuse, "diffuse", "a surface that glows equally into all directions")
