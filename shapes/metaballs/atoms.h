#pragma once
// Atoms from what people and files say of them: lists of numbers that are still to be checked.

#include <functional>
#include <string>

#include "shapes/metaballs/field.h"

namespace pbrt::metaballs {

struct AtomValues {
  Kernel kernel = Kernel::poly6;
  std::vector<Point3> centres;
  std::vector<float> radii, strengths;  // one for all, or one each
  double threshold = 0.5;
};

// Of a list with one value for all, or one each.
template <class T>
const T& pick(const std::vector<T>& values, std::size_t i) {
  return values.size() == 1 ? values[0] : values[i];
}

// The largest support radius; 0 without atoms.
float largestRadius(const AtomValues& values);
// Half of an atom's own height. poly6 is a density: its values scale with 1 / h^3, and so does its
// threshold, of the largest h. A lone atom of strength 1 is then a ball of 0.563 h whatever its h.
double defaultThreshold(Kernel kernel, float largestRadius);

struct Atoms {
  std::vector<Atom> atoms;
  std::vector<std::uint32_t>
      numbers;  // of each among the centres: those of strength 0 are left out
};
// `fail` must throw; it is given the name of the parameter at fault and a sentence, with the number
// of the atom.
Atoms makeAtoms(const AtomValues& values,
                const std::function<void(const char*, const std::string&)>& fail);

// Half the distance of neighbours: the median over some points of the distance to the nearest
// other, halved. 0 if all are in one place. There must be a point.
float typicalParticleRadius(const std::vector<Point3>& positions);

}  // namespace pbrt::metaballs
