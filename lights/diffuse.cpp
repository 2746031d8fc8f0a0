#include "core/plugin/plugin.h"

namespace pbrt {

class Diffuse final : public Light {
 public:
  Diffuse(Params& p, const Setup& setup)
      : L_(p.emission("L", Spectrum(1), "radiance that every point emits into all directions")),
        surface_(setup.surface) {
    L_ *= p.spectrum("scale", Spectrum(1), "multiplies L");
    twoSided_ = p.flag("twosided", false, "emits on both sides, not only on the normal's");
    constexpr int most = 1 << 20;
    const int n = p.integer("nsamples", 1, 1, most, "shadow rays that direct lighting takes");
    samples_ = p.integer("samples", n, 1, most, "another name of nsamples, which it overrides");
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

 private:
  Spectrum L_;
  bool twoSided_ = false;
  const AreaSampler* surface_;
};

}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Diffuse, "diffuse", "a surface that glows equally into all directions")
