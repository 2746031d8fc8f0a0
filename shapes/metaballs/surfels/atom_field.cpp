#include "shapes/metaballs/surfels/atom_field.h"

#include <array>

#include "core/base/warp.h"
#include "shapes/metaballs/loops.h"

namespace pbrt::surfels {

using metaballs::Atom;
using metaballs::AtomList;

void AtomField::set(metaballs::Kernel kernel, std::span<const Atom> atoms,
                    std::span<const Vec3> velocities) {
  kernel_ = kernel;
  atoms_ = atoms;
  velocities_ = velocities;
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
    levels_[levelCount_++].build(atoms, level, most);
  }
}

template <class Visit>
void AtomField::visitReaching(const DPoint3& p, const Visit& visit) const {
  if (!std::isfinite(p.x + p.y + p.z)) return;
  std::array<std::uint32_t, 256> some;
  for (std::size_t level = 0; level < levelCount_; ++level) {
    std::size_t count = 0;
    const AtomHash& hash = levels_[level];
    hash.visit(atoms_, hash.cellAt(p), [&](std::uint32_t j) {
      some[count++] = j;
      if (count < some.size()) return;
      visit(AtomList(some.data(), count));
      count = 0;
    });
    if (count > 0) visit(AtomList(some.data(), count));
  }
}

FieldAt AtomField::at(const DPoint3& p) const {
  FieldAt sum;
  double slopes = 0;
  visitReaching(p, [&](AtomList list) {
    metaballs::withKernel(kernel_, [&]<class K>(K) {
      for (const std::uint32_t j : list) {
        const Atom& atom = atoms_[j];
        const DVec3 d = p - DPoint3(atom.centre);
        const double inverse2 = 1 / sqr(static_cast<double>(atom.radius));
        const double q = lengthSquared(d) * inverse2;
        const DVec3 gradient = 2 * atom.weight * inverse2 * K::slope(q) * d;
        const DVec3 v = velocities_.empty() ? DVec3(0) : DVec3(velocities_[j]);
        sum.value += atom.weight * K::value(q);
        sum.gradient += gradient;
        sum.change -= glm::dot(gradient, v);
        const double slope = glm::length(gradient);
        sum.flow += slope * v;
        slopes += slope;
      }
    });
  });
  if (slopes > 0) sum.flow /= slopes;
  return sum;
}

void AtomField::at(std::span<const DPoint3> points, std::span<FieldAt> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(points[i]);
}

void AtomField::shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    out[i] = {};
    visitReaching(points[i], [&](AtomList list) {
      const metaballs::FieldSample part =
          metaballs::loops().sample(kernel_, atoms_, points[i], list);
      out[i].gradient += part.gradient;
      out[i].hessian += part.hessian;
    });
  }
}

bool AtomField::seeds(std::uint64_t first, std::span<DPoint3> out) const {
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!seed(first + i, out[i])) return false;
  return true;
}

bool AtomField::seed(std::uint64_t number, DPoint3& out) const {
  if (atoms_.empty()) return false;
  Rng rng(hash(number));
  for (int i = 0; i < 64; ++i) {
    const Atom& atom = atoms_[rng.uniform(static_cast<std::uint32_t>(atoms_.size()))];
    DPoint3 p =
        DPoint3(atom.centre) + DVec3(uniformSphere({rng.uniform(), rng.uniform()})) *
                                   static_cast<double>(std::cbrt(rng.uniform()) * atom.radius);
    for (int k = 0; k < 8; ++k) {
      const FieldAt f = at(p);
      const double slope2 = lengthSquared(f.gradient);
      if (!(std::abs(f.value) < 0.5 * atom.radius * std::sqrt(slope2))) break;
      if (std::abs(f.value) < 1e-3) {
        out = p;
        return true;
      }
      p -= f.value / slope2 * f.gradient;
    }
  }
  return false;
}

}  // namespace pbrt::surfels
