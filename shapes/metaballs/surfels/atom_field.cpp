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
  findOne();
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
// 1. The offset of an atom from the centre of its own cell is at most 0.5, from that of the cell in
// question at most 1.5, that of a point at most 0.5, each off by half its last place; with that of
// their difference, where it counts, each axis of d is
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
      fill(run, frame, points, members);
      loops.add(kernel_, atoms, velocities_, scale, run);
      const double terms = 2 + rounding + static_cast<double>(atoms.count);
      for (std::size_t i = 0; i < run.count; ++i) {
        const auto vector = [&](const PointRun::Each(&v)[3]) {
          return DVec3(v[0][i], v[1][i], v[2][i]);
        };
        const std::uint16_t j = members[i];
        out[j].value += run.value[i];
        out[j].gradient += perLength * vector(run.gradient);
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
    out[which[i]] = {s.value - 1, s.gradient, flow};
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
  for (std::size_t first = 0; first < points.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, points.size() - first);
    bend(points.subspan(first, count), out.subspan(first, count));
  }
}

// In floats; in doubles where their rounding may reach 1e-4 of the gradient, or 1e-3 of the Hessian
// and of the gradient over the largest support there.
//
// With the lengths and u of some(), d is off by less than 6 u. That moves the gradient by 6 u times
// the Hessian of W, which is less than a term of the sum `magnitude`, and so is the gradient, as
// |d|
// <= 1. It moves the Hessian by 6 u times the third derivatives, over all kernels and with s = |d|
// / h at most (12 K'' s + 8 |K'''| s^3) |w| / h^3 < 70 |w| / h^3. Sums of n terms other than zero
// are rounded by n u, and each term by 10 u and by what K' and K'' are.
void AtomField::bend(std::span<const DPoint3> points, std::span<ShapeAt> out) const {
  const AtomLoops& loops = atomLoops();
  const double rounding =
      10 + metaballs::withKernel(kernel_, []<class K>(K) { return 2.0 * K::kRounding; });
  std::array<double, kChunk> gradientError{}, hessianError{}, perLargest{};
  std::ranges::fill(out, ShapeAt{});
  visitCells(points, [&](const CellFrame& frame, std::span<const std::uint16_t> members,
                         const AtomRun& atoms) {
    BendRun run;
    const double perLength = 1 / frame.side, perArea = perLength * perLength;
    for (; !members.empty(); members = members.subspan(run.count)) {
      fill(run, frame, points, members);
      loops.bend(kernel_, atoms, run);
      for (std::size_t i = 0; i < run.count; ++i) {
        const std::uint16_t j = members[i];
        const auto h = [&](int k) { return perArea * run.hessian[k][i]; };
        out[j].gradient +=
            perLength * DVec3(run.gradient[0][i], run.gradient[1][i], run.gradient[2][i]);
        out[j].hessian += glm::dmat3(h(0), h(3), h(4), h(3), h(1), h(5), h(4), h(5), h(2));
        if (perLargest[j] == 0 && run.size[i] > 0) perLargest[j] = perLength;
        const double rounded = (rounding + run.terms[i]) * run.magnitude[i];
        gradientError[j] += 0x1p-24 * perLength * (6.0 * run.magnitude[i] + rounded);
        hessianError[j] += 0x1p-24 * perArea * (6.0 * 70 * run.size[i] + rounded);
      }
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dmat3& h = out[i].hessian;
    const double bend = lengthSquared(h[0]) + lengthSquared(h[1]) + lengthSquared(h[2]);
    const double slope = glm::length(out[i].gradient);
    const bool good = gradientError[i] <= 1e-4 * slope &&
                      hessianError[i] <= 1e-3 * std::max(std::sqrt(bend), perLargest[i] * slope);
    if (!good) out[i] = shapeExactly(points[i]);
  }
}

ShapeAt AtomField::shapeExactly(const DPoint3& p) const {
  ShapeAt shape;
  visitCells({&p, 1}, [&](const CellFrame&, std::span<const std::uint16_t>, const AtomRun& run) {
    const metaballs::FieldSample part =
        metaballs::loops().sample(kernel_, atoms_, p, AtomList(run.number, run.count));
    shape.gradient += part.gradient;
    shape.hessian += part.hessian;
  });
  return shape;
}

}  // namespace pbrt::surfels
