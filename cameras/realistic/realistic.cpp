// A camera that takes its picture through a real lens, surface by surface (Kolb, Mitchell and
// Hanrahan 1995, "A Realistic Camera Model for Computer Graphics").

#include <fmt/format.h>

#include "cameras/realistic/aperture.h"
#include "cameras/realistic/exit_pupil.h"
#include "core/plugin/plugin.h"

namespace pbrt {

namespace {

constexpr double kWidest = 1e6;  // mm

Lens readLens(Params& p) {
  const std::filesystem::path file =
      p.file("lensfile",
             "rows of radius, thickness, index and diameter in mm, from the scene to the film");
  p.require("lensfile");
  const std::vector<LensRow> stopAlone = {{0, 0, 1, 1}};
  if (p.describing()) return Lens(stopAlone);
  try {
    return Lens(readLensFile(file));
  } catch (const Error& error) {
    if (error.diagnostics().at(0).file.empty())
      p.fail("lensfile", error.diagnostics().at(0).message);
    throw;
  }
}

}  // namespace

class RealisticCamera final : public Camera {
 public:
  RealisticCamera(Params& p, const Setup& setup)
      : unit_(p.positive("unit", 1e-3F, "what a millimetre of the lens is in the scene",
                         "scene units")),
        open_(p.number("shutteropen", 0, "when the shutter opens", "scene time")),
        close_(p.number("shutterclose", 1, "when the shutter closes", "scene time")),
        simple_(p.flag("simpleweighting", true,
                       "brightness is that of a pinhole on the axis; else what film gets")),
        lens_(readLens(p)),
        aperture_(p),
        distance_(filmDistance(p)),
        filmSize_(filmSize(p, setup)),
        origin_(setup.toRender),
        resolution_(setup.resolution),
        pupil_(lens_, distance_, 0.5 * glm::length(filmSize_)) {
    const bool timed =
        p.flag("timeweighting", true, "without simpleweighting: twice the time, twice the light");
    if (!(open_ <= close_)) p.fail("shutterclose", "must not be before shutteropen");
    if (!simple_ && timed && open_ == close_)
      p.warn("shutterclose", "equals shutteropen: with timeweighting no light is gathered");
    if (p.describing()) return;
    if (pupil_.axialSquare() == 0)
      p.fail("lensfile", "is a lens that lets no light through to the film's middle");
    scale_ = simple_ ? 1 / pupil_.axialSquare() : (timed ? close_ - open_ : 1) / sqr(distance_);
  }

  // Light on the film is the integral over the last vertex's plane of L cos^4 / distance^2.
  CameraRay generate(const CameraSample& sample, bool differentials) const override {
    CameraRay result;
    RayDifferential& ray = result.ray;
    ray.time = lerp(sample.time, open_, close_);
    const DPoint3 film = onFilm(glm::dvec2(sample.film));
    const double radius = glm::length(glm::dvec2(film));
    const PupilOutline pupil = pupil_.at(radius);
    const glm::dvec2 axis = radius > 0 ? glm::dvec2(film) / radius : glm::dvec2(1, 0);
    const glm::dvec2 p = pupil.empty() ? glm::dvec2(0) : pupil.sample(sample.lens);
    const DPoint3 rear(p.x * axis.x - p.y * axis.y, p.x * axis.y + p.y * axis.x, 0);
    LensRay light{film, glm::normalize(rear - film)};
    const double cosine = light.d.z;
    const auto atStop = pupil.empty() ? std::nullopt : lens_.trace(light);
    const double through = atStop ? aperture_.through(*atStop) : 0;
    result.weight = static_cast<float>(through * sqr(sqr(cosine)) * pupil.area() * scale_);
    if (!(result.weight > 0)) {
      result.weight = 0;
      ray.tMax = 0;  // nothing is seen
      light = {DPoint3(0, 0, lens_.length()), DVec3(0, 0, 1)};
    }
    toScene(light, ray.o, ray.d);
    if (differentials) {
      ray.hasDifferentials = true;
      ray.rxOrigin = ray.ryOrigin = ray.o;
      ray.rxDirection = ray.ryDirection = ray.d;
      neighbour(glm::dvec2(sample.film) + glm::dvec2(1, 0), rear, ray.rxOrigin, ray.rxDirection);
      neighbour(glm::dvec2(sample.film) + glm::dvec2(0, 1), rear, ray.ryOrigin, ray.ryDirection);
    }
    return result;
  }

 private:
  // mm behind the last vertex.
  double filmDistance(Params& p) {
    const float focus = p.positive("focusdistance", 10,
                                   "what lies this far ahead of the film is sharp", "scene units");
    const auto given = p.optionalNumber(
        "filmdistance", "from the lens to the film; goes before focusdistance", "mm");
    const float stop = p.positive("aperturediameter", 1, "of the stop", "mm");
    if (p.describing()) return 1;
    if (stop > 2 * lens_.stopRadius() * (1 + 1e-6))  // a float that says 17.1 is more
      p.warn("aperturediameter",
             fmt::format("is wider than the stop can be; {} mm is taken", 2 * lens_.stopRadius()));
    else
      lens_.setStopRadius(std::min(0.5 * stop, lens_.stopRadius()));
    if (given && !(*given > 0 && *given < kWidest))
      p.fail("filmdistance", fmt::format("must be above 0 and below {} mm", kWidest));
    const std::string name = given ? "filmdistance" : "focusdistance";
    const auto distance = given ? double{*given} : lens_.focused(focus / unit_);
    if (!distance) {
      if (!(lens_.paraxial().c < 0))
        p.fail("lensfile", "is a lens that gathers no light: it makes no picture");
      p.fail(name, "is too near for this lens");
    }
    if (!(*distance > 0 && *distance + lens_.rearSag() > 0))
      p.fail(name, "puts the film into the lens");
    return *distance;
  }

  // mm
  static glm::dvec2 filmSize(Params& p, const Setup& setup) {
    const auto given = p.optionalNumber(
        "filmdiag", "diagonal of the film, pbrt-v2's name; goes before the film's own", "mm");
    const double diagonal = given.value_or(setup.filmDiagonal);
    if (!(diagonal > 0 && diagonal < kWidest))
      p.fail("filmdiag",
             fmt::format("the film's diagonal must be above 0 and below {} mm", kWidest));
    const glm::dvec2 size(setup.resolution);
    return diagonal / glm::length(size) * size;
  }

  // The lens turns its picture upside down.
  DPoint3 onFilm(const glm::dvec2& raster) const {
    const glm::dvec2 p = (raster / glm::dvec2(resolution_) - 0.5) * filmSize_;
    return {-p.x, p.y, -distance_};
  }

  // From the lens's space, which has the film at -distance_, to render space, with unit direction.
  void toScene(const LensRay& light, Point3& o, Vec3& d) const {
    o = Point3(origin_.point(unit_ * (light.o + DVec3(0, 0, distance_))));
    d = Vec3(glm::normalize(origin_.vector(light.d)));
  }

  // The ray of another film place through the same place of the pupil: rims do not matter to what
  // a pixel covers.
  void neighbour(const glm::dvec2& raster, const DPoint3& rear, Point3& o, Vec3& d) const {
    const DPoint3 film = onFilm(raster);
    LensRay light{film, glm::normalize(rear - film)};
    if (lens_.traceUnbounded(light)) toScene(light, o, d);
  }

  double unit_;
  float open_, close_;
  bool simple_;
  Lens lens_;
  Aperture aperture_;
  double distance_;  // from the film to the last vertex
  glm::dvec2 filmSize_;
  Transform origin_;  // camera space, whose origin is the film's middle, to render space
  Point2i resolution_;
  ExitPupil pupil_;
  double scale_ = 0;
};

}  // namespace pbrt

PBRT_PLUGIN(Camera, pbrt::RealisticCamera, "realistic",
            "looks through a real lens, which blurs, bends and darkens as lenses do")
