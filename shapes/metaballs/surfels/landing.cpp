#include "shapes/metaballs/surfels/landing.h"

#include <array>

namespace pbrt::surfels {
namespace {

constexpr std::size_t kBatch = 256;

// Looks at the field along a path that has not yet met both sides of the surface, and gets no
// nearer; and in all: a bisection of a step halves it to the last bit of a double in 53.
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
bool goOn(int look, double stride, const FieldAt& at, Path& path, Landing& l) {
  const double slope = glm::length(at.gradient), distance = std::abs(at.value);
  if (!std::isfinite(at.value) || !std::isfinite(slope) || !isFinite(at.flow)) return false;
  if (distance <= kOnSurface) {
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
  } else if (!(slope > 0) || (look >= kWandering && slow && !path.bracketed())) {
    return false;
  } else {
    l.p -= std::clamp(at.value / slope, -stride, stride) * (at.gradient / slope);
  }
  return true;
}

}  // namespace

void land(const MovingField& field, std::span<Landing> points) {
  const double stride = 0.5 * field.grain();
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
        if (goOn(look, stride, answers[k], paths[under[k]], batch[under[k]]))
          under[kept++] = under[k];
      left = kept;
    }
  }
}

}  // namespace pbrt::surfels
