// Shapes in place where numbers are hardest: far from the origin, under transforms that are nearly
// singular, sheared or mirrored. The oracle is a sphere in 113 bits.

#include "core/scene/accel.h"
#include "core/scene/mesh.h"
#include "core/scene/placement.h"
#include "tests/scenes.h"
#include "tests/shapes/quadrics.h"

namespace pbrt {
namespace {

using test::Quad;
using QVec = std::array<Quad, 3>;

QVec quads(const DVec3& v) {
  return {v.x, v.y, v.z};
}
Quad dot(const QVec& a, const QVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The inverse of an affine map by cofactors.
struct Inverse {
  std::array<QVec, 3> rows{};
  QVec shift{};

  explicit Inverse(const Transform& t) {
    std::array<QVec, 3> c;  // columns
    for (int i = 0; i < 3; ++i) c[i] = quads(DVec3(t.matrix()[i]));
    const auto cross = [](const QVec& a, const QVec& b) -> QVec {
      return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    for (int i = 0; i < 3; ++i) {
      rows[i] = cross(c[(i + 1) % 3], c[(i + 2) % 3]);
      const Quad determinant = dot(rows[i], c[i]);
      for (Quad& x : rows[i]) x /= determinant;
    }
    shift = quads(DVec3(t.matrix()[3]));
  }
  QVec vector(const QVec& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  QVec point(const DVec3& p) const {
    return vector({p.x - shift[0], p.y - shift[1], p.z - shift[2]});
  }
};

// The nearer crossing from outside of a ray with the unit sphere under a map, and the unit normal
// there.
struct Expected {
  double t = 0, margin = 0;  // margin: as in sphere_test
  DVec3 n{};
};
Expected onSphere(const Ray& ray, const Transform& place) {
  const Inverse inverse(place);
  const QVec o = inverse.point(DVec3(ray.o)), d = inverse.vector(quads(DVec3(ray.d)));
  const Quad a = dot(d, d), b = dot(o, d), c = dot(o, o) - 1;
  const Quad discriminant = b * b - a * c;
  Expected e;
  e.margin = static_cast<double>(discriminant / a);
  if (discriminant < 0) return e;
  const Quad t = (-b - test::squareRoot(discriminant)) / a;
  e.t = static_cast<double>(t);
  // The inverse transpose times the normal of the sphere.
  DVec3 n(0);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) n[k] += static_cast<double>(inverse.rows[i][k] * (o[i] + t * d[i]));
  e.n = glm::normalize(n);
  return e;
}

struct Errors {
  double t = 0, normal = 0;  // the largest: relative; an angle in radians
  int hits = 0, wrong = 0;   // wrong: hit where there is nothing, or none where there is
};

// Rays in float at the unit sphere under `place`, as a scene traces them.
Errors measure(const Transform& place, const Point3& eye, float spread, bool instanced,
               double sure) {
  const auto sphere = test::make<Shape>("sphere");
  const AccelDevice device(1);
  Accel own(device), outer(device);
  own.add(*sphere, instanced ? Transform() : place);
  own.build();
  outer.add(own, place);
  outer.build();
  Rng rng(3);
  Errors errors;
  for (int i = 0; i < 20000; ++i) {
    const Point3 to(
        place.point((1.1 * spread) * DVec3(uniformSphere({rng.uniform(), rng.uniform()}))));
    const Ray ray{eye, 0, (to - eye) * (0.5F + rng.uniform()), kInfinity, 0};
    const Expected expected = onSphere(ray, place);
    if (std::abs(expected.margin) < sure) continue;
    const Hit hit = (instanced ? outer : own).intersect(ray);
    if (hit.found() != (expected.margin > 0)) ++errors.wrong;
    if (!hit.found() || expected.margin < sure) continue;
    ++errors.hits;
    const SurfaceInteraction s =
        placedSurface(*sphere, place, false, ray, {hit.t, hit.u, hit.v, hit.primitive});
    errors.t = std::max(errors.t, std::abs(hit.t - expected.t) / expected.t);
    errors.normal = std::max(errors.normal, glm::length(DVec3(s.n) - expected.n));
  }
  return errors;
}

// Seen from nearby, and from the origin, a ball at a million units has no rings: its normal is as
// good as floats are.
TEST(Extreme, BallsAMillionUnitsAway) {
  for (const double radius : {1.0, 1e3, 1e5})
    for (const DVec3& centre : {DVec3(1e6, 0, 0), DVec3(8e5, -8e5, 8e5), DVec3(3e5, 5e5, -8e5)}) {
      const Transform place = Transform::translate(centre) * Transform::scale(DVec3(radius));
      for (const bool near : {false, true}) {
        const Point3 eye(near ? centre + radius * DVec3(2, 3, -1) : DVec3(0));
        const Errors e = measure(place, eye, 1, false, 1e-4);
        EXPECT_GT(e.hits, 5000);
        EXPECT_EQ(e.wrong, 0);
        EXPECT_LE(e.t, 0x1p-23) << radius;
        EXPECT_LE(e.normal, 2e-7) << radius << " near " << near;
      }
    }
}

// The picture's space begins at the camera: from nearby a ball far from the origin is the same, bit
// for bit where its place is exact in floats.
TEST(Extreme, ASceneFarFromTheOriginIsTheSceneAtHome) {
  const auto picture = [](const std::string& there, const std::string& back) {
    return test::renderText("LookAt 0 1 4  0 0 0  0 1 0 " + back + R"(
      Camera "perspective" "float fov" 50
      Film "image" "integer xresolution" 32 "integer yresolution" 32
      Sampler "halton" "integer pixelsamples" 4 Integrator "whitted" WorldBegin )" +
                            there + R"(
      LightSource "distant" "point from" [1 1 1] "point to" [0 0 0]
      Shape "sphere" Translate 1 0 0 Shape "cone" Translate -2 0.5 0 Shape "paraboloid"
      Shape "curve" "point P" [0 0 0  1 1 0  1 0 1  0 0 2] "float width" 0.1 WorldEnd)");
  };
  const Image home = picture("", "");
  for (const char* far : {"1048576 0 0", "-524288 524288 131072"}) {
    std::string back = far;
    back = back == "1048576 0 0" ? "-1048576 0 0" : "524288 -524288 -131072";
    const Image there = picture("Translate " + std::string(far), "Translate " + back);
    double sum = 0, off = 0;
    for (std::size_t i = 0; i < home.channels[1].size(); ++i) {
      sum += home.channels[1][i];
      off += std::abs(home.channels[1][i] - there.channels[1][i]);
    }
    EXPECT_GT(sum, 10);
    EXPECT_LE(off, 1e-5 * sum) << far;
  }
}

// An object's ray is moved to its space in floats, at the origin of the ray: what a thousand times
// the ball's size away has rounding of a thousand units in the last place.
TEST(Extreme, InstancesKeepWhatFloatsAllow) {
  for (const double distance : {10.0, 1e3}) {
    const Transform place =
        Transform::translate({distance, 0, 0}) * Transform::rotate(30, {1, 2, 3});
    const Errors e = measure(place, Point3(0), 1, true, 1e-2);
    EXPECT_GT(e.hits, 5000);
    EXPECT_EQ(e.wrong, 0);
    EXPECT_LE(e.normal, 20 * distance * 0x1p-24) << distance;
  }
}

TEST(Extreme, NearlySingularShearedAndMirroredTransforms) {
  glm::dmat4 shear(1), strong(1);
  shear[2][0] = 10;
  strong[2][0] = 1e4, strong[1][2] = -300;
  struct Row {
    const char* what;
    Transform place;
    Point3 eye;
  };
  const std::vector<Row> rows{
      {"flat", Transform::scale({1, 1, 1e-6}), {2, 3, 4}},
      {"flatter", Transform::scale({1, 1, 1e-9}), {2, 3, 4}},
      {"needle", Transform::scale({1e6, 1, 1}), {1e5F, 3, 4}},
      {"thin disk, turned",
       Transform::rotate(50, {1, 2, 3}) * Transform::scale({1, 1e-7, 1}),
       {2, 3, 4}},
      {"mirrored", Transform::scale({-1, 1, 1}), {2, 3, 4}},
      {"mirrored thrice", Transform::scale({-2, -0.5, -3}), {5, 3, 4}},
      {"sheared", Transform(shear), {2, 3, 4}},
      {"sheared by far", Transform(strong), {2e4F, 3e2F, 4e4F}},
      {"all at once",
       Transform::translate({3, -2, 1}) * Transform(shear) * Transform::rotate(20, {3, 2, 1}) *
           Transform::scale({1e3, -1e-3, 1}),
       {2e3F, 3e2F, 4e3F}},
  };
  for (const Row& row : rows) {
    const Errors e = measure(row.place, row.eye, 1, false, 1e-3);
    EXPECT_GT(e.hits, 1000) << row.what;
    EXPECT_EQ(e.wrong, 0) << row.what;
    EXPECT_LE(e.t, 2e-7) << row.what;
    EXPECT_LE(e.normal, 2e-6) << row.what;
  }
}

}  // namespace
}  // namespace pbrt
