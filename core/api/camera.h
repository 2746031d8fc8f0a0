#pragma once
// Cameras: from a place on the film and the lens to a ray.

#include <optional>

#include "core/base/spectrum.h"
#include "core/base/transform.h"

namespace pbrt {

struct CameraSample {
  Point2 film{};   // in pixels, (0, 0) is the upper left corner of the picture
  Point2 lens{};   // in [0, 1)^2
  float time = 0;  // in [0, 1): how far through the shutter's time
};

struct CameraRay {
  RayDifferential ray;
  float weight = 1;  // 0: no light takes this way; nobody looks at the ray then
};

class Camera {
 public:
  struct Setup {
    // Camera space (looks along +z, +y up) to render space; of a camera that moves, at the start
    // of its motion: the scene moves its rays.
    Transform toRender;
    Point2i resolution{};     // of the whole picture, before cropping
    float filmDiagonal = 35;  // in mm, for lenses that have a size
  };

  Camera() = default;
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;
  virtual ~Camera();

  // The neighbours of the ray are filled in only on demand; they are one pixel away.
  virtual CameraRay generate(const CameraSample& sample, bool differentials) const = 0;
  // Whether a ray depends on where it goes through the lens; if not, CameraSample::lens is not set.
  virtual bool usesLens() const { return true; }
  // Camera space to normalised device coordinates ([0, 1]^2 over the picture), where a matrix can
  // say it; written into the picture's metadata.
  virtual std::optional<glm::dmat4> screenFromCamera() const { return {}; }
};

}  // namespace pbrt
