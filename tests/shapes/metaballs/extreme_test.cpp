// Stiff and extreme sets: the first crossing against the oracle, and what the plug-in says of the
// surface there.

#include <gtest/gtest.h>

#include "tests/shapes/metaballs/sets.h"
#include "tests/support.h"

namespace pbrt::metaballs::test {
namespace {

using pbrt::test::make;

class Extreme : public testing::TestWithParam<Set> {};

TEST_P(Extreme, FirstCrossingIsProven) {
  Tally tally;
  for (const Kernel kernel : kAllKernels) {
    const Subject subject(GetParam().field(kernel));
    Random random(5);
    const int rays = static_cast<int>(100 + 1000 * GetParam().share);
    for (int i = 0; i < rays; ++i) {
      const ObjectRay ray = GetParam().ray(subject, random);
      EXPECT_TRUE(subject.judge(ray, tally)) << digits(ray);
    }
  }
  Tally::printHeader();
  tally.print(GetParam().name);
  RecordProperty("largest_error_over_h", std::to_string(tally.quantile(1)));
  EXPECT_GT(tally.hits, tally.rays / 40);
}

// A threshold for which strengths that are floats give this weight, to some 1e-13.
float thresholdFor(double weight) {
  float best = 1;
  double least = kInfinity;
  for (int i = 0; i < 1 << 18; ++i) {
    const float threshold = 1 + static_cast<float>(i) * 0x1p-22F;
    const double strength = static_cast<float>(weight * threshold);
    if (const double off = std::abs(strength / threshold - weight); off < least) {
      least = off;
      best = threshold;
    }
  }
  return best;
}

// The plug-in, and the same atoms as a field.
struct Made {
  Made(const Field& field, float threshold) : subject(rounded(field, threshold)) {
    std::vector<float> p, radii, strengths;
    for (const Atom& a : field.atoms()) {
      p.insert(p.end(), {a.centre.x, a.centre.y, a.centre.z});
      radii.push_back(a.radius);
      strengths.push_back(static_cast<float>(a.weight * threshold));
    }
    const auto kernel = static_cast<std::size_t>(field.kernel());
    shape = make<Shape>("metaballs", {pbrt::test::points("P", p),
                                      pbrt::test::value(ParamType::number, "radius", radii),
                                      pbrt::test::value(ParamType::number, "strength", strengths),
                                      pbrt::test::number("threshold", threshold),
                                      pbrt::test::text("kernel", std::string(kKernels[kernel]))});
    std::vector<Bounds3> boxes;
    for (std::uint32_t i = 0; i < shape->primitives(); ++i) boxes.push_back(shape->bounds(i));
    tree.emplace(std::move(boxes));
  }
  // With strengths that are floats. Not for poly6, whose weights are scaled.
  static Field rounded(const Field& field, float threshold) {
    std::vector<Atom> atoms;
    for (const Atom& a : field.atoms()) {
      const double strength = static_cast<float>(a.weight * threshold);
      atoms.push_back(atom(field.kernel(), a.centre, a.radius, strength / threshold, a.radius));
    }
    return {field.kernel(), std::move(atoms)};
  }

  std::optional<ShapeHit> hit(ObjectRay ray) const {
    std::optional<ShapeHit> best;
    tree->each(ray, [&](std::uint32_t i, ObjectRay& r) {
      if (const auto h = shape->intersect(r, i); h && !(best && exact(*best) <= exact(*h))) {
        best = h;
        r.tMax = h->t;
      }
      return false;
    });
    return best;
  }
  bool occluded(ObjectRay ray) const {
    return tree->each(ray,
                      [&](std::uint32_t i, const ObjectRay& r) { return shape->occluded(r, i); });
  }
  // What t loses as a float the shape carries in u.
  static double exact(const ShapeHit& hit) { return static_cast<double>(hit.t) + hit.u; }

  Subject subject;
  std::unique_ptr<Shape> shape;
  std::optional<Tree> tree;
};

// The surface passes between p - error n (inside) and p + error n (outside), and rays from either
// meet nothing that the oracle does not. Where the surface meets itself (gradient zero, as in a
// neck about to break) no distance along a normal can hold it; the rays must be right there too.
TEST_P(Extreme, SurfaceIsWithinItsError) {
  Tally spawned;
  int hits = 0, singular = 0, broken = 0;
  double largest = 0;  // error over the smallest support
  for (const Kernel kernel : {Kernel::wyvill, Kernel::blob, Kernel::gaussian}) {
    const Field field = GetParam().field(kernel);
    const bool isNeck = field.atoms().size() == 2;
    const Made made(field, isNeck ? thresholdFor(field.atoms()[0].weight) : 1);
    Random random(6);
    for (int i = 0; i < static_cast<int>(100 + 200 * GetParam().share); ++i) {
      const ObjectRay ray = GetParam().ray(made.subject, random);
      const auto hit = made.hit(ray);
      if (!hit) continue;
      ++hits;
      const SurfacePoint at = made.shape->surface(ray, *hit);
      const DVec3 n(at.n);
      ASSERT_NEAR(glm::length(n), 1, 1e-6);
      Oracle across(made.subject.blocks, {at.p - at.error * n, 2 * at.error * n, 0, 1});
      const double h = across.scale(0.5).radius;
      if (across.value(0) > 0 && across.value(1) < 0)
        largest = std::max(largest, at.error / h);
      else
        ++(h * glm::length(across.gradient(0.5)) < 1e-4 ? singular : broken);
      const DVec3 w = random.direction();
      const double side = glm::dot(w, n) < 0 ? -1 : 1;
      const ObjectRay from{at.p + side * at.error * n, w};
      const auto next = made.hit(from);
      const auto t = next ? std::optional(Made::exact(*next)) : std::nullopt;
      EXPECT_TRUE(Judge(made.subject.blocks, from)(t, made.occluded(from), spawned))
          << kKernels[static_cast<std::size_t>(kernel)] << " " << digits(from) << ", error "
          << at.error;
    }
  }
  std::printf("%d hits, %d where the surface meets itself, largest error %.1e h\n", hits, singular,
              largest);
  Tally::printHeader();
  spawned.print(GetParam().name);
  RecordProperty("largest_bound_over_h", std::to_string(largest));
  EXPECT_GT(hits, 5);
  EXPECT_EQ(broken, 0);
}

INSTANTIATE_TEST_SUITE_P(Sets, Extreme, testing::ValuesIn(extremeSets()),
                         [](const auto& i) { return i.param.identifier(); });

}  // namespace
}  // namespace pbrt::metaballs::test
