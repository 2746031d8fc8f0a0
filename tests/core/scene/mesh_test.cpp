// Triangles in place: points, derivatives, normals, samples, and rays that start on them.

#include "core/scene/mesh.h"

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/scene/accel.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

Vec3 uniform(Rng& rng) {
  return 2.F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.F;
}

TriangleMesh triangle(const Point3& a, const Point3& b, const Point3& c) {
  TriangleMesh mesh;
  mesh.positions = {a, b, c};
  mesh.indices = {0, 1, 2};
  return mesh;
}

// Random triangles, from needles to fat ones, of all sizes, near the origin and far from it; some
// in coordinate planes.
template <class Visit>
void forTriangles(int count, Visit visit) {
  Rng rng(5);
  for (int i = 0; i < count; ++i) {
    const float size = std::pow(10.F, 6 * rng.uniform() - 3);
    const float thin = std::pow(10.F, -7 * rng.uniform());
    const Vec3 where = uniform(rng) * size * std::pow(10.F, 4 * rng.uniform());
    Vec3 along = uniform(rng) * size, across = uniform(rng) * (size * thin);
    if (const int axis = i % 6; axis < 3) along[axis] = across[axis] = 0;
    TriangleMesh mesh = triangle(where, where + along, where + rng.uniform() * along + across);
    transformMesh(mesh, {});
    if (mesh.triangles() == 1) visit(mesh, rng);
  }
}

TEST(Mesh, ThePlaneIsWithinTheErrorOfEveryPoint) {
  forTriangles(20000, [](const TriangleMesh& mesh, Rng& rng) {
    const Point2 w = uniformTriangle({rng.uniform(), rng.uniform()});
    const SurfaceInteraction s = meshSurface(mesh, {1, w.x, w.y, 0, 0}, false, false);
    const DPoint3 a(mesh.positions[0]);
    const DVec3 n =
        glm::normalize(glm::cross(DPoint3(mesh.positions[1]) - a, DPoint3(mesh.positions[2]) - a));
    EXPECT_LE(std::abs(glm::dot(DPoint3(s.p) - a, n)), s.error);
    EXPECT_NEAR(glm::dot(DVec3(s.n), n), 1, 1e-6);
  });
}

TEST(Mesh, ARayFromAHitDoesNotMeetItsOwnPlaneAgain) {
  // Two triangles of one plane side by side: neither the one that was hit nor its neighbour.
  const AccelDevice device(1);
  int rays = 0, again = 0;
  forTriangles(16000, [&](const TriangleMesh& one, Rng& rng) {
    TriangleMesh mesh = one;
    mesh.positions.push_back(one.positions[1] + one.positions[2] - one.positions[0]);
    mesh.indices.insert(mesh.indices.end(), {2, 1, 3});
    Accel accel(device);
    accel.add(mesh);
    accel.build();
    for (int i = 0; i < 32; ++i) {
      const Point2 w = uniformTriangle({rng.uniform(), rng.uniform()});
      const SurfaceInteraction s = meshSurface(mesh, {1, w.x, w.y, 0, 0}, false, false);
      // The fourth corner is rounded, so that the planes agree only up to that: leave upward.
      std::array<Ray, 16> batch;
      for (Ray& ray : batch)
        ray =
            spawnRay(s, Frame::fromZ(s.n).fromLocal(cosHemisphere({rng.uniform(), rng.uniform()})));
      for (const Ray& ray : batch) {
        const Hit hit = accel.intersect(ray);
        again += hit.found() && hit.primitive == 0;
        ++rays;
      }
    }
  });
  EXPECT_GE(rays, 1'000'000);
  EXPECT_EQ(again, 0);
}

TEST(Mesh, RaysFromASliverInACoordinatePlaneStayUnderTheRoof) {
  // A board of 10 m by 6 mm, and light that must not come through a roof 5 mm above it.
  const TriangleMesh board = triangle({-5, 0, -0.003F}, {5, 0, -0.003F}, {5, 0, 0.003F});
  Rng rng(7);
  for (int i = 0; i < 1000; ++i) {
    const Point2 w = uniformTriangle({rng.uniform(), rng.uniform()});
    const SurfaceInteraction s = meshSurface(board, {1, w.x, w.y, 0, 0}, false, false);
    EXPECT_LT(spawnRay(s, {0, 1, 0}).o.y, 1e-4F);
  }
}

TEST(Mesh, NoAcneOnATurnedGridFarAway) {
  // A plane of many triangles, turned and moved by floats, so that it is not quite flat: a ray that
  // leaves more steeply than its bends meets none of them.
  const auto scene = test::buildText(
      "SurfaceIntegrator \"whitted\" WorldBegin Translate 300 -200 1000 Rotate 40 1 2 3\n"
      "ObjectBegin \"o\" Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
      "[-9 -9 0  9 -9 0  9 9 0  -9 9 0]\nTranslate 0 0 -100 Shape \"disk\" \"float radius\" 9\n"
      "ObjectEnd ObjectInstance \"o\" WorldEnd");
  const Transform place =
      Transform::translate({300, -200, 1000}) * Transform::rotate(40, {1, 2, 3});
  Rng rng(3);
  int again = 0, hits = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const DPoint3 on(6 * rng.uniform() - 3, 6 * rng.uniform() - 3, i % 2 ? 0 : -100);
    const Point3 o(place.point(place.point(on + DVec3(0, 0, 5))));
    const Vec3 d(place.vector(place.vector(DVec3(uniform(rng) * 0.3F) - DVec3(0, 0, 1))));
    const RayDifferential ray(Ray{o, 0, d, kInfinity, 0});
    const Hit hit = scene->intersect(ray);
    if (!hit.found()) continue;
    ++hits;
    const SurfaceInteraction s = scene->surface(ray, hit);
    const Vec3 w = Frame::fromZ(s.n).fromLocal(cosHemisphere({rng.uniform(), rng.uniform()}));
    Ray next = spawnRay(s, w);
    next.tMax = 50;
    again += scene->occluded(next);
  }
  EXPECT_GT(hits, 900'000);
  EXPECT_EQ(again, 0);
}

TEST(Mesh, DerivativesAreThoseOfUvAndOfTheUnitNormal) {
  forTriangles(2000, [](TriangleMesh mesh, Rng& rng) {
    for (int i = 0; i < 3; ++i) {
      mesh.uv.emplace_back(rng.uniform(), rng.uniform());
      mesh.normals.push_back(glm::normalize(Vec3(0, 0, 1) + 0.3F * uniform(rng)));
    }
    const Vec2 d1 = mesh.uv[1] - mesh.uv[0], d2 = mesh.uv[2] - mesh.uv[0];
    const float det = d1.x * d2.y - d1.y * d2.x;
    if (std::abs(det) < 0.05F) return;
    const auto at = [&](float b, float c) {
      return meshSurface(mesh, {1, b, c, 0, 0}, false, false);
    };
    const SurfaceInteraction s = at(0.3F, 0.3F);
    // Barycentric steps that move u alone and v alone by h.
    const float h = 1e-2F;
    const Vec2 du = Vec2(d2.y, -d1.y) * (h / det), dv = Vec2(-d2.x, d1.x) * (h / det);
    const SurfaceInteraction u0 = at(0.3F - du.x, 0.3F - du.y), u1 = at(0.3F + du.x, 0.3F + du.y);
    const SurfaceInteraction v0 = at(0.3F - dv.x, 0.3F - dv.y), v1 = at(0.3F + dv.x, 0.3F + dv.y);
    EXPECT_NEAR(u1.uv.x - u0.uv.x, 2 * h, 1e-4);
    EXPECT_NEAR(v1.uv.x - v0.uv.x, 0, 1e-4);
    const auto near = [&](const Vec3& got, const Vec3& a, const Vec3& b, float slack) {
      const Vec3 wanted = (b - a) / (2 * h);
      EXPECT_LE(glm::length(got - wanted), 0.02F * glm::length(wanted) + slack);
    };
    near(s.dpdu, u0.p, u1.p, 200 * s.error);
    near(s.dpdv, v0.p, v1.p, 200 * s.error);
    near(s.dndu, u0.ns, u1.ns, 0.02F);
    near(s.dndv, v0.ns, v1.ns, 0.02F);
  });
}

TEST(Mesh, NormalsAreUnitAtEverySize) {
  for (const float size : {1e-30F, 1e-18F, 1e-9F, 1.F, 1e12F, 1e18F}) {
    const TriangleMesh mesh = triangle({0, 0, 0}, {size, 0, 0}, {0, size, 0});
    EXPECT_EQ(meshSurface(mesh, {1, 0.2F, 0.2F, 0, 0}, false, false).n, Normal3(0, 0, 1)) << size;
    EXPECT_EQ(meshSurface(mesh, {1, 0.2F, 0.2F, 0, 0}, true, true).n, Normal3(0, 0, -1)) << size;
  }
}

TEST(Mesh, VertexNormalsDecideTheSideOfSurfaceAndSampler) {
  for (const float side : {-1.F, 1.F})
    for (const bool flip : {false, true})
      for (const bool reverse : {false, true}) {
        TriangleMesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        mesh.normals.assign(3, Normal3(0, 0, side));
        const SurfaceInteraction s = meshSurface(mesh, {1, 0.2F, 0.2F, 0, 0}, flip, reverse);
        EXPECT_EQ(s.n, Normal3(0, 0, reverse ? -side : side));
        EXPECT_EQ(s.ns, s.n);
        EXPECT_EQ(meshSampler(mesh, flip, reverse)->sample({0, 0, 5}, {0.3F, 0.3F}).n, s.n);
      }
}

TEST(Mesh, TrianglesWithoutAreaGo) {
  TriangleMesh mesh = triangle({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  mesh.positions.push_back({1, 0, 0});
  mesh.indices = {0, 1, 2, 0, 1, 3, 1, 1, 3};
  EXPECT_NE(meshSampler(mesh, false, false), nullptr);
  transformMesh(mesh, {});
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 3}));
  mesh = triangle({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  EXPECT_EQ(meshSampler(mesh, false, false), nullptr);
}

TEST(Mesh, TheSamplersDensityIsThatOfItsSamples) {
  // E[1 / pdf] is the solid angle; so is the mean of "hits the mesh" over all directions.
  TriangleMesh mesh = triangle({-1, -1, 0}, {2, -1, 0.5F}, {0, 1.5F, 0.2F});
  mesh.positions.push_back({3, 2, 1});
  mesh.indices = {0, 1, 2, 1, 3, 2};
  const auto sampler = meshSampler(mesh, false, false);
  const DPoint3 from(0.5, 0.2, 1.7);
  Rng rng(1);
  double solidAngle = 0;
  constexpr int kSamples = 400'000;
  for (int i = 0; i < kSamples; ++i) {
    const AreaSample s = sampler->sample(from, {rng.uniform(), rng.uniform()});
    EXPECT_EQ(s.pdf, sampler->pdf(from, s.p, s.n));
    solidAngle += 1 / (kSamples * double(s.pdf));
  }
  const AccelDevice device(1);
  Accel accel(device);
  accel.add(mesh);
  accel.build();
  int hits = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 w = uniformSphere({rng.uniform(), rng.uniform()});
    const bool hit = accel.occluded({Point3(from), 0, w, kInfinity, 0});
    hits += hit;
    if (hit) {
      EXPECT_TRUE(sampler->mayHit(from, w));
    }
  }
  const double p = double(hits) / kSamples;
  EXPECT_NEAR(solidAngle, 4 * kPi * p, 4 * kPi * 5 * std::sqrt(p * (1 - p) / kSamples));
}

}  // namespace
}  // namespace pbrt
