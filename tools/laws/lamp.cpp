#include "lamp.h"

namespace pbrt::laws {
namespace {

constexpr double kDisk = 1.5;

Transform placement() {
  return Transform::translate({0.1, 0.2, 0.3}) * Transform::rotate(50, {1, 2, 3});
}

// Where the ray from p along w meets the disk's plane.
SurfaceInteraction onDisk(const Point3& p, const Vec3& w) {
  SurfaceInteraction on;
  on.p = p - (p.z / w.z) * w;
  on.n = {0, 0, 1};
  return on;
}

}  // namespace

Lamp::Lamp(const Subject& subject) : Lamp(subject, placement()) {}

Lamp::Lamp(const Subject& subject, const Transform& toRender)
    : disk_(kDisk),
      light_(subject.make<Light>({toRender, &disk_, {{-kDisk, -kDisk, 0}, {kDisk, kDisk, 0}}})),
      bounds_(light_->bounds()) {
  if (bounds_.box.empty()) return;
  centre_ = bounds_.box.centre();
  size_ = std::max(1.F, 0.5F * glm::length(bounds_.box.diagonal()));
  if (!isPoint()) return;
  // A little beyond, too, where light would be wrong.
  const double reach = 1.2 * (std::acos(bounds_.normals.cosine) + std::acos(bounds_.cosEmission));
  if (reach < std::numbers::pi && !bounds_.twoSided) capHeight_ = 2 * sqr(std::sin(reach / 2));
}

bool Lamp::isPoint() const {
  return !bounds_.box.empty() && bounds_.box.lo == bounds_.box.hi;
}

Lamp::Direction Lamp::direction(Rng& rng) const {
  const Point2 u{rng.uniform(), rng.uniform()};
  const double everywhere = 1 / (4 * std::numbers::pi);
  if (capHeight_ == 0) return {uniformSphere(u), everywhere};
  const bool chosen = rng.uniform() < 0.5F;
  const Vec3 w = chosen ? uniformCone(u, static_cast<float>(capHeight_)) : uniformSphere(u);
  // 1 - cos = |w - z|^2 / 2 does not cancel in a narrow cone.
  const bool within = chosen || lengthSquared(w - Vec3(0, 0, 1)) <= 2 * capHeight_;
  return {Frame::fromZ(bounds_.normals.axis).fromLocal(w),
          (everywhere + (within ? 1 / (2 * std::numbers::pi * capHeight_) : 0)) / 2};
}

Point3 Lamp::place(Rng& rng) const {
  const Vec3 w = direction(rng).w;
  return centre_ + 5 * size_ * rng.uniform() * w;
}

Spectrum Lamp::radiance(const Point3& p, const Vec3& w) const {
  if (light_->isInfinite()) return light_->escaped(w);
  if (!light_->mayHit(p, w)) return Spectrum(0);
  const SurfaceInteraction on = onDisk(p, w);
  return light_->emitted(on.p, on.n, -w);
}

double Lamp::pdf(const Point3& p, const Vec3& w) const {
  if (light_->isInfinite()) return light_->pdfEscaped(w);
  return light_->mayHit(p, w) ? light_->pdf(p, onDisk(p, w)) : 0;
}

std::unique_ptr<Light> withoutSurface(const Subject& subject) {
  return subject.make<Light>({placement()});
}

}  // namespace pbrt::laws
