#include "shapes/metaballs/surfels/coverage.h"

#include "core/base/parallel.h"
#include "shapes/metaballs/surfels/landing.h"

namespace pbrt::surfels {
namespace {

constexpr std::size_t kRun = 32;     // surfels that share a box
constexpr std::size_t kChunk = 128;  // places a task looks at

// Surfels that follow one another, and the box that holds their centres.
struct Run {
  std::span<const Surfel> surfels;
  DPoint3 lo{std::numeric_limits<double>::infinity()}, hi{-lo};
  double radius = 0;  // the greatest

  explicit Run(std::span<const Surfel> run) : surfels(run) {
    for (const Surfel& s : run) {
      lo = glm::min(lo, s.p);
      hi = glm::max(hi, s.p);
      radius = std::max<double>(radius, s.radius);
    }
  }
  double distanceSquared(const DPoint3& p) const {
    return lengthSquared(glm::max(DVec3(0), glm::max(lo - p, p - hi)));
  }
};

// Whether a place is covered, and whether it is near.
std::pair<bool, bool> look(std::span<const Run> runs, const Place& place, double within) {
  bool covered = false, near = false;
  for (const Run& run : runs) {
    if (run.distanceSquared(place.p) > sqr(std::max(run.radius, within))) continue;
    for (const Surfel& s : run.surfels) {
      if (glm::dot(s.n, place.n) <= 0) continue;
      const double d2 = lengthSquared(s.p - place.p);
      covered |= d2 <= sqr(static_cast<double>(s.radius));
      near |= d2 <= sqr(within);
    }
    if (covered && near) break;
  }
  return {covered, near};
}

}  // namespace

std::vector<Place> places(const MovingField& field, std::uint64_t first, std::size_t count) {
  std::vector<DPoint3> seeds(count);
  std::vector<Place> found;
  if (!field.seeds(first, seeds)) return found;
  std::vector<Landing> landings(count);
  for (std::size_t i = 0; i < count; ++i) landings[i].p = seeds[i];
  land(field, landings);
  for (const Landing& l : landings)
    if (l.there) found.push_back({l.p, Normal3(-glm::normalize(l.gradient))});
  return found;
}

Coverage coverage(std::span<const Surfel> surfels, std::span<const Place> places, double within) {
  if (places.empty()) return {};
  std::vector<Run> runs;
  for (std::size_t i = 0; i < surfels.size(); i += kRun)
    runs.emplace_back(surfels.subspan(i, std::min(kRun, surfels.size() - i)));
  // What is missing is summed up, so that a whole cover is exactly one.
  std::vector<Coverage> missing((places.size() + kChunk - 1) / kChunk, {0, 0});
  parallelFor(missing.size(), [&](std::size_t chunk) {
    const std::size_t begin = chunk * kChunk;
    for (const Place& place : places.subspan(begin, std::min(kChunk, places.size() - begin))) {
      const auto [covered, near] = look(runs, place, within);
      if (!covered) missing[chunk].covered += place.weight;
      if (!near) missing[chunk].near += place.weight;
    }
  });
  Coverage sum{0, 0};
  for (const Coverage& part : missing) {
    sum.covered += part.covered;
    sum.near += part.near;
  }
  double weight = 0;
  for (const Place& place : places) weight += place.weight;
  return {1 - sum.covered / weight, 1 - sum.near / weight};
}

}  // namespace pbrt::surfels
