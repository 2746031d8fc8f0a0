#include "shapes/metaballs/surfels/atom_field.h"

#include <algorithm>
#include <array>

#include "shapes/metaballs/loops.h"

namespace pbrt::surfels {
inline namespace portable {
extern const AtomLoops kAtomLoops;
}
#ifdef PBRT_X86
namespace avx2 {
extern const AtomLoops kAtomLoops;
}
namespace avx512 {
extern const AtomLoops kAtomLoops;
}
#endif

std::span<const AtomLoops* const> allAtomLoops() {
  static constexpr const AtomLoops* all[] = {
      &portable::kAtomLoops,
#ifdef PBRT_X86
      &avx2::kAtomLoops,
      &avx512::kAtomLoops,
#endif
  };
  return std::span(all).first(metaballs::allLoops().size());
}

const AtomLoops& atomLoops() {
  static const AtomLoops& best = *allAtomLoops().back();
  return best;
}

void AtomField::set(metaballs::Kernel kernel, std::span<const Atom> atoms,
                    std::span<const Vec3> velocities) {
  kernel_ = kernel;
  atoms_ = atoms;
  velocities_ = velocities;
  fastest_ = 0;
  for (const Vec3& v : velocities)
    fastest_ = std::max({fastest_, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (fastest_ < 1e-30F) fastest_ = 1;
  bounds_ = {};
  float largest = 0, smallest = kInfinity;
  for (const Atom& atom : atoms) {
    largest = std::max(largest, atom.radius);
    smallest = std::min(smallest, atom.radius);
    if (atom.weight <= 0) continue;
    const auto h = static_cast<double>(atom.radius);
    bounds_.add(roundOutward(DPoint3(atom.centre) - h, DPoint3(atom.centre) + h));
  }
  grain_ = atoms.empty() ? 1 : smallest;
  for (std::vector<std::uint32_t>& level : byLevel_) level.clear();
  for (std::uint32_t i = 0; i < atoms.size(); ++i) {
    const auto level =
        static_cast<std::size_t>(0.5 * std::log2(static_cast<double>(largest) / atoms[i].radius));
    if (level >= byLevel_.size()) byLevel_.resize(level + 1);
    byLevel_[level].push_back(i);
  }
  levelCount_ = 0;
  for (const std::vector<std::uint32_t>& level : byLevel_) {
    if (level.empty()) continue;
    if (levelCount_ == levels_.size()) levels_.emplace_back();
    float most = 0;
    for (const std::uint32_t j : level) most = std::max(most, atoms[j].radius);
    levels_[levelCount_++].build(atoms, level, most, hash_);
  }
  findPlaces();
}

void AtomField::at(std::span<const DPoint3> points, std::span<FieldAt> out) const {
  for (std::size_t first = 0; first < points.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, points.size() - first);
    some(points.subspan(first, count), out.subspan(first, count));
  }
}

// In floats; where their rounding may count, in doubles.
//
// Rounding, in units u = 2^-24, of one term w K(q): lengths are in cell sides, a radius is at most
// 1. The offset of an atom from the cell's centre is at most 1.5 and off by half its last place,
// that of a point is at most 0.5; with that of their difference, where it counts, each axis of d is
// off by less than 3 u and d by less than 6 u, which moves W by 6 u |grad W|. q is off by less than
// 6 u of itself, which moves W by 6 u |w K'| q = 3 u |grad W| |d|. K is rounded by 2 kRounding u of
// itself (the gaussian's, of K + exp(-b), where exp(-b) is less than K or than h |grad W| / b), the
// weight and the product by 2 u, and the sum of n terms by n u of them all.
void AtomField::some(std::span<const DPoint3> points, std::span<FieldAt> out) const {
  const AtomLoops& loops = atomLoops();
  const double rounding =
      metaballs::withKernel(kernel_, []<class K>(K) { return 2.0 * K::kRounding; });
  const float scale = 1 / fastest_;
  std::array<double, kChunk> slopes, error;
  std::fill_n(slopes.begin(), points.size(), 0);
  std::fill_n(error.begin(), points.size(), 0x1p-24);
  std::ranges::fill(out, FieldAt{});
  visitCells(points, [&](const CellFrame& frame, std::span<const std::uint16_t> members,
                         const AtomRun& atoms) {
    PointRun run;
    const double perLength = 1 / frame.side;
    for (; !members.empty(); members = members.subspan(run.count)) {
      run.count = std::min(members.size(), PointRun::kMost);
      for (std::size_t i = 0; i < (run.count + kLanes - 1) / kLanes * kLanes;
           ++i) {  // lanes to spare: the last
        const Point3 p = frame.inward(points[members[std::min(i, run.count - 1)]]);
        run.p[0][i] = p.x, run.p[1][i] = p.y, run.p[2][i] = p.z;
      }
      loops.add(kernel_, atoms, velocities_, scale, run);
      const double terms = 2 + rounding + static_cast<double>(atoms.count);
      for (std::size_t i = 0; i < run.count; ++i) {
        const auto vector = [&](const PointRun::Each(&v)[3]) {
          return DVec3(v[0][i], v[1][i], v[2][i]);
        };
        const std::uint16_t j = members[i];
        out[j].value += run.value[i];
        out[j].gradient += perLength * vector(run.gradient);
        out[j].change += perLength * fastest_ * run.change[i];
        out[j].flow += perLength * fastest_ * vector(run.flow);
        slopes[j] += perLength * run.slopes[i];
        error[j] += 0x1p-24 * ((9 + rounding / 4) * run.slopes[i] + terms * run.magnitude[i]);
      }
    }
  });
  std::array<DPoint3, kChunk> steep;
  std::array<std::uint16_t, kChunk> which;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (slopes[i] > 0) out[i].flow /= slopes[i];
    const bool flat = slopes[i] == 0 && out[i].value > -1;
    if (error[i] < 9e-5 * std::max(1.0, std::abs(out[i].value)) && !flat) continue;
    which[count] = static_cast<std::uint16_t>(i);
    steep[count++] = points[i];
  }
  if (count == 0) return;
  std::array<ExactSums, kChunk> sums;
  exactly(std::span(steep).first(count), velocities_, sums);
  for (std::size_t i = 0; i < count; ++i) {
    const ExactSums& s = sums[i];
    // At the middle of an atom, where no slope tells whose velocity counts, its field does.
    const DVec3 flow = s.slopes > 0      ? s.flow / s.slopes
                       : s.magnitude > 0 ? s.weighed / s.magnitude
                                         : DVec3(0);
    out[which[i]] = {s.value - 1, s.gradient, s.change, flow};
  }
}

void AtomField::exactly(std::span<const DPoint3> points, std::span<const Vec3> velocities,
                        std::span<ExactSums> sums) const {
  std::fill_n(sums.begin(), points.size(), ExactSums{});
  visitCells(points,
             [&](const CellFrame&, std::span<const std::uint16_t> members, const AtomRun& run) {
               for (const std::uint16_t i : members)
                 atomLoops().addExactly(kernel_, atoms_, AtomList(run.number, run.count),
                                        velocities, points[i], sums[i]);
             });
}

void AtomField::shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const {
  std::ranges::fill(out, ShapeAt{});
  for (std::size_t first = 0; first < points.size(); first += kChunk) {
    const auto some = points.subspan(first, std::min(kChunk, points.size() - first));
    visitCells(some,
               [&](const CellFrame&, std::span<const std::uint16_t> members, const AtomRun& run) {
                 for (const std::uint16_t i : members) {
                   const metaballs::FieldSample part = metaballs::loops().sample(
                       kernel_, atoms_, some[i], AtomList(run.number, run.count));
                   out[first + i].gradient += part.gradient;
                   out[first + i].hessian += part.hessian;
                 }
               });
  }
}

}  // namespace pbrt::surfels
