#include "cameras/realistic/exit_pupil.h"

namespace pbrt {

namespace {

constexpr int kRings = 64;
constexpr int kScan = 256;     // steps across the last surface
constexpr int kColumns = 24;   // across a pupil
constexpr double kPad = 0.01;  // of the size, for what lies between columns and between rings

LensRay filmRay(double filmX, double distance, double x, double y) {
  const DPoint3 o(filmX, 0, -distance);
  return {o, glm::normalize(DPoint3(x, y, 0) - o)};
}

// Between a place where `inside` holds and one where it does not: the last where it holds.
template <class Inside>
double edge(double in, double out, const Inside& inside) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (in + out);
    (inside(middle) ? in : out) = middle;
  }
  return in;
}

// Between two film points, t of the way.
PupilBox between(const PupilBox& a, const PupilBox& b, double t) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  const double x0 = lerp(t, a.x0, b.x0), x1 = lerp(t, a.x1, b.x1), pad = kPad * (x1 - x0);
  return {x0 - pad, x1 + pad, (1 + kPad) * std::max(a.y, b.y)};
}

}  // namespace

ExitPupil::ExitPupil(const Lens& lens, double filmDistance, double farthest)
    : lens_(lens), distance_(filmDistance), perMm_(kRings / farthest) {
  for (int i = 0; i <= kRings; ++i) boxes_.push_back(find(i / perMm_));
  axialArea_ = boxes_.front().area();
}

PupilBox ExitPupil::at(double radius) const {
  const double place = radius * perMm_;
  if (!(place < kRings)) return possible(radius);
  const auto ring = static_cast<std::size_t>(place);
  return between(boxes_[ring], boxes_[ring + 1], place - static_cast<double>(ring));
}

bool ExitPupil::passes(double filmX, double x, double y) const {
  LensRay ray = filmRay(filmX, distance_, x, y);
  return lens_.trace(ray).has_value();
}

// The surface's rim, seen from the film point on the plane of its vertex, together with the disc
// that the rim encloses there if the surface is flat.
PupilBox ExitPupil::possible(double filmX) const {
  const double shrink = distance_ / (distance_ + lens_.rearSag());
  const double rim = lens_.rearRadius(), middle = filmX * (1 - shrink);
  return {std::min(-rim, middle - shrink * rim), std::max(rim, middle + shrink * rim),
          std::max(1.0, shrink) * rim};
}

// A place of the plane from which a ray of the meridian reaches the stop's middle, for stops too
// small to be met by chance.
std::optional<double> ExitPupil::seed(double filmX, const PupilBox& within) const {
  const auto height = [&](double x) { return lens_.stopHeight(filmRay(filmX, distance_, x, 0)); };
  std::optional<double> before;
  double xBefore = 0;
  for (int i = 0; i <= kScan; ++i) {
    const double x = within.x0 + (within.x1 - within.x0) * i / kScan;
    const std::optional<double> h = height(x);
    if (h && before && (*h > 0) != (*before > 0)) {
      const bool positive = *before > 0;
      const double found = edge(xBefore, x, [&](double middle) {
        return (height(middle).value_or(*before) > 0) == positive;
      });
      if (passes(filmX, found, 0)) return found;
    }
    before = h;
    xBefore = x;
  }
  return {};
}

// The pupil is where discs seen through the lens overlap: convex, near enough, so its ends in x lie
// on the meridian, and each column is one piece about it.
PupilBox ExitPupil::find(double filmX) const {
  const PupilBox within = possible(filmX);
  const double step = (within.x1 - within.x0) / kScan;
  std::optional<double> first, last;
  for (int i = 0; i <= kScan; ++i)
    if (const double x = within.x0 + step * i; passes(filmX, x, 0)) {
      if (!first) first = x;
      last = x;
    }
  if (!first) first = last = seed(filmX, within);
  if (!first) return {};
  const auto onMeridian = [&](double x) { return passes(filmX, x, 0); };
  PupilBox box{edge(*first, *first - step, onMeridian), edge(*last, *last + step, onMeridian), 0};
  for (int i = 0; i <= kColumns; ++i) {
    const double x = box.x0 + (box.x1 - box.x0) * i / kColumns;
    if (onMeridian(x))
      box.y =
          std::max(box.y, edge(0, 1.01 * within.y, [&](double y) { return passes(filmX, x, y); }));
  }
  return box;
}

}  // namespace pbrt
