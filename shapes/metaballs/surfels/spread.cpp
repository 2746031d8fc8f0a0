// How surfels get to where there are too few.

#include <array>
#include <optional>

#include "core/base/frame.h"
#include "core/base/rng.h"
#include "shapes/metaballs/surfels/chunks.h"
#include "shapes/metaballs/surfels/state.h"

namespace pbrt::surfels {
namespace {

// Surfels within the reach of one that is not spared.
constexpr float kFew = 4;

// Places looked at in a step at which no hole is found.
constexpr std::size_t kLooks = 192;
// In a step of which many show holes, one for so many surfels at most.
constexpr std::size_t kSurfelsForALook = 32;

// Counts of neighbours that differ by less than this part do so by chance.
constexpr float kByChance = 0.15F;

// The unit vector across n in a direction, given as a part of the circle.
DVec3 across(const Normal3& n, float part) {
  const Frame frame = Frame::fromZ(n);
  return DVec3(std::cos(2 * kPi * part) * frame.x + std::sin(2 * kPi * part) * frame.y);
}

}  // namespace

// Dispersion (van Kooten et al. 2007, section 4.2): the surfel beside which this one is to go on,
// or itself. By sigma one cannot tell a piece with too few surfels from one in which they lie more
// evenly, so counts are compared, averaged until chance is small. The chance to go is the part by
// which the partner has less. Of two pieces with the shares a and b of the area and the densities A
// and B, the first has a A n surfels, of which the part b B (A - B) / A go to the other: as a A + b
// B = 1, (A - 1) falls by the factor 1 - B in a step, whatever the shares are.
std::size_t Simulation::State::partner(std::size_t i) const {
  const std::uint64_t random = hash(settings_.seed, steps_, i);
  const std::size_t other = (random >> 32U) * surfels_.size() >> 32U;
  const float less = 1 - crowding_[other] / crowding_[i];
  return uniformFloat(static_cast<std::uint32_t>(random)) < less - kByChance ? other : i;
}

// A place on the edge of the influence of surfel i, that goes to `at`, in any direction.
Landing Simulation::State::beside(std::size_t i, Landing at) const {
  const auto random = static_cast<std::uint32_t>(hash(settings_.seed, steps_, i, 1));
  at.p += report_.reach * across(surfels_[i].n, uniformFloat(random));
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
    land(field, {&found[first], n});
  });
  looked_ += places;
  std::erase_if(found, [](const Landing& l) { return !l.there; });
  return found;
}

void Simulation::State::set(std::size_t i, const Landing& landing) {
  motions_[i] = {};
  place(i, landing);
  surfels_[i].density = 1;
  surfels_[i].radius = static_cast<float>(report_.reach);
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
  std::size_t done = 0;
  for (int round = 0; round < 4 && done < lost_.size(); ++round) {
    const auto more = look(field, lost_.size() - done);
    for (const Landing& l : more) set(lost_[done++], l);
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

// What is found uncovered is closed by one surfel a cell, where there is no other within the reach
// by seven, as in a honeycomb: so new pieces are covered at once. They come from where sigma is
// great.
bool Simulation::State::closeHoles(const MovingField& field) {
  struct Hole {
    std::uint64_t key = 0;
    bool wide = true;
    Landing at;
  };
  // The hole about a place, unless a disc covers it.
  const auto holeAt = [&](const Landing& l) {
    Hole hole{0, true, l};
    const bool covered = neighbours_.any(l.p, [&](std::size_t i) {
      const Surfel& s = surfels_[i];
      if (glm::dot(DVec3(s.n), l.gradient) >= 0) return false;
      const double square = lengthSquared(s.p - l.p);
      hole.wide = hole.wide && square > sqr(report_.reach);
      return square <= sqr(static_cast<double>(s.radius));
    });
    return covered ? std::nullopt : std::optional(hole);
  };
  std::vector<Hole> holes;
  const std::size_t most = surfels_.size() / kSurfelsForALook;
  for (std::size_t looks = kLooks, all = looks, before = 0;; before = holes.size()) {
    const auto places = look(field, looks);
    report_.looked += places.size();
    for (const Landing& l : places)
      if (const auto hole = holeAt(l)) holes.push_back(*hole);
    if (64 * (holes.size() - before) <= places.size() || all >= most) break;
    looks = std::min(2 * looks, most - all), all += looks;
  }
  report_.holes = holes.size();
  // The surfels are to cover the part of the area that is not covered, too.
  if (4 * holes.size() > report_.looked) {
    const auto looked = static_cast<double>(report_.looked);
    report_.reach *= std::sqrt(looked / (looked + 1 - static_cast<double>(holes.size())));
    sort();
  }
  for (Hole& hole : holes) hole.key = neighbours_.keyAt(hole.at.p);
  const auto byKey = [](const Hole& a, const Hole& b) { return a.key < b.key; };
  std::stable_sort(holes.begin(), holes.end(), byKey);
  bool any = false;
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const Hole& hole = holes[k];
    if (k > 0 && holes[k - 1].key == hole.key) continue;
    std::array<Landing, 7> places;
    places.fill({hole.at.p});
    const std::size_t n = hole.wide ? 7 : 1;
    const Normal3 normal(-glm::normalize(hole.at.gradient));
    for (std::size_t i = 1; i < n; ++i)
      places[i].p += 0.5 * report_.reach * across(normal, static_cast<float>(i) / 6);
    land(field, {places.data(), n});
    for (std::size_t i = 0; i < n; ++i)
      if (places[i].there && glm::dot(places[i].gradient, hole.at.gradient) > 0)
        any = moveCrowded(places[i]) || any;
  }
  return any;
}

// Sets a surfel of which the neighbours are many at a place where there is none. One that has
// hardly any is needed where it is.
bool Simulation::State::moveCrowded(const Landing& place) {
  Rng rng(hash(settings_.seed, steps_, report_.moved));
  const auto count = static_cast<std::uint32_t>(surfels_.size());
  std::size_t crowded = rng.uniform(count);
  for (int i = 0; i < 8; ++i)
    if (const std::size_t other = rng.uniform(count);
        surfels_[other].density > surfels_[crowded].density)
      crowded = other;
  if (motions_[crowded].crowding < kFew) return false;
  set(crowded, place);
  ++report_.moved;
  return true;
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
