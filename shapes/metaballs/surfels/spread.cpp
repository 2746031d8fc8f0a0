// How surfels get to where there are too few.

#include <array>

#include "core/base/frame.h"
#include "core/base/rng.h"
#include "shapes/metaballs/surfels/chunks.h"
#include "shapes/metaballs/surfels/state.h"

namespace pbrt::surfels {

// Dispersion (van Kooten et al. 2007, section 4.2): the surfel beside which this one is to go on,
// or itself.
std::size_t Simulation::State::partner(std::size_t i) const {
  const std::uint64_t random = hash(settings_.seed, steps_, i);
  const std::size_t other = (random >> 32U) * surfels_.size() >> 32U;
  const float share = uniformFloat(static_cast<std::uint32_t>(random));
  const bool goes =
      share < evenness_ - 0.1F && surfels_[i].density - surfels_[other].density > kWorthWhile;
  return goes ? other : i;
}

// A place on the edge of the influence of surfel i, that goes to `at`, in any direction.
Landing Simulation::State::beside(std::size_t i, Landing at) const {
  const float angle =
      2 * kPi * uniformFloat(static_cast<std::uint32_t>(hash(settings_.seed, steps_, i, 1)));
  const Frame frame = Frame::fromZ(surfels_[i].n);
  at.p += report_.reach * DVec3(std::cos(angle) * frame.x + std::sin(angle) * frame.y);
  return at;
}

// As many of the places on the surface as there are.
std::vector<Landing> Simulation::State::look(const MovingField& field, std::size_t places) {
  constexpr std::size_t kSeeds = 32;
  std::vector<Landing> found(places);
  parallelFor((places + kSeeds - 1) / kSeeds, [&](std::size_t chunk) {
    std::array<DPoint3, kSeeds> seeds;
    const std::size_t first = chunk * kSeeds, n = std::min(kSeeds, places - first);
    if (!field.seeds(looked_ + first, {seeds.data(), n})) return;
    for (std::size_t i = 0; i < n; ++i) found[first + i].p = seeds[i];
    land(field, 0, report_.reach, {&found[first], n});
  });
  looked_ += places;
  std::erase_if(found, [](const Landing& l) { return !l.there; });
  return found;
}

void Simulation::State::setAnew(const MovingField& field) {
  const bool first = surfels_.empty();
  if (first) {
    surfels_.resize(settings_.count), motions_.resize(settings_.count);
    for (std::size_t i = 0; i < settings_.count; ++i)
      lost_.push_back(static_cast<std::uint32_t>(i));
  }
  const bool most = 2 * lost_.size() >= surfels_.size();
  report_.moved += lost_.size();
  const auto set = [&](std::size_t i, const Landing& l) {
    place(i, l);
    std::fill(std::begin(motions_[i].push), std::end(motions_[i].push), 0.F);
    surfels_[i].density = 1;
    surfels_[i].radius = static_cast<float>(report_.reach);
  };
  std::vector<Landing> places;
  std::size_t done = 0;
  for (int round = 0; round < 4 && done < lost_.size(); ++round) {
    const auto more = look(field, lost_.size() - done);
    for (const Landing& l : more) set(lost_[done++], l);
    places.insert(places.end(), more.begin(), more.end());
  }
  // Where seeds are rare, one must do for several.
  if (done < lost_.size()) {
    std::vector<std::uint8_t> isLost(surfels_.size());
    for (std::size_t k = done; k < lost_.size(); ++k) isLost[lost_[k]] = 1;
    std::vector<std::uint32_t> good;
    for (std::size_t i = 0; i < surfels_.size(); ++i)
      if (isLost[i] == 0) good.push_back(static_cast<std::uint32_t>(i));
    if (good.empty()) {
      surfels_.clear(), motions_.clear();
      return;
    }
    for (; done < lost_.size(); ++done) {
      const std::uint32_t like = good[done % good.size()];
      surfels_[lost_[done]] = surfels_[like], motions_[lost_[done]] = motions_[like];
    }
  }
  if (most && !surfels_.empty()) guessReach(field.grain());
}

bool Simulation::State::closeHoles(const MovingField& field) {
  const auto covered = [&](const Landing& l) {
    return neighbours_.any(l.p, [&](std::size_t i) {
      const Surfel& s = surfels_[i];
      return lengthSquared(s.p - l.p) <= sqr(static_cast<double>(s.radius)) &&
             glm::dot(DVec3(s.n), l.gradient) < 0;
    });
  };
  struct Hole {
    std::uint64_t key = 0;
    Landing at;
  };
  std::vector<Hole> holes;
  for (std::size_t looks = 192, before = 0;; looks *= 2, before = holes.size()) {
    const auto places = look(field, looks);
    report_.looked += places.size();
    for (const Landing& l : places)
      if (!covered(l)) holes.push_back({neighbours_.keyAt(l.p), l});
    if (16 * (holes.size() - before) <= places.size() || 8 * looks > surfels_.size()) break;
  }
  report_.holes = holes.size();
  // One for each cell: those in a hole together are near each other.
  std::stable_sort(holes.begin(), holes.end(),
                   [](const Hole& a, const Hole& b) { return a.key < b.key; });
  holes.erase(std::unique(holes.begin(), holes.end(),
                          [](const Hole& a, const Hole& b) { return a.key == b.key; }),
              holes.end());
  bool any = false;
  Rng rng(hash(settings_.seed, steps_));
  for (const Hole& hole : holes) {
    std::size_t crowded = rng.uniform(static_cast<std::uint32_t>(surfels_.size()));
    for (int i = 0; i < 8; ++i) {
      const std::size_t other = rng.uniform(static_cast<std::uint32_t>(surfels_.size()));
      if (surfels_[other].density > surfels_[crowded].density) crowded = other;
    }
    if (surfels_[crowded].density < 1 + kWorthWhile) continue;
    place(crowded, hole.at);
    std::fill(std::begin(motions_[crowded].push), std::end(motions_[crowded].push), 0.F);
    surfels_[crowded].density = 1;
    ++report_.moved;
    any = true;
  }
  return any;
}

// The distance within which the half of a few surfels have as many neighbours as all are to have.
void Simulation::State::guessReach(double least) {
  constexpr std::size_t kSurfels = 63;
  std::array<double, kSurfels> squares;
  const std::size_t neighbours = std::min<std::size_t>(14, surfels_.size() - 1);
  parallelFor(kSurfels, [&](std::size_t k) {
    std::vector<double> distances(surfels_.size());
    const DPoint3 p = surfels_[hash(settings_.seed, steps_, k) % surfels_.size()].p;
    for (std::size_t i = 0; i < surfels_.size(); ++i)
      distances[i] = lengthSquared(surfels_[i].p - p);
    std::nth_element(distances.begin(), distances.begin() + neighbours, distances.end());
    squares[k] = distances[neighbours];
  });
  std::nth_element(squares.begin(), squares.begin() + kSurfels / 2, squares.end());
  report_.reach = std::sqrt(squares[kSurfels / 2]);
  if (!(report_.reach > 0)) report_.reach = least;
  for (Surfel& s : surfels_) s.radius = static_cast<float>(report_.reach);
}

}  // namespace pbrt::surfels
