// Points chosen on the surface: where they lie, and whether their density is the one they tell.

#include "shapes/metaballs/area.h"

#include <gtest/gtest.h>

#include <numeric>

#include "shapes/metaballs/roots.h"
#include "tests/chi_square.h"
#include "tests/mean.h"
#include "tests/shapes/metaballs/clouds.h"

namespace pbrt::metaballs::test {
namespace {

using pbrt::test::Mean;

// By how many standard deviations two estimates of the same number differ. `floor` is for what is
// rarer than the samples can show.
double deviation(const Mean& a, const Mean& b, double floor = 0) {
  return (a.mean() - b.mean()) / std::sqrt(a.variance() + b.variance() + floor * floor);
}

struct Body {
  std::string name;
  Field field;
  Cells cells{field};
  PatchSampler sampler;

  Body(std::string n, Field f, int deepest = 12)
      : name(std::move(n)), field(std::move(f)), sampler(field, cells, deepest) {
    for (const Cell& cell : cells.cells()) box.add(cell.box);
    centre = 0.5 * (DPoint3(box.lo) + DPoint3(box.hi));
    radius = 0.5 * glm::length(DVec3(box.diagonal()));
  }
  std::optional<double> hit(const ObjectRay& ray) const {
    return nearest(cells, ray, [&](const Cell& cell, AtomList list, const ObjectRay& r) {
      return firstCrossing(field, cell, list, r);
    });
  }
  FieldSample at(const DPoint3& p) const {
    std::vector<std::uint32_t> all(field.atoms().size());
    std::iota(all.begin(), all.end(), 0U);
    return field.sample(p, all);
  }
  // The sampler's density per area: of solid angle, from a distance of one along the normal.
  double density(const DPoint3& p, const Normal3& n) const {
    return sampler.pdf(p + DVec3(n), p, n);
  }

  Bounds3 box;
  DPoint3 centre{0};
  double radius = 0;
};

// Two equal wyvill atoms at a distance of one, with a threshold at which the skin is just pinched
// through in the middle: f = 0 and grad f = 0 there.
Field pinched(double excess) {
  const double peak = 2 * Power<3>::value(0.25);
  std::vector<Atom> atoms;
  for (const float x : {-0.5F, 0.5F})
    atoms.push_back(atom(Kernel::wyvill, {x, 0, 0}, 1, (1 + excess) / peak));
  return {Kernel::wyvill, atoms};
}

// Two sheets, one close inside the other: a line meets both within a cell.
Field skin() {
  return {Kernel::wyvill,
          {atom(Kernel::wyvill, Point3(0), 1, 4), atom(Kernel::wyvill, Point3(0), 0.7F, -6.35)}};
}

Field shifted(const Field& field, const Point3& by) {
  std::vector<Atom> atoms;
  for (Atom a : field.atoms()) {
    a.centre += by;
    atoms.push_back(a);
  }
  return {field.kernel(), atoms};
}

std::vector<std::unique_ptr<Body>> bodies() {
  std::vector<std::unique_ptr<Body>> all;
  const auto add = [&](const std::string& name, Field field, int deepest = 12) {
    all.push_back(std::make_unique<Body>(name, std::move(field), deepest));
  };
  add("one", cloud(1, Kernel::poly6, 0, 1, 1));
  add("pinched", pinched(0));
  add("almost", pinched(1e-9));
  add("apart", pinched(-0.02));
  add("blob", cloud(7, Kernel::blob, 0, 1, 5));
  add("gaussian", cloud(7, Kernel::gaussian, 0, 1, 6));
  add("carved", cloud(12, Kernel::wyvill, 0.4, 1, 9));
  // Without splitting most patches are of the kind that else is only where the surface is pinched.
  add("rough skin", skin(), 0);
  add("roughly carved", cloud(12, Kernel::wyvill, 0.4, 1, 9), 0);
  add("small", cloud(5, Kernel::wyvill, 0.2, 1e-6, 2));
  add("far", shifted(cloud(5, Kernel::wyvill, 0.2, 1, 2), Point3(1e4F)));
  return all;
}

Point2 uniform2(Random& random) {
  return {random.uniform(), random.uniform()};
}

TEST(PatchSampler, PointsLieOnTheSurface) {
  for (const auto& body : bodies()) {
    Random random(11);
    int samples = 0, moved = 0;
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
      const DPoint3 from = body->centre + 3 * body->radius * random.cube();
      const AreaSample s = body->sampler.sample(from, uniform2(random));
      ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf >= 0);
      if (s.pdf == 0) continue;
      ++samples;
      worst = std::max(worst, s.error / body->radius);
      const DVec3 n(s.n), g = body->at(s.p).gradient;
      EXPECT_LT(glm::length(n + glm::normalize(g)), 1e-5) << body->name;
      EXPECT_GE(body->at(s.p - s.error * n).value, 0) << body->name;
      EXPECT_LE(body->at(s.p + s.error * n).value, 0) << body->name;
      EXPECT_EQ(body->sampler.pdf(from, s.p, s.n), s.pdf);
      EXPECT_TRUE(body->sampler.mayHit(from, s.p - from));
      // The point as a ray's hit brings it, in floats. It may end up in the next patch.
      const DPoint3 rounded(Point3(s.p - body->centre));
      moved +=
          std::abs(body->sampler.pdf(from, body->centre + rounded, s.n) - s.pdf) > 1e-3 * s.pdf;
    }
    std::printf("%s: %.3f of the draws give a sample, error / radius up to %.1e\n",
                body->name.c_str(), samples / 5000.0, worst);
    EXPECT_GT(samples, body->name.starts_with("rough") ? 1000 : 3000) << body->name;
    EXPECT_LT(worst, 1e-10) << body->name;
    EXPECT_LT(moved, 10) << body->name;
  }
}

// A lone atom is a ball: what it should give is known. From its centre, solid angles are areas.
TEST(PatchSampler, DrawsFollowTheDensityOnABall) {
  for (const Kernel kernel : {Kernel::poly6, Kernel::blob, Kernel::gaussian}) {
    const Body body("ball", Field(kernel, {atom(kernel, {1, 2, 3}, 2, 3, 2)}));
    const DPoint3 centre(1, 2, 3);
    const double r = *body.hit({centre, {0, 0, 1}});
    EXPECT_NEAR(body.sampler.area(), 4 * std::numbers::pi * r * r, 0.02 * body.sampler.area());

    constexpr int rows = 12, columns = 16, bins = rows * columns;
    const auto bin = [&](const DVec3& w) {
      const double z = 0.5 + 0.5 * w.z, turn = 0.5 + std::atan2(w.y, w.x) / (2 * std::numbers::pi);
      return std::clamp(int(z * rows), 0, rows - 1) * columns +
             std::clamp(int(turn * columns), 0, columns - 1);
    };
    Random random(8);
    constexpr int draws = 100000;
    std::vector<double> counts(bins + 1), expected(bins + 1);
    for (int i = 0; i < draws; ++i) {
      const AreaSample s = body.sampler.sample(centre, uniform2(random));
      ++counts[s.pdf > 0 ? bin(glm::normalize(s.p - centre)) : bins];
    }
    constexpr int grid = 1000;
    double sum = 0;
    for (int i = 0; i < grid; ++i)
      for (int j = 0; j < grid; ++j) {
        const Vec3 w = uniformSphere((Point2(i, j) + uniform2(random)) / float{grid});
        const double share = 4 * std::numbers::pi / (grid * grid) *
                             body.sampler.pdf(centre, centre + r * DVec3(w), w);
        expected[bin(DVec3(w))] += draws * share;
        sum += share;
      }
    expected[bins] = draws * (1 - sum);
    EXPECT_LT(pbrt::test::chiSquareDeviation(counts, expected), 4);
  }
}

// Lines through a ball of radius R, uniform in direction and place, meet a surface so that the
// mean of the sum of w(p) over their crossings is the integral of w over 2 pi R^2 (Crofton). With
// the density for w, restricted to a part of space and to the inner or outer side of the body: the
// share of draws that lie there. The total
// says that the density integrates to the share of draws that give a sample.
TEST(PatchSampler, DrawsFollowTheDensityOnAnyBody) {
  for (const auto& body : bodies()) {
    constexpr int slices = 2, bins = 2 * slices * slices * slices;
    const auto bin = [&](const DPoint3& p, const Normal3& n) {
      int index = glm::dot(DVec3(n), p - body->centre) > 0 ? 1 : 0;
      for (int k = 0; k < 3; ++k) {
        const double x = (p[k] - body->box.lo[k]) / body->box.diagonal()[k];
        index = slices * index + std::clamp(static_cast<int>(x * slices), 0, slices - 1);
      }
      return index;
    };
    Random random(21);
    std::vector<Mean> drawn(bins + 1), integrated(bins + 1);
    Mean area;
    for (int i = 0; i < 60000; ++i) {
      const AreaSample s = body->sampler.sample(body->centre, uniform2(random));
      const int at = s.pdf > 0 ? bin(s.p, s.n) : -1;
      for (int k = 0; k < bins; ++k) drawn[k].add(k == at ? 1 : 0);
      drawn[bins].add(at >= 0 ? 1 : 0);
    }
    const double measure = 2 * std::numbers::pi * sqr(body->radius);
    for (int i = 0; i < 10000; ++i) {
      const Frame frame = Frame::fromZ(Vec3(random.direction()));
      const Point2 d = concentricDisk(uniform2(random));
      ObjectRay ray{
          body->centre + body->radius * DVec3(d.x * frame.x + d.y * frame.y - 1.1F * frame.z),
          body->radius * DVec3(frame.z)};
      std::vector<double> sums(bins + 1);
      double crossings = 0;
      while (const auto t = body->hit(ray)) {
        const DPoint3 p = ray.at(*t);
        const Normal3 n(-glm::normalize(body->at(p).gradient));
        const double w = measure * body->density(p, n);
        sums[bin(p, n)] += w;
        sums[bins] += w;
        ++crossings;
        ray.tMin = *t + 1e-9;
      }
      area.add(measure * crossings);
      for (int k = 0; k <= bins; ++k) integrated[k].add(sums[k]);
    }
    for (int k = 0; k <= bins; ++k)
      EXPECT_LT(std::abs(deviation(drawn[k], integrated[k], 1e-4)), 5)
          << body->name << " " << k << " " << drawn[k].mean() << " " << integrated[k].mean();
    EXPECT_NEAR(body->sampler.area(), area.mean(),
                0.02 * area.mean() + 5 * std::sqrt(area.variance()))
        << body->name;
    std::printf("%s: area %.5g, by lines %.5g +- %.2g\n", body->name.c_str(), body->sampler.area(),
                area.mean(), std::sqrt(area.variance()));
  }
}

// What a body that glows sheds on a point, by its points and by directions out of all.
TEST(PatchSampler, LightsAsDirectionsSay) {
  for (const auto& body : bodies()) {
    Random random(31);
    for (const double distance : {0.02, 0.7, 3.0}) {
      // Outside, unless the point is near the middle: there it may be between two parts.
      DPoint3 from = body->centre;
      do from = body->centre + distance * body->radius * random.direction();
      while (body->at(from).value > 0 && distance > 0.5);
      const DVec3 m = random.direction();
      Mean byPoints, byDirections;
      for (int i = 0; i < 10000; ++i) {
        const AreaSample s = body->sampler.sample(from, uniform2(random));
        if (s.pdf == 0) {
          byPoints.add(0);
          continue;
        }
        const DVec3 w = s.p - from;
        const double cosine = glm::dot(glm::normalize(w), m);
        const bool seen = cosine > 0 && !body->hit({from, w, 1e-9, 1 - 1e-6});
        byPoints.add(seen ? cosine / s.pdf : 0);
      }
      for (int i = 0; i < 10000; ++i) {
        const DVec3 w = random.direction();
        const double cosine = glm::dot(w, m);
        const bool seen = cosine > 0 && body->hit({from, w, 1e-9 * body->radius});
        byDirections.add(seen ? 4 * std::numbers::pi * cosine : 0);
      }
      EXPECT_LT(std::abs(deviation(byPoints, byDirections, 1e-4)), 5)
          << body->name << " " << distance << " " << byPoints.mean() << " " << byDirections.mean();
    }
  }
}

TEST(PatchSampler, NothingGivesNothing) {
  const Body body("none", Field(Kernel::wyvill, {atom(Kernel::wyvill, {0, 0, 0}, 1, 0.5)}));
  EXPECT_EQ(body.sampler.area(), 0);
  EXPECT_EQ(body.sampler.sample({0, 0, 3}, {0.5F, 0.5F}).pdf, 0);
  EXPECT_EQ(body.sampler.pdf({0, 0, 3}, {0, 0, 1}, {0, 0, 1}), 0);
  EXPECT_FALSE(body.sampler.mayHit({0, 0, 3}, {0, 0, -1}));
}

}  // namespace
}  // namespace pbrt::metaballs::test
