#pragma once
// Stand-ins for the parts of a scene, for watch.cpp: each passes calls on, and looks at what comes
// back.

#include <optional>

#include "core/api/bsdf.h"
#include "core/api/light.h"
#include "core/api/material.h"
#include "core/api/sampler.h"
#include "core/plugin/culprit.h"
#include "core/scene/moving_camera.h"

namespace pbrt {

// The first who was found.
struct Finding {
  bool found = false;
  const PluginCode* culprit = nullptr;

  // Looks at what an object gave.
  void expect(bool finite, const PluginCode* of) {
    if (finite || found) return;
    found = true;
    culprit = of;
  }
};

inline bool allFinite(const Ray& ray) {
  return isFinite(ray.o) && isFinite(ray.d);
}
inline bool allFinite(const SurfaceInteraction& s) {
  return isFinite(s.p) && isFinite(s.n) && isFinite(s.ns) && isFinite(Vec3(s.uv, s.error)) &&
         isFinite(s.dpdu) && isFinite(s.dpdv);
}
inline bool isUniform(Point2 u) {
  return u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1;
}

class WatchedSampler final : public Sampler {
 public:
  WatchedSampler(std::unique_ptr<Sampler> sampler, Finding& finding)
      : Sampler(sampler->samplesPerPixel()), sampler_(std::move(sampler)), finding_(&finding) {}
  std::unique_ptr<Sampler> clone() const override {
    return std::make_unique<WatchedSampler>(sampler_->clone(), *finding_);
  }
  void start(Point2i pixel, std::uint32_t index) override { sampler_->start(pixel, index); }
  Point2 pixel2D() override { return seen(sampler_->pixel2D()); }
  float get1D() override { return seen(Point2(sampler_->get1D())).x; }
  Point2 get2D() override { return seen(sampler_->get2D()); }
  void get2D(std::span<Point2> points) override {
    sampler_->get2D(points);
    for (const Point2& p : points) seen(p);
  }

 private:
  Point2 seen(Point2 u) const {
    finding_->expect(isUniform(u), pluginOf(*sampler_));
    return u;
  }

  std::unique_ptr<Sampler> sampler_;
  Finding* finding_;
};

class WatchedCamera final : public Camera {
 public:
  WatchedCamera(const Camera& camera, Finding& finding) : camera_(camera), finding_(finding) {
    const auto* moving = dynamic_cast<const MovingCamera*>(&camera);
    maker_ = pluginOf(moving ? moving->atStart() : camera);
  }
  CameraRay generate(const CameraSample& sample, bool differentials) const override {
    const CameraRay c = camera_.generate(sample, differentials);
    finding_.expect(c.weight == 0 || (std::isfinite(c.weight) && allFinite(c.ray)), maker_);
    return c;
  }
  bool usesLens() const override { return camera_.usesLens(); }

 private:
  const Camera& camera_;
  Finding& finding_;
  const PluginCode* maker_;
};

class WatchedLight final : public Light {
 public:
  WatchedLight(const Light& light, Finding& finding) : light_(light), finding_(finding) {
    samples_ = light.samples();
    number = light.number;
  }
  double power(double sceneRadius) const override { return light_.power(sceneRadius); }
  LightBounds bounds() const override { return light_.bounds(); }
  LightSample sample(const Point3& p, Point2 u) const override {
    const LightSample s = light_.sample(p, u);
    seen(s.pdf);
    if (s.pdf != 0) seen(s.L), seen(s.wi), seen(s.finite ? s.p : s.wi);
    return s;
  }
  bool isDelta() const override { return light_.isDelta(); }
  Spectrum emitted(const Point3& p, const Normal3& n, const Vec3& w) const override {
    return seen(light_.emitted(p, n, w));
  }
  float pdf(const Point3& p, const SurfaceInteraction& on) const override {
    return seen(light_.pdf(p, on));
  }
  bool mayHit(const Point3& p, const Vec3& w) const override { return light_.mayHit(p, w); }
  bool isInfinite() const override { return light_.isInfinite(); }
  Spectrum escaped(const Vec3& w) const override { return seen(light_.escaped(w)); }
  float pdfEscaped(const Vec3& w) const override { return seen(light_.pdfEscaped(w)); }

 private:
  template <class Value>
  Value seen(const Value& value) const {
    finding_.expect(isFinite(Vec3(value)), pluginOf(light_));
    return value;
  }

  const Light& light_;
  Finding& finding_;
};

class WatchedLobe final : public Bxdf {
 public:
  // Of `material`, unless the lobe is itself of a plug-in, as in a mix of materials.
  WatchedLobe(const Bxdf& lobe, const Material& material, Finding& finding)
      : Bxdf(lobe.flags()), lobe_(lobe), finding_(finding), maker_(pluginOf(lobe)) {
    if (!maker_) maker_ = pluginOf(material);
  }
  Spectrum f(const Vec3& wo, const Vec3& wi) const override { return seen(lobe_.f(wo, wi)); }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return seen(lobe_.pdf(wo, wi)); }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    const auto s = lobe_.sample(wo, u);
    if (s) seen(s->f), seen(s->wi), seen(s->pdf);
    return s;
  }
  float weight(const Vec3& wo) const override { return seen(lobe_.weight(wo)); }

 private:
  template <class Value>
  Value seen(const Value& value) const {
    finding_.expect(isFinite(Vec3(value)), maker_);
    return value;
  }

  const Bxdf& lobe_;
  Finding& finding_;
  const PluginCode* maker_;
};

}  // namespace pbrt
