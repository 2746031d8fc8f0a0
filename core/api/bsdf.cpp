#include "core/api/bsdf.h"

#include "core/base/lowdiscrepancy.h"
#include "core/base/warp.h"

namespace pbrt {

float Bxdf::pdf(const Vec3& wo, const Vec3& wi) const {
  return sameHemisphere(wo, wi) ? cosHemispherePdf(absCosTheta(wi)) : 0;
}

std::optional<BsdfSample> Bxdf::sample(const Vec3& wo, Point2 u) const {
  BsdfSample s;
  s.wi = cosHemisphere(u);
  if (wo.z < 0) s.wi.z = -s.wi.z;
  s.pdf = pdf(wo, s.wi);
  if (!(s.pdf > 0)) return {};
  s.f = f(wo, s.wi);
  return s;
}

float Bxdf::weight(const Vec3& /*wo*/) const {
  return 1;
}

namespace {

// `wanted` without the lobes that have nothing to say about this pair of directions: those of the
// other side of the surface, and the specular ones.
std::uint8_t onSide(const Vec3& wo, const Vec3& wi, const Normal3& n, std::uint8_t wanted) {
  const bool reflected = glm::dot(wo, n) * glm::dot(wi, n) > 0;
  return static_cast<std::uint8_t>(wanted & ~(reflected ? kTransmission : kReflection) &
                                   ~kSpecular);
}

// Another lobe, scaled.
class Scaled final : public Bxdf {
 public:
  Scaled(const Bxdf& lobe, const Spectrum& by) : Bxdf(lobe.flags()), lobe_(lobe), by_(by) {}
  Spectrum f(const Vec3& wo, const Vec3& wi) const override { return by_ * lobe_.f(wo, wi); }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return lobe_.pdf(wo, wi); }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    auto s = lobe_.sample(wo, u);
    if (s) s->f *= by_;
    return s;
  }
  float weight(const Vec3& wo) const override { return luminance(by_) * lobe_.weight(wo); }

 private:
  const Bxdf& lobe_;
  Spectrum by_;
};

}  // namespace

void Bsdf::scale(int first, const Spectrum& by, Scratch& scratch) {
  if (isBlack(by)) count_ = first;
  if (by == Spectrum(1)) return;
  for (int i = first; i < count_; ++i) lobes_[i] = place<Scaled>(scratch, *lobes_[i], by);
}

bool Bsdf::has(std::uint8_t kinds) const {
  for (int i = 0; i < count_; ++i)
    if (lobes_[i]->flags() & kinds) return true;
  return false;
}

int Bsdf::lobes(std::uint8_t wanted) const {
  int n = 0;
  for (int i = 0; i < count_; ++i) n += lobes_[i]->matches(wanted);
  return n;
}

Spectrum Bsdf::f(const Vec3& wo, const Vec3& wi, std::uint8_t wanted) const {
  const std::uint8_t side = onSide(wo, wi, n_, wanted);
  const Vec3 o = frame_.toLocal(wo), i = frame_.toLocal(wi);
  Spectrum f(0);
  for (int l = 0; l < count_; ++l)
    if (lobes_[l]->matches(side)) f += lobes_[l]->f(o, i);
  return f;
}

float Bsdf::chances(const Vec3& wo, std::uint8_t wanted, Chances& chances) const {
  if (count_ == 1) return chances[0] = lobes_[0]->matches(wanted) ? 1.F : 0.F;
  float sum = 0;
  for (int l = 0; l < count_; ++l)
    sum += chances[l] = lobes_[l]->matches(wanted) ? lobes_[l]->weight(wo) : 0;
  return sum;
}

float Bsdf::pdf(const Vec3& wo, const Vec3& wi, std::uint8_t wanted) const {
  const Vec3 o = frame_.toLocal(wo), i = frame_.toLocal(wi);
  Chances chance;
  const float total = chances(o, wanted, chance);
  float sum = 0;
  for (int l = 0; l < count_; ++l)
    if (chance[l] > 0 && !(lobes_[l]->flags() & kSpecular)) sum += chance[l] * lobes_[l]->pdf(o, i);
  return sum > 0 ? sum / total : 0;
}

std::optional<BsdfSample> Bsdf::sample(const Vec3& wo, Point2 u, std::uint8_t wanted) const {
  const Vec3 o = frame_.toLocal(wo);
  Chances chance;
  const float total = chances(o, wanted, chance);
  if (!(total > 0)) return {};
  int chosen = 0;
  float rest = u.x * total;
  for (int l = 0; l < count_; ++l) {
    if (!(chance[l] > 0)) continue;
    chosen = l;
    if (rest < chance[l]) break;
    rest -= chance[l];
  }
  const Bxdf& lobe = *lobes_[chosen];

  u.x = std::min(rest / chance[chosen], kOneMinusEpsilon);
  std::optional<BsdfSample> s = lobe.sample(o, u);
  if (!s || !(s->pdf > 0)) return {};
  const Vec3 i = s->wi;
  s->wi = frame_.fromLocal(i);
  s->flags = lobe.flags();
  s->pdf *= chance[chosen];
  if (!(lobe.flags() & kSpecular)) {
    const std::uint8_t side = onSide(wo, s->wi, n_, wanted);
    if (!lobe.matches(side)) s->f = Spectrum(0);
    for (int l = 0; l < count_; ++l) {
      if (l == chosen) continue;
      if (chance[l] > 0 && !(lobes_[l]->flags() & kSpecular))
        s->pdf += chance[l] * lobes_[l]->pdf(o, i);
      if (lobes_[l]->matches(side)) s->f += lobes_[l]->f(o, i);
    }
  }
  s->pdf /= total;
  return s;
}

Spectrum Bsdf::rho(const Vec3& wo) const {
  // Points of Hammersley's set, in the middle of their cells: on the edge of the unit square lies
  // the horizon.
  constexpr std::uint32_t kPoints = 24, kHalfCell = 1U << 26U;
  const Vec3 normal = frame_.fromLocal({0, 0, 1});
  Spectrum sum(0);
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const Point2 u((static_cast<float>(i) + 0.5F) / kPoints,
                   uniformFloat(reverseBits(i) + kHalfCell));
    if (const auto s = sample(wo, u))
      sum += s->f * (std::abs(glm::dot(s->wi, normal)) * sqr(s->eta) / s->pdf);
  }
  return sum / static_cast<float>(kPoints);
}

}  // namespace pbrt
