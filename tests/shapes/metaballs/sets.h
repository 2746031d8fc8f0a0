#pragma once
// Sets of atoms and rays at them: the ordinary ones, and those that break ray tracers.

#include <functional>
#include <optional>
#include <ostream>

#include "tests/shapes/metaballs/clouds.h"
#include "tests/shapes/metaballs/subject.h"

namespace pbrt::metaballs::test {

inline constexpr Kernel kAllKernels[] = {Kernel::poly6, Kernel::wyvill, Kernel::blob,
                                         Kernel::gaussian};

struct Set {
  std::string name;
  std::function<Field(Kernel)> field;
  std::function<ObjectRay(const Subject&, Random&)> ray;
  double share = 1;  // of the rays; less where a ray costs more

  // The name as GoogleTest allows it.
  std::string identifier() const {
    std::string id;
    for (const char c : name) id += c == '-' ? 'm' : std::isalnum(c) ? c : '_';
    return id;
  }
  friend std::ostream& operator<<(std::ostream& out, const Set& set) { return out << set.name; }
};

enum class Aim { outside, inside, axis, flat, face, far, kinds };

// Rays at a place near some atom.
inline ObjectRay rayAt(Aim aim, const Subject& subject, Random& random) {
  const auto& atoms = subject.field.atoms();
  const Atom& atom = atoms[random.uniform(static_cast<std::uint32_t>(atoms.size()))];
  const double h = atom.radius;
  DPoint3 target = DPoint3(atom.centre) + 0.8 * h * random.cube();
  const double away = h * (3 + std::cbrt(static_cast<double>(atoms.size())));
  DVec3 d = random.direction();
  switch (aim) {
    case Aim::inside:
      return {target, random.in(0.1, 10) * d};
    case Aim::axis: {
      DVec3 e(0);
      e[static_cast<int>(random.uniform(3U))] = random.uniform() < 0.5F ? -1 : 1;
      return {target - away * e, e};
    }
    case Aim::flat:  // one component of the direction is zero
      d[static_cast<int>(random.uniform(3U))] = 0;
      return {target - away * d, d};
    case Aim::face: {  // along a face of a cell
      const auto cells = subject.cells.cells();
      const int axis = static_cast<int>(random.uniform(3U));
      d[axis] = 0;
      if (!cells.empty()) {
        const Bounds3& box = cells[random.uniform(static_cast<std::uint32_t>(cells.size()))].box;
        target = DPoint3(box.centre());
        target[axis] = random.uniform() < 0.5F ? box.lo[axis] : box.hi[axis];
      }
      return {target - away * d, d};
    }
    case Aim::far:
      return {target - std::pow(10.0, random.in(2, 6)) * h * d, random.in(0.1, 10) * d};
    default:
      return {target - away * d, h * d};
  }
}
inline ObjectRay anyRay(const Subject& subject, Random& random) {
  return rayAt(static_cast<Aim>(random.uniform(static_cast<std::uint32_t>(Aim::kinds))), subject,
               random);
}

// Where a ray from outside first meets the surface, and the unit normal there.
struct Foot {
  DPoint3 p{};
  DVec3 n{};
  double h = 1;  // smallest support there
};
inline std::optional<Foot> foot(const Subject& subject, Random& random) {
  for (int i = 0; i < 64; ++i) {
    const ObjectRay ray = rayAt(Aim::outside, subject, random);
    const auto t = subject.first(ray);
    if (!t) continue;
    const Oracle oracle(subject.blocks, ray);
    const DVec3 n = -glm::normalize(oracle.gradient(*t));
    if (std::isfinite(n.x)) return Foot{ray.at(*t), n, oracle.scale(*t).radius};
  }
  return {};
}

// In the tangent plane of a point of the surface, but for 1e-1 to 1e-17 of the support, in or out.
inline ObjectRay tangentRay(const Subject& subject, Random& random) {
  const auto at = foot(subject, random);
  if (!at) return rayAt(Aim::outside, subject, random);
  const DVec3 d = glm::normalize(glm::cross(at->n, random.direction()));
  const double off = (random.uniform() < 0.5F ? 1 : -1) * std::pow(10.0, -random.in(1, 17));
  return {at->p + at->h * (off * at->n - random.in(0.1, 5) * d), d};
}
// From afar through a window of 0.02 degrees about a limb.
inline ObjectRay limbRay(const Subject& subject, Random& random) {
  ObjectRay ray = tangentRay(subject, random);
  const double away = 50 * subject.field.atoms().front().radius;
  const DPoint3 eye = ray.o - away * ray.d;
  return {eye, glm::normalize(ray.d + 1.7e-4 * random.cube())};
}
// From a point of the surface, but for its rounding and up to 1e-3 of the support.
inline ObjectRay rayFromSurface(const Subject& subject, Random& random) {
  const auto at = foot(subject, random);
  if (!at) return rayAt(Aim::inside, subject, random);
  const std::uint32_t side = random.uniform(3U);
  const double off = side == 0 ? 0 : (side == 1 ? 1 : -1) * std::pow(10.0, -random.in(3, 14));
  return {at->p + off * at->h * at->n, random.direction()};
}

// `side`^3 places of a jittered grid of spacing 1 in supports of 2, in which the field is twice the
// threshold. (Mean of a lattice sum: the integral of the kernel over space.)
inline Field fluid(Kernel kernel, int side, double jitter, int layers) {
  double density = 0;
  const float h = 2;
  withKernel(kernel, [&]<class K>(K) {
    for (int i = 0; i < 1000; ++i) {
      const double r = (i + 0.5) / 1000;
      density += 4 * std::numbers::pi * r * r * h * h * h * K::value(r * r) / 1000;
    }
  });
  Random random(17);
  std::vector<Atom> atoms;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < layers; ++z)
        atoms.push_back(
            atom(kernel, Point3(DVec3(x, y, z) + jitter * random.cube()), h, 2 / density, h));
  return {kernel, std::move(atoms)};
}

inline Field moved(const Field& field, const DVec3& by) {
  std::vector<Atom> atoms;
  for (const Atom& a : field.atoms())
    atoms.push_back(
        atom(field.kernel(), Point3(DPoint3(a.centre) + by), a.radius, a.weight, a.radius));
  return {field.kernel(), std::move(atoms)};
}

// Two atoms whose fields sum to 1 + above at the point between them, where the gradient is zero.
// (At 0.5 the weight would be next to a simple fraction, which pairs of floats avoid.)
inline Field neck(Kernel kernel, double above) {
  const float x = 0.47F;
  double k = 0;
  withKernel(kernel, [&]<class K>(K) { k = K::value(sqr(static_cast<double>(x))); });
  const double weight = (1 + above) / (2 * k);
  return {kernel, {atom(kernel, {-x, 0, 0}, 1, weight), atom(kernel, {x, 0, 0}, 1, weight)}};
}

// Each atom is there three times, once to carve.
inline Field duplicates(Kernel kernel) {
  std::vector<Atom> atoms;
  const Field once = cloud(40, kernel, 0, 1, 8);
  for (const Atom& a : once.atoms())
    for (const double strength : {1.0, 1.0, -0.7})
      atoms.push_back(atom(kernel, a.centre, a.radius, strength * a.weight, a.radius));
  return {kernel, std::move(atoms)};
}

inline Field inOnePlace(Kernel kernel) {
  std::vector<Atom> atoms;
  for (int i = 0; i < 1000; ++i)
    atoms.push_back(
        atom(kernel, {i < 500 ? 1 : 1 + 1e-3F * static_cast<float>(i % 7), 2, 3}, 1, 2e-3, 1));
  return {kernel, std::move(atoms)};
}

// Radii of 1e-6 at the skin of a ball of 1e6, and inside it.
inline Field unlikeRadii(Kernel kernel) {
  Random random(9);
  std::vector<Atom> atoms{atom(kernel, {1e6F, 0, 0}, 1e6F, 2, 1e6)};
  for (int i = 0; i < 6; ++i)
    atoms.push_back(atom(kernel, Point3(1e-6 * random.cube()), 1e-6F, i % 2 ? 3 : -2, 1e-6));
  return {kernel, std::move(atoms)};
}

inline Field unlikeStrengths(Kernel kernel) {
  Random random(9);
  std::vector<Atom> atoms;
  for (int i = 0; i < 24; ++i)
    atoms.push_back(atom(kernel, Point3(1.6 * random.cube()), 1,
                         i % 8 == 7 ? -1e4
                         : i % 2    ? 2e4
                                    : 2e-4,
                         1));
  return {kernel, std::move(atoms)};
}

// A ball with room inside and a ball in that room.
inline Field cavity(Kernel kernel) {
  return {kernel,
          {atom(kernel, {0, 0, 0}, 2, 6, 2), atom(kernel, {0, 0, 0}, 1.4F, -6, 1.4),
           atom(kernel, {0.05F, 0, 0}, 0.5F, 3, 0.5)}};
}

// With up to `largest` atoms.
inline std::vector<Set> ordinarySets(int largest = 10000) {
  std::vector<Set> sets;
  for (const int count : {1, 2, 12, 300, 10000})
    for (const double carving : {0.0, 0.3}) {
      if ((count == 1 && carving > 0) || count > largest) continue;
      sets.push_back({std::to_string(count) + (carving > 0 ? " carved" : ""),
                      [=](Kernel k) { return cloud(count, k, carving, 1, count); }, anyRay});
    }
  for (const int side : {6, 20})
    if (const int count = side * side * side; count <= largest)
      sets.push_back({"fluid, " + std::to_string(count),
                      [=](Kernel k) { return fluid(k, side, 0.25, side); }, anyRay});
  return sets;
}

inline std::vector<Set> extremeSets() {
  const auto some = [](double unit) {
    return [=](Kernel k) { return cloud(12, k, 0.2, unit, 3); };
  };
  const auto away = [](double distance) {
    return [=](Kernel k) { return moved(cloud(12, k, 0.2, 1, 3), distance * DVec3(1, -0.7, 0.3)); };
  };
  std::vector<Set> sets{
      {"1e4 from the origin", away(1e4), anyRay},
      {"1e6 from the origin", away(1e6), anyRay},
      {"scaled by 1e-6", some(1e-6), anyRay},
      {"scaled by 1e7", some(1e7), anyRay},
      {"radii 1e-6 and 1e6", unlikeRadii, anyRay},
      {"strengths 1e-4 and 1e4", unlikeStrengths, anyRay},
      {"1000 in one place", inOnePlace, anyRay, 0.03},
      {"duplicates", duplicates, anyRay},
      {"tangent, 1 atom", [](Kernel k) { return cloud(1, k, 0, 1, 6); }, tangentRay, 0.5},
      {"tangent, 12", some(1), tangentRay, 0.3},
      {"limb within 0.02 degrees", some(1), limbRay, 0.5},
      {"from the surface", some(1), rayFromSurface, 0.5},
      {"from in or by a cavity", cavity,
       [](const Subject&, Random& random) {
         return ObjectRay{random.in(0, 1.2) * random.direction(), random.direction()};
       }},
      {"sheet of 3200, grazed", [](Kernel k) { return fluid(k, 40, 0.1, 2); },
       [](const Subject&, Random& random) {
         const double slope = std::pow(10.0, -random.in(1, 4));
         const DVec3 d = glm::normalize(DVec3(1, random.in(-0.3, 0.3), -slope));
         const DPoint3 at(random.in(5, 35), random.in(10, 30), random.in(0.5, 2.5));
         return ObjectRay{at - random.in(20, 60) * d, d};
       },
       0.5}};
  for (const double above : {0.0, 1e-15, 1e-12, 1e-9, -1e-15, -1e-12, -1e-9}) {
    char name[32];
    std::snprintf(name, sizeof name, "neck %+.0e", above);
    sets.push_back({name, [=](Kernel k) { return neck(k, above); },
                    [](const Subject&, Random& random) {
                      const double turn = random.in(0, 7);
                      const DVec3 d = random.uniform() < 0.5F
                                          ? random.direction()
                                          : DVec3(0, std::cos(turn), std::sin(turn));
                      const DVec3 off = random.uniform() < 0.5F
                                            ? DVec3(0)
                                            : std::pow(10.0, -random.in(2, 16)) * random.cube();
                      return ObjectRay{off - 3.0 * d, d};
                    },
                    0.1});
  }
  return sets;
}

}  // namespace pbrt::metaballs::test
