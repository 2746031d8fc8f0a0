// The laws of shapes that are implicit surfaces, held against their own fields.

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "shape_laws.h"
#include "shape_probe.h"

namespace pbrt::laws {
namespace {

using laws::show;
std::string show(const Range& r) {
  return fmt::format("[{:.9g}, {:.9g}]", r.lo, r.hi);
}

constexpr int kRays = 1000;

// The shape, its field, and places about it.
class Trial {
 public:
  Trial(const Subject& subject, Judge& judge) : probe_(subject), field_(probe_.shape().implicit()) {
    if (!field_) {
      judge.skip("it is no implicit surface");
      return;
    }
    const Bounds3 box = field_->bounds();
    if (!judge.expect(!box.empty() && isFinite(box.lo) && isFinite(box.hi),
                      "the bounds of the field, from {} to {}, are empty or not finite",
                      show(DVec3(box.lo)), show(DVec3(box.hi))))
      field_ = nullptr;
    lo_ = DPoint3(box.lo), hi_ = DPoint3(box.hi);
  }
  explicit operator bool() const { return field_ != nullptr; }

  const Shape& shape() const { return probe_.shape(); }
  const ImplicitField& field() const { return *field_; }
  double size() const { return glm::length(hi_ - lo_); }
  double uniform() { return rng_.uniform(); }
  DVec3 direction() {
    return glm::normalize(DVec3(uniformSphere({rng_.uniform(), rng_.uniform()})));
  }
  DPoint3 inBounds() { return within(lo_, hi_); }
  DPoint3 within(const DPoint3& lo, const DPoint3& hi) {
    const DVec3 u(uniform(), uniform(), uniform());
    return glm::clamp(lo + u * (hi - lo), lo, hi);
  }
  // From the size of the bounds down to 2^-30 of it.
  double anySize() { return size() * std::exp2(-30 * uniform()); }
  // From outside of the bounds through them; t runs from 0 to 1 as long as it is near.
  ObjectRay ray() {
    const DPoint3 middle = 0.5 * (lo_ + hi_);
    const DPoint3 o = middle + size() * direction();
    return {o, 2.0 * (inBounds() - o), 0, 1};
  }
  std::optional<Found> nearest(const ObjectRay& ray) const { return probe_.nearest(ray); }

 private:
  ShapeProbe probe_;
  const ImplicitField* field_ = nullptr;
  DPoint3 lo_{}, hi_{};
  Rng rng_{17};
};

void rangesHold(const Subject& subject, Judge& judge) {
  Trial trial(subject, judge);
  if (!trial) return;
  const auto holds = [&](const Range& r, double x) { return std::isnan(x) || r.contains(x); };
  for (int i = 0; i < 2000; ++i) {
    const DPoint3 lo = trial.inBounds();
    const DPoint3 hi =
        lo + trial.anySize() * DVec3(trial.uniform(), trial.uniform(), trial.uniform());
    const FieldRange range = trial.field().over(lo, hi);
    for (int k = 0; k < 8; ++k) {
      const DPoint3 p = k == 0 ? lo : k == 1 ? hi : trial.within(lo, hi);
      const FieldPoint at = trial.field().at(p);
      judge.expect(
          holds(range.value, at.value),
          "over the box from {} to {} the field is said to be in {}, but at {} it is {:.9g}",
          show(lo), show(hi), show(range.value), show(p), at.value);
      if (std::isnan(at.value)) continue;
      for (int axis = 0; axis < 3; ++axis)
        judge.expect(holds(range.gradient[axis], at.gradient[axis]),
                     "over the box from {} to {} component {} of the gradient is said to be in {}, "
                     "but at {} it is {:.9g}",
                     show(lo), show(hi), axis, show(range.gradient[axis]), show(p),
                     at.gradient[axis]);
    }
    const DVec3 u = trial.direction();
    const double length = trial.anySize();
    const LineRange line = trial.field().along(lo, u, {-length, length}, 0);
    for (int k = 0; k < 8; ++k) {
      const DPoint3 p = lo + (2 * trial.uniform() - 1) * length * u;
      const double value = trial.field().at(p).value;
      // The point is rounded: a look at the box about it tells what that may do.
      const double blur = 1e-15 * (glm::length(lo) + length);
      const Range about = trial.field().over(p - blur, p + blur).value;
      judge.expect(
          std::isnan(value) || (line.value.lo <= about.hi && about.lo <= line.value.hi),
          "along {} + s {} for |s| <= {:.9g} the field is said to be in {}, but at {} it is "
          "{:.9g}",
          show(lo), show(u), length, show(line.value), show(p), value);
    }
  }
}

void rangesShrink(const Subject& subject, Judge& judge) {
  Trial trial(subject, judge);
  if (!trial) return;
  for (int i = 0; i < 2000; ++i) {
    const DPoint3 p = trial.inBounds();
    const FieldPoint at = trial.field().at(p);
    const double scale = std::abs(at.value) + glm::length(at.gradient) * trial.size();
    if (!std::isfinite(scale)) continue;
    const Range value = trial.field().over(p, p).value;
    judge.expect(
        value.width() <= 1e-6 * scale + 1e-300,
        "at the point {} the field is {:.9g}, but over a box that is this point alone it is "
        "said to be in {}: searches cannot end",
        show(p), at.value, show(value));
  }
}

// By the mean value theorem the difference over a short way is a slope within it.
void gradientIsThatOfTheValue(const Subject& subject, Judge& judge) {
  Trial trial(subject, judge);
  if (!trial) return;
  for (int i = 0; i < 5000; ++i) {
    const DPoint3 p = trial.inBounds();
    const DVec3 u = trial.direction();
    const double h = 1e-5 * trial.size();
    const DPoint3 a = p - h * u, b = p + h * u;
    const FieldRange about = trial.field().over(glm::min(a, b), glm::max(a, b));
    const Range slope = about.gradient[0] * u.x + about.gradient[1] * u.y + about.gradient[2] * u.z;
    if (!slope.bounded()) continue;
    const double down = trial.field().at(a).value, up = trial.field().at(b).value;
    const double blur =
        (1e-14 * (std::abs(up) + std::abs(down)) + trial.field().over(p, p).value.width()) / h +
        1e-6 * slope.magnitude();
    const double found = (up - down) / (2 * h);
    judge.expect(found >= slope.lo - blur && found <= slope.hi + blur,
                 "about {} along {} the field rises by {:.9g} a unit of length, but its gradient "
                 "there says {}",
                 show(p), show(u), found, show(slope));
  }
}

void hitsAreZeros(const Subject& subject, Judge& judge) {
  Trial trial(subject, judge);
  if (!trial) return;
  int hits = 0, inward = 0;
  std::string example;
  for (int i = 0; i < kRays; ++i) {
    const ObjectRay ray = trial.ray();
    const auto hit = trial.nearest(ray);
    if (!hit) continue;
    ++hits;
    const SurfacePoint s = trial.shape().surface(ray, hit->hit);
    const Range about = trial.field().over(s.p - s.error, s.p + s.error).value;
    judge.expect(about.contains(0),
                 "the ray o {} d {} hits at {}, which is off the surface by more than its error "
                 "{:.3g}: the field is in {} there",
                 show(ray.o), show(ray.d), show(s.p), s.error, show(about));
    const DVec3 step = std::max(1e-6 * trial.size(), 4 * s.error) * DVec3(s.n);
    if (trial.field().at(s.p + step).value > trial.field().at(s.p - step).value && inward++ == 0)
      example = show(s.p);
  }
  judge.expect(hits > 0, "{} rays through the bounds of the field hit nothing", kRays);
  judge.expect(
      inward <= hits / 50,
      "the normal points to where the field is higher, which is inside, at {} of {} points: "
      "{}",
      inward, hits, example);
}

void noCrossingIsMissed(const Subject& subject, Judge& judge) {
  Trial trial(subject, judge);
  if (!trial) return;
  constexpr int kSamples = 256;
  const Bounds3 box = trial.field().bounds();
  for (int i = 0; i < kRays; ++i) {
    const ObjectRay ray = trial.ray();
    const auto value = [&](double t) { return trial.field().at(ray.at(t)).value; };
    double last = value(0);
    for (int k = 1; k <= kSamples; ++k) {
      const double now = value(k * (1.0 / kSamples)), before = last;
      last = now;
      if (!((before < 0 && now > 0) || (before > 0 && now < 0))) continue;
      double a = (k - 1.0) / kSamples, b = k * (1.0 / kSamples);
      for (int halving = 0; halving < 45; ++halving) {
        const double m = 0.5 * (a + b);
        ((value(m) < 0) == (before < 0) ? a : b) = m;
      }
      if (!box.contains(Point3(ray.at(a)))) continue;
      // At a pole the sign changes, too.
      if (!(std::abs(value(a)) < std::min(std::abs(before), std::abs(now)))) continue;
      ObjectRay about = ray;
      about.tMin = a - 1e-6, about.tMax = a + 1e-6;
      judge.expect(
          trial.nearest(about).has_value(),
          "the ray o {} d {} crosses the surface at t = {:.9g}, where the field changes its "
          "sign, but nothing is hit there",
          show(ray.o), show(ray.d), a);
    }
  }
}

constexpr Law kLaws[] = {
    {"field-ranges-hold", "The ranges of the field hold all values and gradients that it has.",
     rangesHold},
    {"field-ranges-shrink", "The range of the field at a point is its value, but for rounding.",
     rangesShrink},
    {"field-gradient-is-its-slope", "The gradient of the field is the slope of its value.",
     gradientIsThatOfTheValue},
    {"hits-are-zeros-of-the-field",
     "Rays hit where the field is zero; normals point to where it falls.", hitsAreZeros},
    {"no-zero-of-the-field-is-missed",
     "A ray along which the field changes its sign hits the shape there.", noCrossingIsMissed}};

}  // namespace

std::span<const Law> implicitLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
