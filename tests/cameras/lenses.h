#pragma once
// Lenses, and a second opinion on what they do to light: rays in long double, by vectors and
// spheres' centres instead of the formulas of the camera.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/rng.h"
#include "tests/command.h"
#include "tests/support.h"

namespace pbrt::test {

using LVec3 = glm::vec<3, long double>;

struct LensRow {
  long double radius, thickness, index, diameter;
};
using LensRows = std::vector<LensRow>;

inline const std::string kDoubleGauss = PBRT_SOURCE_DIR "/scenes/lenses/double-gauss.dat";

inline LensRows readLens(const std::string& file) {
  std::ifstream in(file);
  LensRows rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    LensRow row{};
    if (words >> row.radius >> row.thickness >> row.index >> row.diameter) rows.push_back(row);
  }
  return rows;
}

// A thin lens, and behind it, in the plane of its last vertex, the stop.
inline LensRows thinLens(long double focalLength, long double diameter) {
  const long double radius = focalLength;  // 1 / f = (n - 1) (1 / r + 1 / r) with n = 1.5
  return {{radius, 1e-6L, 1.5L, 4 * diameter}, {-radius, 0, 1, 4 * diameter}, {0, 0, 1, diameter}};
}

inline std::string textOf(const LensRows& rows) {
  std::ostringstream text;
  text.precision(17);
  for (const LensRow& r : rows)
    text << r.radius << ' ' << r.thickness << ' ' << r.index << ' ' << r.diameter << '\n';
  return text.str();
}

// Of light from the scene, z growing from the first vertex (0) to the film. False: it is blocked.
struct LightRay {
  LVec3 o{0}, d{0};
};
inline bool traceToFilm(const LensRows& rows, long double stopRadius, LightRay& ray) {
  long double z = 0, index = 1;
  for (const LensRow& row : rows) {
    const long double behind = row.index == 0 ? 1 : row.index;
    LVec3 n(0, 0, -1);  // towards the light
    if (row.radius == 0) {
      ray.o += (z - ray.o.z) / ray.d.z * ray.d;
    } else {
      const LVec3 toCentre = LVec3(0, 0, z + row.radius) - ray.o;
      const long double along = glm::dot(toCentre, ray.d);
      const long double off = glm::length(toCentre - along * ray.d);
      if (off > std::abs(row.radius)) return false;
      const long double half = std::sqrt(row.radius * row.radius - off * off);
      ray.o += (row.radius > 0 ? along - half : along + half) * ray.d;
      n = (ray.o - LVec3(0, 0, z + row.radius)) / row.radius;
    }
    const bool stop = row.radius == 0 && behind == index;
    if (std::hypot(ray.o.x, ray.o.y) > (stop ? stopRadius : row.diameter / 2)) return false;
    // Snell: what lies along the surface shrinks by the ratio of the indices.
    const LVec3 across = ray.d - glm::dot(ray.d, n) * n;
    const LVec3 bent = index / behind * across;
    const long double sin2 = glm::dot(bent, bent);
    if (sin2 > 1) return false;
    ray.d = bent - std::sqrt(1 - sin2) * n;
    index = behind;
    z += row.thickness;
  }
  return true;
}

// z of the last vertex.
inline long double lengthOf(const LensRows& rows) {
  long double z = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) z += rows[i].thickness;
  return z;
}

// A camera whose scene unit is a millimetre, with a picture of 90 by 60 pixels.
inline std::unique_ptr<Camera> lensCamera(const std::string& lensFile, ParamList more = {},
                                          const Camera::Setup& setup = {{}, {90, 60}, 43.27F}) {
  more.push_back(text("lensfile", lensFile));
  more.push_back(number("unit", 1));
  if (std::ranges::find(more, "focusdistance", &Param::name) == more.end())
    more.push_back(number("focusdistance", 3000));
  return make<Camera>("realistic", more, setup);
}
inline std::unique_ptr<Camera> lensCamera(const LensRows& rows, const ParamList& more = {},
                                          const Camera::Setup& setup = {{}, {90, 60}, 43.27F}) {
  const Folder folder;
  folder.write("a.dat", textOf(rows));
  return lensCamera((folder.path() / "a.dat").string(), more, setup);
}

// Within that picture.
inline CameraSample randomSample(Rng& rng) {
  return {Point2(90 * rng.uniform(), 60 * rng.uniform()), {rng.uniform(), rng.uniform()}, 0};
}
}  // namespace pbrt::test
