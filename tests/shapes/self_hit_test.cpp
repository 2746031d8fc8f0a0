// A ray that leaves a surface does not meet it again at once: a million rays for every shape
// plug-in of the build, in floats, where a scene would put it.

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/scene/accel.h"
#include "core/scene/mesh.h"
#include "core/scene/placement.h"
#include "tests/shapes/conformance.h"

namespace pbrt {
namespace {

using test::Case;

// The shape alone in a ray tree: turned, stretched, mirrored, and moved by three hundred times its
// size.
class Placed {
 public:
  explicit Placed(const Case& c) : shape_(test::make<Shape>(c.shape, c.row.params)) {
    mesh_ = shape_->triangles();
    Bounds3 own;
    if (mesh_)
      for (const Point3& p : mesh_->positions) own.add(p);
    for (std::uint32_t i = 0; !mesh_ && i < shape_->primitives(); ++i) own.add(shape_->bounds(i));
    const double size = glm::length(own.diagonal());
    place_ = Transform::translate(size * DVec3(200, -150, 100)) * Transform::rotate(40, {1, 2, 3}) *
             Transform::scale({1.5, 0.6, -0.9});
    if (mesh_) transformMesh(*mesh_, place_);
    box_ = place_.bounds(own);
    if (mesh_)
      tree_.add(*mesh_);
    else
      tree_.add(*shape_, place_);
    tree_.build();
  }

  Ray towards(Rng& rng) const {
    const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
    const Point3 to = box_.lo + u * box_.diagonal();
    const Vec3 aside = uniformSphere({rng.uniform(), rng.uniform()});
    const Point3 o = box_.centre() + 1.5F * glm::length(box_.diagonal()) * aside;
    return {o, 0, to - o, kInfinity, 0};
  }
  Hit intersect(const Ray& ray) const { return tree_.intersect(ray); }
  SurfaceInteraction surface(const Ray& ray, const Hit& hit) const {
    return mesh_ ? meshSurface(*mesh_, hit, false, false)
                 : placedSurface(*shape_, place_, false, ray, {hit.t, hit.u, hit.v, hit.primitive});
  }

 private:
  std::unique_ptr<Shape> shape_;
  TriangleMesh* mesh_;
  Transform place_;
  Bounds3 box_;
  AccelDevice device_{1};
  Accel tree_{device_};
};

class SelfHits : public testing::TestWithParam<std::string> {};

TEST_P(SelfHits, NoneInAMillionRays) {
  std::vector<Case> cases = test::cases();
  std::erase_if(cases, [](const Case& c) { return c.shape != GetParam(); });
  ASSERT_FALSE(cases.empty());
  const int starts = 1'000'000 / 16 / static_cast<int>(cases.size()) + 1;
  int rays = 0;
  for (const Case& c : cases) {
    const Placed placed(c);
    Rng rng(9);
    int found = 0, again = 0;
    for (int tries = 0; found < starts && tries < 100 * starts; ++tries) {
      const Ray ray = placed.towards(rng);
      const Hit hit = placed.intersect(ray);
      if (!hit.found()) continue;
      const SurfaceInteraction s = placed.surface(ray, hit);
      // What bends meets itself soon if left along it, at 2 cos / curvature: near a tip that is
      // within its error. What faces every ray is left by its width: any hit within it is one too
      // many.
      const bool facing = c.row.traits.facingWidth > 0;
      const float soon = facing ? 0.01F : 20;
      if (!facing && glm::length(s.dndu) * s.error > 5e-4F * glm::length(s.dpdu)) continue;
      ++found;
      for (int i = 0; i < 16; ++i, ++rays) {
        const Vec3 w = uniformSphere({rng.uniform(), rng.uniform()});
        if (std::abs(glm::dot(w, s.n)) < 0.01F) continue;
        const Hit next = placed.intersect(spawnRay(s, w));
        again += next.found() && next.primitive == hit.primitive && next.t < soon * s.error;
      }
    }
    EXPECT_EQ(found, starts) << c.row.label << " is hardly ever hit";
    EXPECT_EQ(again, 0) << c.row.label;
  }
  EXPECT_GE(rays, 1'000'000);
}

INSTANTIATE_TEST_SUITE_P(Every, SelfHits,
                         testing::ValuesIn(test::loader().available(PluginKind::shape)),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace pbrt
