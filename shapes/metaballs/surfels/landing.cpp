#include "shapes/metaballs/surfels/landing.h"

#include <array>

namespace pbrt::surfels {
namespace {

constexpr std::size_t kBatch = 256;

// Looks at the field along a path that has not yet met both sides of the surface, and in all: a
// bisection of a step halves it to the last bit of a double in 53.
constexpr int kWandering = 12, kLooks = 80;

bool isFinite(const DVec3& v) {
  return std::isfinite(v.x + v.y + v.z);
}

// The latest points that were seen inside and outside.
struct Path {
  DPoint3 inside{}, outside{};
  bool sawInside = false, sawOutside = false;
  double last = 0;  // |f| one look ago

  bool bracketed() const { return sawInside && sawOutside; }
};

// Goes on from a look at the field. False: nothing more is to be done for the point.
class Walk {
 public:
  Walk(double dt, double reach, double stride) : dt_(dt), reach_(reach), stride_(stride) {}

  bool goOn(int look, const FieldAt& at, Path& path, Landing& l) const {
    const double slope = glm::length(at.gradient), distance = std::abs(at.value);
    if (!std::isfinite(at.value) || !std::isfinite(slope) || !isFinite(at.flow)) return false;
    const DVec3 drift = look == 0 ? lag(at, l) : DVec3(0);
    const bool drifts = slope > 0 && drift != DVec3(0);
    if (!drifts && distance <= kOnSurface) {
      l.there = slope > 0;
      l.flow = at.flow, l.gradient = at.gradient, l.value = at.value;
      return false;
    }
    (at.value > 0 ? path.inside : path.outside) = l.p;
    (at.value > 0 ? path.sawInside : path.sawOutside) = true;
    // Newton's method along the gradient, halving the way between the sides where that is no good.
    const bool slow = look > 0 && distance > 0.5 * path.last;
    path.last = distance;
    if (path.bracketed() && (slow || !(slope > 0))) {
      l.p = 0.5 * path.inside + 0.5 * path.outside;
    } else if (!(slope > 0) || (look >= kWandering && !path.bracketed())) {
      return false;
    } else {
      const DVec3 normal = at.gradient / slope;
      const double step = -at.value / slope - glm::dot(normal, drift);
      l.p += drift + std::clamp(step, -stride_, stride_) * normal;
    }
    return true;
  }

 private:
  // The velocity that carried the point was that of the start of its way. With the mean of those of
  // both ends (Heun's method) what turns stays where it is relative to the rest.
  DVec3 lag(const FieldAt& at, const Landing& l) const {
    const DVec3 d = 0.5 * dt_ * (at.flow - l.flow);
    const double length = glm::length(d);
    return length > 0.01 * reach_ && length < stride_ ? d : DVec3(0);
  }

  double dt_, reach_, stride_;
};

}  // namespace

void land(const MovingField& field, double dt, double reach, std::span<Landing> points) {
  const Walk walk(dt, reach, 0.5 * field.grain());
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    const auto batch = points.subspan(first, std::min(kBatch, points.size() - first));
    std::array<Path, kBatch> paths;
    std::array<DPoint3, kBatch> places;
    std::array<FieldAt, kBatch> answers;
    std::array<std::uint8_t, kBatch> under;  // way, the first `left` of them
    std::size_t left = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      batch[i].there = false;
      if (isFinite(batch[i].p)) under[left++] = static_cast<std::uint8_t>(i);
    }
    for (int look = 0; look < kLooks && left > 0; ++look) {
      for (std::size_t k = 0; k < left; ++k) places[k] = batch[under[k]].p;
      field.at({places.data(), left}, {answers.data(), left});
      std::size_t kept = 0;
      for (std::size_t k = 0; k < left; ++k)
        if (walk.goOn(look, answers[k], paths[under[k]], batch[under[k]])) under[kept++] = under[k];
      left = kept;
    }
  }
}

}  // namespace pbrt::surfels
