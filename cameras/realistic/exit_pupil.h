#pragma once
// Where on its last surface a lens lets light out to a point of the film, so that few rays are
// wasted on its barrel (the bounds of Steinert, Dammertz, Hanika and Lensch 2011, "General Spectral
// Camera Lens Simulation", drawn more closely).

#include <array>

#include "cameras/realistic/lens.h"

namespace pbrt {

// A part of the plane across the axis through the last vertex, for a film point on the +x axis:
// -y(x) to y(x) in columns from x0 to x1, as lens and pupil are symmetric; straight in between.
class PupilOutline {
 public:
  // The columns are those of a polygon inscribed in a circle.
  static constexpr int kColumns = 32;

  // Nothing.
  PupilOutline() = default;
  PupilOutline(double x0, double x1) : x0_(x0), x1_(x1) {}
  // Between those of two film points, t of the way; that which is not empty, if only one is.
  static PupilOutline between(const PupilOutline& a, const PupilOutline& b, double t);
  // Larger by what may lie between columns, and by `pad` on either side in x and y.
  PupilOutline padded(const glm::dvec2& pad) const;
  // How far apart their ends (x) and heights (y) are at most; 0 if either is empty.
  static glm::dvec2 gap(const PupilOutline& a, const PupilOutline& b);

  bool empty() const { return x0_ > x1_; }
  double width() const { return x1_ - x0_; }
  double x(int column) const;
  double& y(int column) { return y_[static_cast<std::size_t>(column)]; }
  double y(int column) const { return y_[static_cast<std::size_t>(column)]; }
  double area() const;
  // Uniform in area; not empty.
  glm::dvec2 sample(Point2 u) const;

 private:
  // Of the piece beyond a column.
  double area(int column) const {
    return (x(column + 1) - x(column)) * (y(column) + y(column + 1));
  }

  double x0_ = 1, x1_ = 0;
  std::array<double, kColumns + 1> y_{};
};

class ExitPupil {
 public:
  // For film points up to `farthest` from the axis; the film is `filmDistance` behind the lens. All
  // in mm. The lens must live as long.
  ExitPupil(const Lens& lens, double filmDistance, double farthest);

  // Holds the pupil of a film point that far from the axis.
  PupilOutline at(double radius) const;
  // Area of the square about the pupil of the film's middle; 0: no light comes there.
  double axialSquare() const { return outlines_[0].empty() ? 0 : sqr(outlines_[0].width()); }

 private:
  bool passes(double filmX, double x, double y) const;
  PupilOutline find(double filmX) const;
  PupilOutline possible(double filmX) const;
  std::optional<double> seed(double filmX, const PupilOutline& within) const;

  const Lens& lens_;
  double distance_, perMm_;
  std::vector<PupilOutline> outlines_;  // of film points at equal steps
  std::vector<glm::dvec2> pads_;        // of the intervals between them, in mm
};

}  // namespace pbrt
