// Places on the surface of moving atoms, spread by its area.
//
// For each frame some places near the surface are found by trial. An atom is chosen by the area of
// its support, and a point of the support by the density S_j = min(1, |w_j| K_j): the cut keeps
// points near the surface of an atom that is far above the threshold. Atoms overlap, so that over
// all of them the density is D = sum S_j, which is next to 1 where few or many atoms together reach
// the threshold. A point is kept if it is within a part of h_j of the surface, by the distance |f|
// / |grad f| of the first order, and then with a probability proportional to 1 / D: such a shell is
// uniform in volume, and so in area. Seeds are points about those places, moved to the surface.

#include "core/base/parallel.h"
#include "core/base/warp.h"
#include "shapes/metaballs/surfels/atom_field.h"

namespace pbrt::surfels {
namespace {

constexpr std::size_t kRound = 512;  // trials at a time
constexpr std::size_t kPlaces = 64;  // enough for a frame
constexpr std::size_t kRounds = 2;   // at most
constexpr std::size_t kTask = 256;   // of them, for a thread
constexpr double kShell = 0.25;      // in supports
constexpr double kClose = 0.02;      // the same: near enough to be on the surface
constexpr double kAbout = 0.7;       // the same: how far from its place a seed begins
constexpr double kAccepted = 0.6;    // of the points of the shell, where D is 1
constexpr int kSteps = 4;            // of Newton

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

// A point of some atom's support; its h is 0 if there is none this time.
AtomField::Place AtomField::propose(std::uint64_t trial, Rng& rng) const {
  // Every fourth takes the atoms in turn, so that none is forgotten, however small its part.
  const auto chosen = std::ranges::upper_bound(byArea_, uniform(rng) * byArea_.back());
  const std::size_t j =
      trial % 4 == 0
          ? trial / 4 % atoms_.size()
          : std::min(byArea_.size() - 1, static_cast<std::size_t>(chosen - byArea_.begin()));
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

// D.
double AtomField::density(const DPoint3& p) const {
  double sum = 0;
  visitCells({&p, 1},
             [&](const CellFrame& frame, std::span<const std::uint16_t>, const AtomRun& run) {
               const Point3 at = frame.inward(p);
               metaballs::withKernel(kernel_, [&]<class K>(K) {
                 for (std::size_t i = 0; i < run.count; ++i) {
                   const Vec3 d = at - Point3(run.x[i], run.y[i], run.z[i]);
                   sum += std::min(
                       1.F, std::abs(run.weight[i]) * K::value(lengthSquared(d) * run.inverse2[i]));
                 }
               });
             });
  return sum;
}

void AtomField::findPlaces() {
  places_.clear();
  byArea_.resize(atoms_.size());
  double sum = 0;
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    const double h = atoms_[i].radius;
    byArea_[i] = sum += std::min(1.0, std::abs(atoms_[i].weight)) * h * h;
  }
  if (bounds_.empty()) return;
  trials_.resize(kRound);
  // From the first frame a simulation takes all its surfels.
  const std::size_t more = trial_ == 0 ? 16 : 1;
  for (std::size_t round = 0; round < kRounds * more && places_.size() < kPlaces * more; ++round) {
    parallelFor(kRound / kTask, [&](std::size_t task) {
      const std::span<Place> trials = std::span(trials_).subspan(task * kTask, kTask);
      std::array<DPoint3, kTask> points;
      std::array<ExactSums, kTask> at;
      std::array<Rng, kTask> rngs;
      for (std::size_t i = 0; i < kTask; ++i) {
        const std::uint64_t trial = trial_ + task * kTask + i;
        rngs[i] = Rng(hash(trial));
        trials[i] = propose(trial, rngs[i]);
        points[i] = trials[i].p;
      }
      exactly(points, at);
      for (std::size_t i = 0; i < kTask; ++i)
        if (!(std::abs(at[i].value - 1) < kShell * trials[i].h * glm::length(at[i].gradient)) ||
            uniform(rngs[i]) * density(points[i]) >= kAccepted)
          trials[i].h = 0;
    });
    trial_ += kRound;
    std::ranges::copy_if(trials_, std::back_inserter(places_),
                         [](const Place& place) { return place.h > 0; });
  }
}

// Whether p, moved along the gradient, is on the surface or inside.
bool AtomField::settle(DPoint3& p, double h) const {
  for (int step = 0;; ++step) {
    ExactSums sums;
    exactly({&p, 1}, {&sums, 1});
    const double f = sums.value - 1, slope = glm::length(sums.gradient);
    const double distance = std::abs(f) / slope;
    if (distance <= kClose * h) return true;
    if (step == kSteps || !(distance < h)) return f > 0;
    p -= f / slope * (sums.gradient / slope);
  }
}

bool AtomField::seeds(std::uint64_t first, std::span<DPoint3> out) const {
  const std::size_t count = places_.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint64_t number = first + i;
    Rng rng(hash(number));
    bool found = false;
    // Numbers that follow one another begin at different places. What goes astray begins anew at
    // the place itself, then at another.
    for (std::size_t k = 0; k < std::min<std::size_t>(count, 8) && !found; ++k) {
      const Place& place = places_[(number + k * (count / 8 + 1)) % count];
      out[i] = place.p + kAbout * place.h * radiusInBall(rng) * direction(rng);
      found = settle(out[i], place.h);
      if (!found) found = settle(out[i] = place.p, place.h);
    }
    if (!found) return false;
  }
  return true;
}

}  // namespace pbrt::surfels
