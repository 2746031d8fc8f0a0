#pragma once
// Where on its last surface a lens lets light out to a point of the film, so that no rays are
// wasted on its barrel (Steinert, Dammertz, Hanika and Lensch 2011, "General Spectral Camera Lens
// Simulation").

#include "cameras/realistic/lens.h"

namespace pbrt {

// Of the plane across the axis through the last vertex, for a film point on the +x axis: x0 to x1,
// and -y to y, as lens and pupil are symmetric. Empty if x0 > x1.
struct PupilBox {
  double x0 = 1, x1 = 0, y = 0;

  bool empty() const { return x0 > x1; }
  double area() const { return empty() ? 0 : (x1 - x0) * 2 * y; }
};

class ExitPupil {
 public:
  // For film points up to `farthest` from the axis; the film is `filmDistance` behind the lens. All
  // in mm. The lens must live as long.
  ExitPupil(const Lens& lens, double filmDistance, double farthest);

  // Holds the pupil of a film point that far from the axis.
  PupilBox at(double radius) const;
  // Area of the square about the pupil of the film's middle.
  double axialArea() const { return axialArea_; }

 private:
  bool passes(double filmX, double x, double y) const;
  double stopHeight(double filmX, double x) const;
  PupilBox find(double filmX) const;
  PupilBox possible(double filmX) const;
  std::optional<double> seed(double filmX, const PupilBox& within) const;

  const Lens& lens_;
  double distance_, perMm_;
  std::vector<PupilBox> boxes_;  // of film points at equal steps
  double axialArea_ = 0;
};

}  // namespace pbrt
