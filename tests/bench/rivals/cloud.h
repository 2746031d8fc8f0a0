#pragma once
// The file by which all programs of the comparison get the same atoms and the same view.
//
// A line of text: kernel, threshold, support radius, pixels each way, field of view (degrees), eye
// (3), light (3), nearest and farthest depth of the body, number of atoms. Then four little-endian
// floats an atom: centre and strength. The camera looks along +z with +y up; depth is along z.

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/math.h"

namespace pbrt::rivals {

struct Cloud {
  std::string kernel;
  double threshold = 0, radius = 0;
  int pixels = 0;
  double fieldOfView = 0;
  DPoint3 eye{}, light{};
  double near = 0, far = 0;
  std::vector<std::array<float, 4>> atoms;

  DPoint3 centre(std::size_t i) const { return {atoms[i][0], atoms[i][1], atoms[i][2]}; }
  // Through the middle of a pixel, with z = 1: depth is the ray's parameter.
  DVec3 direction(int x, int y) const {
    const double edge = std::tan(fieldOfView * std::numbers::pi / 360);
    return {edge * ((2 * x + 1.) / pixels - 1), edge * (1 - (2 * y + 1.) / pixels), 1};
  }
};

inline Cloud readCloud(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  Cloud c;
  std::size_t atoms = 0;
  in >> c.kernel >> c.threshold >> c.radius >> c.pixels >> c.fieldOfView >> c.eye.x >> c.eye.y >>
      c.eye.z >> c.light.x >> c.light.y >> c.light.z >> c.near >> c.far >> atoms;
  in.get();
  c.atoms.resize(in ? atoms : 0);
  in.read(reinterpret_cast<char*>(c.atoms.data()),
          static_cast<std::streamsize>(atoms * sizeof(c.atoms[0])));
  if (!in) throw Error(file + " is not a cloud", Failure::io);
  return c;
}

}  // namespace pbrt::rivals
