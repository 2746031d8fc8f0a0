// The laws of cameras with a flat film: those of which a matrix can say what they show.

#include "camera_laws.h"
#include "show.h"

namespace pbrt::laws {
namespace {

constexpr const char* kNoMatrix = "no matrix says what it shows (screenFromCamera)";

bool isFlat(const Subject& subject) {
  return makeCamera(subject, places()[0])->screenFromCamera().has_value();
}
ParamList lens(float radius, float focus) {
  return {number("lensradius", radius), number("focaldistance", focus)};
}
// Whether the law goes on.
bool hasLens(const Subject& subject, Judge& judge) {
  const bool declared = Declared(subject).has(lens(1, 1));
  if (!isFlat(subject))
    judge.skip(kNoMatrix);
  else if (!declared)
    judge.skip("it declares no lensradius and focaldistance");
  return isFlat(subject) && declared;
}

// A point of render space, seen by the camera, as film coordinates and its depth.
DPoint3 filmPlace(const Camera& camera, const Place& place, const DPoint3& p) {
  const DPoint3 inCamera = place.toRender.inverse().point(p);
  const DPoint3 ndc = Transform(camera.screenFromCamera().value()).project(inCamera);
  return {ndc.x * place.resolution.x, ndc.y * place.resolution.y, inCamera.z};
}
bool isAt(const DPoint3& seen, const CameraSample& s, const Place& place) {
  return std::abs(seen.x - s.film.x) <= 2e-4 * place.resolution.x &&
         std::abs(seen.y - s.film.y) <= 2e-4 * place.resolution.y;
}

}  // namespace

void showsWhatTheMatrixSays(const Subject& subject, Judge& judge) {
  if (!isFlat(subject)) return judge.skip(kNoMatrix);
  for (const Place& place : places()) {
    const auto camera = makeCamera(subject, place);
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) {
      const CameraSample s = randomSample(rng, place.resolution);
      const Ray ray = camera->generate(s, false).ray;
      if (camera->usesLens()) continue;  // another law
      for (const double t : {0.5, 3.0, 1000.0}) {
        const DPoint3 p = DPoint3(ray.o) + t * DVec3(ray.d), seen = filmPlace(*camera, place, p);
        judge.expect(isAt(seen, s, place),
                     "{}: the ray passes {}, which screenFromCamera() puts at film ({}, {})",
                     show(s, place), show(Vec3(p)), seen.x, seen.y);
        judge.expect(seen.z > 0, "{}: the ray passes {}, of depth {}: it goes backwards",
                     show(s, place), show(Vec3(p)), seen.z);
      }
    }
  }
}

void lensFocuses(const Subject& subject, Judge& judge) {
  if (!hasLens(subject, judge)) return;
  constexpr float radius = 0.25F, focus = 6;
  for (const Place& place : places()) {
    const auto camera = makeCamera(subject, place, lens(radius, focus));
    const Transform toCamera = place.toRender.inverse();
    Rng rng(4);
    for (int i = 0; i < 100; ++i) {
      CameraSample s = randomSample(rng, place.resolution);
      const Ray axis = camera->generate({s.film, {0.5F, 0.5F}, 0}, false).ray;
      const DPoint3 middle = toCamera.point(DPoint3(axis.o));
      double widest = 0;
      for (int k = 0; k < 50; ++k) {
        s.lens = {rng.uniform(), rng.uniform()};
        const Ray ray = camera->generate(s, false).ray;
        const DPoint3 o = toCamera.point(DPoint3(ray.o));
        const DVec3 d = toCamera.vector(DVec3(ray.d));
        const std::string at = show(s, place);
        judge.expect(std::abs(o.z) <= 4e-6,
                     "{}: the ray begins at depth {}; the lens lies across the camera's origin", at,
                     o.z);
        const DPoint3 p = DPoint3(ray.o) + focus / d.z * DVec3(ray.d);
        const DPoint3 seen = filmPlace(*camera, place, p);
        judge.expect(isAt(seen, s, place),
                     "{}: lensradius {}, focaldistance {}: the ray crosses the focal plane at {}, "
                     "which is seen at film ({}, {})",
                     at, radius, focus, show(Vec3(p)), seen.x, seen.y);
        const double off = glm::distance(o, middle);
        judge.expect(off < radius * 1.00001,
                     "{}: the ray begins {} off the middle of a lens of radius {}", at, off,
                     radius);
        widest = std::max(widest, off);
      }
      judge.expect(widest > 0.8 * radius,
                   "{}: of 50 rays through a lens of radius {} none begins farther than {} off its "
                   "middle",
                   show(s, place), radius, widest);
    }
  }
}

// Rays start on the lens and cross the focal plane where the pinhole's ray does, as exactly as
// floats can say.
void extremeLensesFocus(const Subject& subject, Judge& judge) {
  if (!hasLens(subject, judge)) return;
  const Place place = places()[0];
  const auto pinhole = makeCamera(subject, place, {number("lensradius", 0)});
  for (const float radius : {1e-6F, 1.F, 1e6F})
    for (const float focus : {1e-6F, 1.F, 1e6F, 1e30F}) {
      const auto camera = makeCamera(subject, place, lens(radius, focus));
      Rng rng(7);
      for (int i = 0; i < 300; ++i) {
        const CameraSample s = randomSample(rng, place.resolution);
        const RayDifferential ray = camera->generate(s, true).ray;
        const std::string at =
            fmt::format("{}, lensradius {}, focaldistance {}", show(s, place), radius, focus);
        const Ray middle = pinhole->generate(s, false).ray;
        const DPoint3 o(ray.o), eye(middle.o);
        const DVec3 lensPoint = o - eye;
        judge.expect(lensPoint.z == 0 &&
                         glm::length(lensPoint) <= radius * (1 + 1e-6) + 1e-6 * glm::length(eye),
                     "{}: the ray begins at {}, not on the lens about {}", at, show(ray.o),
                     show(middle.o));
        // Both directions to the same point, with depth 1: of a distant point they are parallel.
        const DVec3 expected =
            glm::normalize(DVec3(middle.d) / double{middle.d.z} - lensPoint / double{focus});
        // The start is rounded to floats, and may be nearer to the focus than that.
        const double rounding = 2e-7 * glm::length(o) / (double{focus} + glm::length(lensPoint));
        judge.expect(glm::distance(DVec3(ray.d), expected) < 1e-6 + rounding,
                     "{}: the ray goes along {}, the focus is along {}", at, show(ray.d),
                     show(Vec3(expected)));
        for (const Vec3& w : {ray.d, ray.rxDirection, ray.ryDirection}) {
          const double length = glm::length(DVec3(w));
          judge.expect(std::abs(length - 1) <= 2e-7, "{}: the direction {} has length {}, not 1",
                       at, show(w), length);
        }
      }
    }
}

void clipsByDepth(const Subject& subject, Judge& judge) {
  const ParamList clip = {number("hither", 0.5F), number("yon", 20)};
  if (!isFlat(subject)) return judge.skip(kNoMatrix);
  if (!Declared(subject).has(clip)) return judge.skip("it declares no hither and yon");
  const Place place = places()[1];
  const auto camera = makeCamera(subject, place, clip);
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) {
    const CameraSample s = randomSample(rng, place.resolution);
    const Ray ray = camera->generate(s, false).ray;
    const auto depth = [&](float t) {
      return place.toRender.inverse().point(DPoint3(ray.o) + double{t} * DVec3(ray.d)).z;
    };
    judge.expect(std::abs(depth(ray.tMin) - 0.5) <= 1e-5 && std::abs(depth(ray.tMax) - 20) <= 1e-5,
                 "{}: with hither 0.5 and yon 20 the ray goes from depth {} to {}", show(s, place),
                 depth(ray.tMin), depth(ray.tMax));
  }
  // Without, everything is seen.
  if (!subject.params.empty()) return;
  const auto open = makeCamera(subject, place);
  const Ray ray = open->generate(randomSample(rng, place.resolution), false).ray;
  judge.expect(ray.tMin == 0 && ray.tMax == kInfinity,
               "without hither and yon a ray goes from t = {} to {}", ray.tMin, ray.tMax);
}

void screenWindowIsShown(const Subject& subject, Judge& judge) {
  const auto window = [](std::vector<float> v) {
    return ParamList{numbers("screenwindow", std::move(v))};
  };
  if (!isFlat(subject)) return judge.skip(kNoMatrix);
  if (!Declared(subject).has(window({}))) return judge.skip("it declares no screenwindow");
  // The film's edges, at depth 1, left, right, lower and upper.
  const auto shown = [&](const ParamList& list, Point2i resolution) {
    const auto camera = makeCamera(subject, {resolution, {}}, list);
    const glm::dmat4 m = camera->screenFromCamera().value();
    const double z = Transform(m).project({0, 0, 1}).z;
    const Transform back(glm::inverse(m));
    const DPoint3 lo = back.project({0, 1, z}), hi = back.project({1, 0, z});
    return glm::dvec4(lo.x, hi.x, lo.y, hi.y);
  };
  // What a unit of the screen is at depth 1: the tangent of half the field of view, if there is
  // one.
  const double unit = shown(window({-1, 1, -1, 1}), {100, 100}).y;
  const auto expectShown = [&](const ParamList& list, Point2i resolution,
                               const glm::dvec4& expected, std::string_view what) {
    const glm::dvec4 edges = shown(list, resolution) / unit;
    judge.expect(glm::all(glm::lessThanEqual(glm::abs(edges - expected), glm::dvec4(1e-6))),
                 "{}, a picture of {} x {}: it shows x {} to {}, y {} to {}, not x {} to {}, y {} "
                 "to {}",
                 what, resolution.x, resolution.y, edges[0], edges[1], edges[2], edges[3],
                 expected[0], expected[1], expected[2], expected[3]);
  };
  expectShown(window({-0.5F, 2, 0.25F, 1}), {30, 70}, {-0.5, 2, 0.25, 1},
              "screenwindow -0.5 2 0.25 1");
  if (!subject.params.empty()) return;
  expectShown({}, {200, 100}, {-2, 2, -1, 1}, "without screenwindow");
  expectShown({}, {100, 400}, {-1, 1, -4, 4}, "without screenwindow");
  const ParamList aspect = {number("frameaspectratio", 0.5F)};
  if (Declared(subject).has(aspect))
    expectShown(aspect, {300, 300}, {-1, 1, -2, 2}, "frameaspectratio 0.5");
}

}  // namespace pbrt::laws
