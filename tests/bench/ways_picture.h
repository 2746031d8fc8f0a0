#pragma once
// Pictures side by side, and below each how far off its normals are.

#include "core/base/image.h"
#include "tests/bench/seen.h"
#include "tools/compare/colormap.h"

namespace pbrt::bench {

// A lamp over the camera's left shoulder, and a little light from all sides; linear.
inline Vec3 shade(const Seen& seen) {
  if (!seen.found()) return Vec3(1);
  const DVec3 lamp = glm::normalize(DVec3(0.1, 0.8, 0.6)),
              eye = glm::normalize(DVec3(0.5, 0.4, 0.8));
  const double lambert = std::max(0.0, glm::dot(seen.n, lamp));
  const double highlight =
      std::pow(std::max(0.0, glm::dot(seen.n, glm::normalize(lamp + eye))), 60);
  const double sky = 0.5 + 0.5 * seen.n.y;
  return Vec3(DVec3(0.05, 0.22, 0.5) * (0.8 * lambert + 0.25 * sky) + 0.5 * highlight);
}

// The normals' error over `worst` degrees, in the colours of heatMap(); white where one of the two
// pictures alone sees something.
inline void writeSideBySide(const std::filesystem::path& file, const Picture& exact,
                            std::span<const Picture> pictures, double worst) {
  const int size = exact.size, width = size * static_cast<int>(pictures.size());
  Image image = blankImage({width, 2 * size}, 3, std::numeric_limits<std::size_t>::max(), 1);
  const auto put = [&](int x, int y, const Vec3& color) {
    for (int c = 0; c < 3; ++c)
      image.channels[c][static_cast<std::size_t>(y) * width + x] = color[c];
  };
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    std::vector<float> errors;
    for (std::size_t i = 0; i < exact.seen.size(); ++i) {
      const Seen &e = exact.seen[i], &p = pictures[k].seen[i];
      errors.push_back(e.found() && p.found() ? static_cast<float>(degreesBetween(e.n, p.n) / worst)
                                              : (e.found() == p.found() ? 0.F : 1.F));
    }
    const Image map = heatMap(errors, size, size);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * size + x;
        const int column = static_cast<int>(k) * size + x;
        put(column, y, shade(pictures[k].seen[i]));
        put(column, size + y, {map.channels[0][i], map.channels[1][i], map.channels[2][i]});
      }
  }
  writeImage(file, image);
}

}  // namespace pbrt::bench
