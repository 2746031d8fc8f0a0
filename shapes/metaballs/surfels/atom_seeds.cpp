// Places on the surface of moving atoms, spread by its area.
//
// Places near the surface are found by trial. An atom is chosen by the area of its support, and a
// point of the support by the density S_j = min(1, |w_j| K_j): the cut keeps points near the
// surface of an atom that is far above the threshold. Atoms overlap, so that over all of them the
// density is D = sum S_j, which is next to 1 where few or many atoms together reach the threshold.
// A point is kept if it is within a part of h_j of the surface, by the distance |f| / |grad f| of
// the first order, and then with a probability proportional to 1 / D: such a shell is uniform in
// volume, and so in area. A seed is a point about the first place that the trials from its own
// number on find, moved to the surface: there is nothing to be prepared, and seeds that follow one
// another share most of their trials.

#include "core/base/warp.h"
#include "shapes/metaballs/surfels/atom_field.h"

namespace pbrt::surfels {
namespace {

constexpr std::uint64_t kTrials =
    256;  // a seed looks at so many at least, at twice as many at most
constexpr std::uint64_t kFirst = 4096;  // in search of any surface at all
constexpr double kShell = 0.25;         // in supports
constexpr double kClose = 0.02;         // the same: near enough to be on the surface
constexpr double kAbout = 0.7;          // the same: how far from its place a seed begins
constexpr double kAccepted = 0.6;       // of the points of the shell, where D is 1
constexpr int kSteps = 4;               // of Newton

// Uniform in [0, 1).
double uniform(Rng& rng) {
  return rng.bits() * 0x1p-32;
}
// The largest of three uniform numbers has the density of a ball's radii.
double radiusInBall(Rng& rng) {
  return std::max({uniform(rng), uniform(rng), uniform(rng)});
}
DVec3 direction(Rng& rng) {
  return DVec3(uniformSphere({rng.uniform(), rng.uniform()}));
}

}  // namespace

AtomField::Look AtomField::look(const DPoint3& p) const {
  Look look;
  if (!isFinite(Vec3(p))) return look;
  for (std::size_t level = 0; level < levelCount_; ++level) {
    const AtomHash& hash = levels_[level];
    hash.visit(hash.cellAt(p), [&](const CellFrame& frame, const AtomRun& run) {
      Probe probe;
      atomLoops().probe(kernel_, run, frame.inward(p), probe);
      const float* g = probe.gradient;
      look.value += probe.value;
      look.gradient += DVec3(g[0], g[1], g[2]) / frame.side;
      look.density += probe.density;
    });
  }
  return look;
}

// A point of some atom's support, if there is one this time.
AtomField::Place AtomField::propose(std::uint64_t trial, Rng& rng) const {
  // Every fourth takes the atoms in turn, so that none is forgotten, however small its part.
  const double chosen = uniform(rng) * byArea_.back();
  const auto byArea =
      static_cast<std::size_t>(std::ranges::upper_bound(byArea_, chosen) - byArea_.begin());
  const std::size_t j =
      trial % 4 == 3 ? trial / 4 % atoms_.size() : std::min(byArea, atoms_.size() - 1);
  const Atom& atom = atoms_[j];
  const double h = atom.radius, weight = std::abs(atom.weight), most = std::min(1.0, weight);
  return metaballs::withKernel(kernel_, [&]<class K>(K) -> Place {
    for (int i = 0; i < 32; ++i) {
      const double r = radiusInBall(rng);
      if (uniform(rng) * most < weight * K::value(r * r))
        return {DPoint3(atom.centre) + r * h * direction(rng), h};
    }
    return {};
  });
}

// What the first of the trials before `end` finds that finds any; `trial` is then the next.
AtomField::Place AtomField::find(std::uint64_t& trial, std::uint64_t end) const {
  while (trial < end) {
    Rng rng(hash(trial));
    const Place place = propose(trial++, rng);
    if (place.h == 0) continue;
    const Look at = look(place.p);
    if (std::abs(at.value) < kShell * place.h * glm::length(at.gradient) &&
        uniform(rng) * at.density < kAccepted)
      return place;
  }
  return {};
}

void AtomField::findOne() {
  known_ = {};
  byArea_.resize(atoms_.size());
  double sum = 0;
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    const double h = atoms_[i].radius;
    byArea_[i] = sum += std::min(1.0, std::abs(atoms_[i].weight)) * h * h;
  }
  if (bounds_.empty()) return;
  for (const std::uint64_t end = trial_ + kFirst; trial_ < end;) {
    known_ = find(trial_, end);
    if (settle(known_.p, known_.h)) return;
  }
  known_ = {};
}

// Whether p, moved along the gradient, is on the surface or inside.
bool AtomField::settle(DPoint3& p, double h) const {
  for (int step = 0;; ++step) {
    const Look at = look(p);
    const double slope = glm::length(at.gradient), distance = std::abs(at.value) / slope;
    if (distance <= kClose * h) return true;
    if (step == kSteps || !(distance < h)) return at.value > 0;
    p -= at.value / slope * (at.gradient / slope);
  }
}

bool AtomField::seeds(std::uint64_t first, std::span<DPoint3> out) const {
  if (known_.h == 0) return false;
  std::uint64_t next = first;  // trial
  Place place;                 // the last that was found: for all seeds before `next`
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint64_t number = first + i;
    if (place.h == 0 || number == next) place = find(next, (number / kTrials + 2) * kTrials);
    const Place& about = place.h > 0 ? place : known_;
    Rng rng(hash(number, 1));
    out[i] = about.p + kAbout * about.h * radiusInBall(rng) * direction(rng);
    if (!settle(out[i], about.h) && !settle(out[i] = about.p, about.h)) out[i] = known_.p;
  }
  return true;
}

}  // namespace pbrt::surfels
