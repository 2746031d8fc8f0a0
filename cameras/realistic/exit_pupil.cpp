#include "cameras/realistic/exit_pupil.h"

#include <algorithm>

namespace pbrt {

namespace {

constexpr int kSteps = 96;
constexpr int kScan = 256;     // steps across the last surface
constexpr double kPad = 0.03;  // of the size: what lies between columns

// Of the columns, from 0 to 1.
const auto kPlaces = [] {
  std::array<double, PupilOutline::kColumns + 1> places{};
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] =
        0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / PupilOutline::kColumns);
  return places;
}();

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

}  // namespace

double PupilOutline::x(int column) const {
  return x0_ + (x1_ - x0_) * kPlaces[static_cast<std::size_t>(column)];
}

PupilOutline PupilOutline::between(const PupilOutline& a, const PupilOutline& b, double t) {
  if (a.empty() != b.empty()) return a.empty() ? b : a;
  PupilOutline outline(lerp(t, a.x0_, b.x0_), lerp(t, a.x1_, b.x1_));
  for (std::size_t i = 0; i <= kColumns; ++i) outline.y_[i] = lerp(t, a.y_[i], b.y_[i]);
  return outline;
}

// Heights over the width w are concave. So what is shifted by pad.x is at a column of the wider
// outline at most 1 + 2 pad.x / w times as high as the column was, nor higher than the highest.
PupilOutline PupilOutline::padded(const glm::dvec2& pad) const {
  if (empty()) return {};
  const double end = 0.5 * kPad * width() + pad.x;
  PupilOutline outline(x0_ - end, x1_ + end);
  const double grown = 1 + 2 * pad.x / width(), highest = *std::ranges::max_element(y_);
  for (std::size_t i = 0; i <= kColumns; ++i)
    outline.y_[i] = (1 + kPad) * std::min(highest, grown * y_[i]) + pad.y;
  return outline;
}

glm::dvec2 PupilOutline::gap(const PupilOutline& a, const PupilOutline& b) {
  if (a.empty() || b.empty()) return glm::dvec2(0);
  glm::dvec2 largest(std::max(std::abs(a.x0_ - b.x0_), std::abs(a.x1_ - b.x1_)), 0);
  for (std::size_t i = 0; i <= kColumns; ++i)
    largest.y = std::max(largest.y, std::abs(a.y_[i] - b.y_[i]));
  return largest;
}

double PupilOutline::area() const {
  double sum = 0;
  for (int i = 0; i < kColumns; ++i) sum += area(i);
  return sum;
}

// A piece between heights b and e holds, up to the share t of its width w, the area
// w (2 b t + (e - b) t^2).
glm::dvec2 PupilOutline::sample(Point2 u) const {
  double left = u.x * area();
  int i = 0;
  for (; i + 1 < kColumns && left >= area(i); ++i) left -= area(i);
  const double b = y(i), e = y(i + 1), width = x(i + 1) - x(i);
  const double q = std::min(left / width, b + e);
  const double root = b + std::sqrt(std::max(0.0, b * b + (e - b) * q));
  const double t = root > 0 ? q / root : 0;
  return {x(i) + t * width, (2 * double{u.y} - 1) * lerp(t, b, e)};
}

// What is missed between two film points does not shrink with the stop. Of a curve it is most in
// the middle of the interval, of a bend anywhere at most twice what it is there.
ExitPupil::ExitPupil(const Lens& lens, double filmDistance, double farthest)
    : lens_(lens), distance_(filmDistance), perMm_(kSteps / farthest) {
  for (int i = 0; i <= kSteps; ++i) outlines_.push_back(find(i / perMm_));
  for (std::size_t i = 0; i < kSteps; ++i)
    pads_.push_back(2.0 *
                    PupilOutline::gap(find((static_cast<double>(i) + 0.5) / perMm_),
                                      PupilOutline::between(outlines_[i], outlines_[i + 1], 0.5)));
}

PupilOutline ExitPupil::at(double radius) const {
  const double place = radius * perMm_;
  if (!(place < kSteps)) return possible(radius);
  const auto step = static_cast<std::size_t>(place);
  return PupilOutline::between(outlines_[step], outlines_[step + 1],
                               place - static_cast<double>(step))
      .padded(pads_[step]);
}

bool ExitPupil::passes(double filmX, double x, double y) const {
  LensRay ray = filmRay(filmX, distance_, x, y);
  return lens_.trace(ray).has_value();
}

// The surface's rim, seen from the film point on the plane of its vertex, together with the disc
// that the rim encloses there if the surface is flat.
PupilOutline ExitPupil::possible(double filmX) const {
  const double shrink = distance_ / (distance_ + lens_.rearSag());
  const double rim = lens_.rearRadius(), middle = filmX * (1 - shrink);
  PupilOutline outline(std::min(-rim, middle - shrink * rim), std::max(rim, middle + shrink * rim));
  for (int i = 0; i <= PupilOutline::kColumns; ++i) outline.y(i) = std::max(1.0, shrink) * rim;
  return outline;
}

// A place of the plane from which a ray of the meridian reaches the stop's middle, for stops too
// small to be met by chance.
std::optional<double> ExitPupil::seed(double filmX, const PupilOutline& within) const {
  const auto height = [&](double x) { return lens_.stopHeight(filmRay(filmX, distance_, x, 0)); };
  const double left = within.x(0), step = within.width() / kScan;
  std::optional<double> before;
  for (int i = 0; i <= kScan; ++i) {
    const double x = left + step * i;
    const std::optional<double> h = height(x);
    if (h && before && (*h > 0) != (*before > 0)) {
      const bool positive = *before > 0;
      const double found = edge(x - step, x, [&](double middle) {
        return (height(middle).value_or(*before) > 0) == positive;
      });
      if (passes(filmX, found, 0)) return found;
    }
    before = h;
  }
  return {};
}

// The pupil is where discs seen through the lens overlap: convex, near enough, so its ends in x lie
// on the meridian, and each column is one piece about it.
PupilOutline ExitPupil::find(double filmX) const {
  const PupilOutline within = possible(filmX);
  const double left = within.x(0), step = within.width() / kScan;
  std::optional<double> first, last;
  for (int i = 0; i <= kScan; ++i)
    if (const double x = left + step * i; passes(filmX, x, 0)) {
      if (!first) first = x;
      last = x;
    }
  if (!first) first = last = seed(filmX, within);
  if (!first) return {};
  const auto onMeridian = [&](double x) { return passes(filmX, x, 0); };
  PupilOutline outline(edge(*first, *first - step, onMeridian),
                       edge(*last, *last + step, onMeridian));
  for (int i = 0; i <= PupilOutline::kColumns; ++i) {
    const double x = outline.x(i);
    outline.y(i) = edge(0, 1.01 * within.y(0), [&](double y) { return passes(filmX, x, y); });
  }
  return outline;
}

}  // namespace pbrt
