#pragma once
// Cameras that move while the shutter is open.

#include <memory>

#include "core/api/camera.h"
#include "core/base/animated_transform.h"

namespace pbrt {

// A camera that was made for the start of its motion, and whose rays are carried to where it is at
// their time. No kind of camera needs to know.
class MovingCamera final : public Camera {
 public:
  MovingCamera(std::unique_ptr<Camera> atStart, const AnimatedTransform& toRender,
               const MotionTimes& times)
      : camera_(std::move(atStart)), toRender_(toRender), times_(times) {}

  CameraRay generate(const CameraSample& sample, bool differentials) const override;
  bool usesLens() const override { return camera_->usesLens(); }
  std::optional<glm::dmat4> screenFromCamera() const override {
    return camera_->screenFromCamera();
  }
  const Camera& atStart() const { return *camera_; }

 private:
  std::unique_ptr<Camera> camera_;
  AnimatedTransform toRender_;
  MotionTimes times_;
};

}  // namespace pbrt
