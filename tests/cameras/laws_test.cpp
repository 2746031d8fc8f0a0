// What every camera must do, and every one with a flat film.

#include "core/base/rng.h"
#include "tests/cameras/lenses.h"

namespace pbrt {
namespace {

using test::number;

// A turned, moved, mirrored and stretched camera space.
Transform awkward() {
  return Transform::translate({3, -2, 7}) * Transform::rotate(50, {1, 2, -1}) *
         Transform::scale({-2, 2, 2});
}

struct Place {
  Point2i resolution;
  Transform toRender;
};
const std::vector<Place> kPlaces = {
    {{640, 480}, {}}, {{640, 480}, awkward()}, {{1, 1}, awkward()}, {{300, 700}, {}}};

Param screenWindow(std::vector<float> v) {
  return test::value(ParamType::number, "screenwindow", std::move(v));
}

class CameraLaws : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Camera> make(const ParamList& list, const Place& place = kPlaces[0]) const {
    return test::make<Camera>(GetParam(), list, {place.toRender, place.resolution});
  }
};

// What a camera cannot do without.
ParamList required(const std::string& name) {
  if (name == "realistic") return {test::text("lensfile", test::kDoubleGauss)};
  return {};
}
std::vector<std::string> allCameras() {
  return test::loader().available(PluginKind::camera);
}
// Those of which a matrix can say what they show.
std::vector<std::string> flatCameras() {
  std::vector<std::string> names = allCameras();
  std::erase_if(names, [](const std::string& name) {
    return !test::make<Camera>(name, required(name), {{}, {2, 2}})->screenFromCamera();
  });
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, CameraLaws, testing::ValuesIn(flatCameras()),
                         [](const auto& test) { return test.param; });

CameraSample randomSample(Rng& rng, Point2i resolution) {
  CameraSample s;
  s.film = Point2(rng.uniform(), rng.uniform()) * Point2(resolution);
  s.lens = {rng.uniform(), rng.uniform()};
  s.time = rng.uniform();
  return s;
}

// A point of render space, seen by the camera, as film coordinates and its depth.
DPoint3 filmPlace(const Camera& camera, const Place& place, const DPoint3& p) {
  const auto screen = camera.screenFromCamera();
  const DPoint3 inCamera = place.toRender.inverse().point(p);
  const DPoint3 ndc = Transform(screen.value()).project(inCamera);
  return {ndc.x * place.resolution.x, ndc.y * place.resolution.y, inCamera.z};
}

class AnyCamera : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Camera> make(ParamList list, const Place& place) const {
    for (const Param& p : required(GetParam())) list.push_back(p);
    return test::make<Camera>(GetParam(), list, {place.toRender, place.resolution});
  }
};
INSTANTIATE_TEST_SUITE_P(All, AnyCamera, testing::ValuesIn(allCameras()),
                         [](const auto& test) { return test.param; });

TEST_P(AnyCamera, RaysAreFiniteAndTheSameEachTime) {
  for (const Place& place : kPlaces) {
    const auto camera = make({}, place);
    Rng rng(6);
    for (int i = 0; i < 500; ++i) {
      CameraSample s = randomSample(rng, place.resolution);
      if (i % 3 == 0) s.film += Point2(2.5F, -2.5F);  // a filter reaches beyond the picture
      const CameraRay r = camera->generate(s, true), plain = camera->generate(s, false);
      EXPECT_EQ(r.ray.o, plain.ray.o);
      EXPECT_EQ(r.ray.d, plain.ray.d);
      EXPECT_EQ(r.weight, plain.weight);
      EXPECT_TRUE(r.weight >= 0 && r.weight < 10) << r.weight;
      EXPECT_NEAR(glm::length(DVec3(r.ray.d)), 1, 3e-7);
      EXPECT_TRUE(std::isfinite(lengthSquared(r.ray.o)));
      EXPECT_TRUE(r.ray.hasDifferentials);
      EXPECT_FALSE(plain.ray.hasDifferentials);
      for (const Vec3& v : {r.ray.rxOrigin, r.ray.ryOrigin, r.ray.rxDirection, r.ray.ryDirection})
        EXPECT_TRUE(std::isfinite(lengthSquared(v)));
    }
  }
}

TEST_P(AnyCamera, ShutterGivesTheTime) {
  const auto camera = make({number("shutteropen", 2), number("shutterclose", 6)}, kPlaces[0]);
  EXPECT_EQ(camera->generate({{1, 1}, {}, 0}, false).ray.time, 2);
  EXPECT_EQ(camera->generate({{1, 1}, {}, 0.25F}, false).ray.time, 3);
  EXPECT_LE(camera->generate({{1, 1}, {}, kOneMinusEpsilon}, false).ray.time, 6);
  EXPECT_NO_THROW(make({number("shutteropen", 0), number("shutterclose", 0)}, kPlaces[0]));
  EXPECT_THROW(make({number("shutteropen", 1), number("shutterclose", 0)}, kPlaces[0]), Error);
}

TEST_P(CameraLaws, RaysShowWhatTheMatrixSays) {
  for (const Place& place : kPlaces) {
    const auto camera = make({}, place);
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) {
      const CameraSample s = randomSample(rng, place.resolution);
      const Ray ray = camera->generate(s, false).ray;
      for (const double t : {0.5, 3.0, 1000.0}) {
        const DPoint3 seen = filmPlace(*camera, place, DPoint3(ray.o) + t * DVec3(ray.d));
        EXPECT_NEAR(seen.x, s.film.x, 2e-4 * place.resolution.x);
        EXPECT_NEAR(seen.y, s.film.y, 2e-4 * place.resolution.y);
        EXPECT_GT(seen.z, 0);  // ahead
      }
    }
  }
}

TEST_P(CameraLaws, DirectionsHaveUnitLengthAndFullWeight) {
  for (const Place& place : kPlaces) {
    const auto camera = make({number("lensradius", 0.3F), number("focaldistance", 4)}, place);
    Rng rng(2);
    for (int i = 0; i < 1000; ++i) {
      const CameraRay r = camera->generate(randomSample(rng, place.resolution), false);
      EXPECT_NEAR(glm::length(DVec3(r.ray.d)), 1, 2e-7);
      EXPECT_EQ(r.weight, 1);
      EXPECT_FALSE(r.ray.hasDifferentials);
    }
  }
}

TEST_P(CameraLaws, DifferentialsAreTheNeighboursRays) {
  for (const float lens : {0.F, 0.5F})
    for (const Place& place : kPlaces) {
      const auto camera = make({number("lensradius", lens), number("focaldistance", 9)}, place);
      Rng rng(3);
      for (int i = 0; i < 300; ++i) {
        CameraSample s = randomSample(rng, place.resolution);
        const RayDifferential ray = camera->generate(s, true).ray;
        ASSERT_TRUE(ray.hasDifferentials);
        s.film.x += 1;
        const Ray right = camera->generate(s, false).ray;
        EXPECT_LT(glm::distance(ray.rxOrigin, right.o), 4e-6F);
        EXPECT_LT(glm::distance(ray.rxDirection, right.d), 4e-7F);
        s.film += Point2(-1, 1);
        const Ray down = camera->generate(s, false).ray;
        EXPECT_LT(glm::distance(ray.ryOrigin, down.o), 4e-6F);
        EXPECT_LT(glm::distance(ray.ryDirection, down.d), 4e-7F);
      }
    }
}

TEST_P(CameraLaws, AllOfTheLensSeesOnePointOfTheFocalPlane) {
  constexpr float radius = 0.25F, focus = 6;
  for (const Place& place : kPlaces) {
    const auto camera = make({number("lensradius", radius), number("focaldistance", focus)}, place);
    Rng rng(4);
    for (int i = 0; i < 100; ++i) {
      CameraSample s = randomSample(rng, place.resolution);
      double widest = 0;
      for (int k = 0; k < 50; ++k) {
        s.lens = {rng.uniform(), rng.uniform()};
        const Ray ray = camera->generate(s, false).ray;
        const DPoint3 o = place.toRender.inverse().point(DPoint3(ray.o));
        const DVec3 d = place.toRender.inverse().vector(DVec3(ray.d));
        EXPECT_NEAR(o.z, 0, 4e-6);  // the lens lies across the camera's origin
        const double t = focus / d.z;
        const DPoint3 seen = filmPlace(*camera, place, DPoint3(ray.o) + t * DVec3(ray.d));
        EXPECT_NEAR(seen.x, s.film.x, 2e-4 * place.resolution.x);
        EXPECT_NEAR(seen.y, s.film.y, 2e-4 * place.resolution.y);
        const CameraSample centre{s.film, {0.5F, 0.5F}, 0};
        const Ray axis = camera->generate(centre, false).ray;
        const DPoint3 middle = place.toRender.inverse().point(DPoint3(axis.o));
        widest = std::max(widest, glm::distance(o, middle));
        EXPECT_LT(glm::distance(o, middle), radius * 1.00001);
      }
      EXPECT_GT(widest, 0.8 * radius);
    }
  }
}

// Lenses and distances of any size: rays start on the lens and cross the focal plane where the
// pinhole's ray does, as exactly as floats can say.
TEST_P(CameraLaws, ExtremeLensesStillFocus) {
  const Place& place = kPlaces[0];
  const auto pinhole = make({}, place);
  for (const float radius : {1e-6F, 1.F, 1e6F})
    for (const float focus : {1e-6F, 1.F, 1e6F, 1e30F}) {
      const auto camera = make({number("lensradius", radius), number("focaldistance", focus)});
      Rng rng(7);
      for (int i = 0; i < 300; ++i) {
        const CameraSample s = randomSample(rng, place.resolution);
        const CameraRay r = camera->generate(s, true);
        const DPoint3 o(r.ray.o);
        const DVec3 d(r.ray.d);
        EXPECT_EQ(r.weight, 1);
        EXPECT_NEAR(glm::length(d), 1, 2e-7);
        const Ray middle = pinhole->generate(s, false).ray;
        const DVec3 lens = o - DPoint3(middle.o);
        EXPECT_EQ(lens.z, 0);
        EXPECT_LE(glm::length(lens), radius * (1 + 1e-6) + 1e-6 * glm::length(DVec3(middle.o)));
        // Both directions to the same point, with depth 1: of a distant point they are parallel.
        const DVec3 expected = DVec3(middle.d) / double{middle.d.z} - lens / double{focus};
        // The start is rounded to floats, and may be nearer to the focus than that.
        const double rounding = 2e-7 * glm::length(o) / (double{focus} + glm::length(lens));
        EXPECT_LT(glm::distance(d, glm::normalize(expected)), 1e-6 + rounding)
            << radius << " " << focus;
        for (const Vec3& w : {r.ray.rxDirection, r.ray.ryDirection})
          EXPECT_NEAR(glm::length(DVec3(w)), 1, 2e-7);
      }
    }
}

TEST_P(CameraLaws, HitherAndYonClipByDepth) {
  const Place place{{640, 480}, awkward()};
  const auto camera = make({number("hither", 0.5F), number("yon", 20)}, place);
  const auto open = make({}, place);
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) {
    const CameraSample s = randomSample(rng, place.resolution);
    const Ray ray = camera->generate(s, false).ray;
    const auto depth = [&](float t) {
      return place.toRender.inverse().point(DPoint3(ray.o) + double{t} * DVec3(ray.d)).z;
    };
    EXPECT_NEAR(depth(ray.tMin), 0.5, 1e-5);
    EXPECT_NEAR(depth(ray.tMax), 20, 1e-5);
    const Ray unclipped = open->generate(s, false).ray;
    EXPECT_EQ(unclipped.tMin, 0);
    EXPECT_EQ(unclipped.tMax, kInfinity);
  }
}

TEST_P(CameraLaws, ScreenIsWhatItsParametersSay) {
  // The film's corners, seen from the centre of the camera's axis, in screen units.
  const auto window = [&](const ParamList& list, Point2i resolution) {
    const auto m = make(list, {resolution, {}})->screenFromCamera().value();
    const Transform back(glm::inverse(m));
    const DPoint3 z1 = Transform(m).project({0, 0, 1});
    const DPoint3 lo = back.project({0, 1, z1.z}), hi = back.project({1, 0, z1.z});
    return glm::dvec4(lo.x, hi.x, lo.y, hi.y);
  };
  const auto expectNear = [](const glm::dvec4& a, const glm::dvec4& b) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[i], 1e-6) << i;
  };
  // A field of view of 90 degrees shows screen units at z = 1.
  expectNear(window({}, {200, 100}), {-2, 2, -1, 1});
  expectNear(window({}, {100, 400}), {-1, 1, -4, 4});
  expectNear(window({number("frameaspectratio", 0.5F)}, {300, 300}), {-1, 1, -2, 2});
  expectNear(window({screenWindow({-0.5F, 2, 0.25F, 1})}, {30, 70}), {-0.5, 2, 0.25, 1});
}

TEST_P(CameraLaws, NonsenseIsAnError) {
  for (const ParamList& bad : std::vector<ParamList>{
           {screenWindow({1, -1, -1, 1})},
           {screenWindow({-1, 1, 1, 1})},
           {screenWindow({-1, 1, 1})},
           {number("lensradius", -1)},
           {number("focaldistance", 0)},
           {number("frameaspectratio", 0)},
           {number("shutteropen", 2), number("shutterclose", 1)},
           {number("hither", 2), number("yon", 1)},
           {number("hither", -1)},
           {screenWindow({-1e30F, 1, -1, 1})},
           {number("frameaspectratio", 1e-30F)},
           {number("lensradius", 1e30F)},
           {number("lensradius", 1), number("focaldistance", 1e-30F)},
           {number("nosuch", 1)},
       })
    EXPECT_THROW(make(bad), Error) << bad.front().name;
}

}  // namespace
}  // namespace pbrt
