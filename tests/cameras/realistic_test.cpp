// The camera with a lens of glass: its rays against a second tracer, its light against closed
// forms.

#include "core/base/rng.h"
#include "tests/cameras/lenses.h"
#include "tests/mean.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

using test::LensRows;
using test::number;
using test::text;

constexpr double kSigmas = 4.5;

// Where on the film, in mm, seen from the scene's side: x right, y up.
glm::dvec2 filmPlace(Point2 raster) {
  const double mm = 43.27F / std::hypot(90.0, 60.0);
  return {(45 - raster.x) * mm, (raster.y - 30) * mm};
}

// Of the double Gauss: its distance to the film when that is sharp `focus` mm ahead of it. Found
// with rays near the axis from there, by where they cross it.
long double filmDistance(const LensRows& rows, long double focus) {
  long double distance = 0;
  const long double length = test::lengthOf(rows);
  for (int i = 0; i < 20; ++i) {
    const test::LVec3 eye(0, 0, -(focus - length - distance));
    test::LightRay ray{eye, glm::normalize(test::LVec3(1e-4L, 0, 0) - eye)};
    EXPECT_TRUE(test::traceToFilm(rows, 1, ray));
    distance = ray.o.z - ray.o.x / ray.d.x * ray.d.z - length;
  }
  return distance;
}

TEST(RealisticCamera, RaysGoBackTheWayTheyCame) {
  const LensRows rows = test::readLens(test::kDoubleGauss);
  ASSERT_EQ(rows.size(), 11U);
  for (const float stop : {17.1F, 4.F, 0.01F})
    for (const float focus : {300.F, 2000.F, 1e7F}) {
      const auto c = test::lensCamera(
          test::kDoubleGauss, {number("aperturediameter", stop), number("focusdistance", focus)});
      const long double length = test::lengthOf(rows), behind = filmDistance(rows, focus);
      Rng rng(1);
      int came = 0;
      for (int i = 0; i < 3000; ++i) {
        const CameraSample s = test::randomSample(rng);
        const CameraRay r = c->generate(s, false);
        if (r.weight == 0) continue;
        ++came;
        // Camera space has the film at 0 and looks along +z.
        test::LightRay back{test::LVec3(r.ray.o), -glm::normalize(test::LVec3(r.ray.d))};
        back.o.z = length + behind - back.o.z;
        back.d.z = -back.d.z;
        // Rims may decide otherwise within the rounding of the ray.
        ASSERT_TRUE(test::traceToFilm(rows, stop / 2 + 1e-4L, back));
        back.o += (length + behind - back.o.z) / back.d.z * back.d;
        const glm::dvec2 film = filmPlace(s.film);
        EXPECT_NEAR(static_cast<double>(back.o.x), film.x, 1e-4);
        EXPECT_NEAR(static_cast<double>(back.o.y), film.y, 1e-4);
      }
      EXPECT_GT(came, 1000) << stop << " " << focus;
    }
}

// Irradiance of a film point under a sky of radiance 1, by the camera's own weights.
test::Mean irradiance(const Camera& c, Point2 raster, int n, std::uint64_t seed) {
  Rng rng(seed);
  test::Mean mean;
  for (int i = 0; i < n; ++i)
    mean.add(c.generate({raster, {rng.uniform(), rng.uniform()}, 0}, false).weight);
  return mean;
}

// If the stop lies in the plane of the last vertex, glass before it changes nothing: a film point
// at r from the axis and d behind a disc of radius a gets
//   pi / 2 (1 - (d^2 + r^2 - a^2) / sqrt((d^2 + r^2 + a^2)^2 - 4 r^2 a^2)).
TEST(RealisticCamera, LightOfAThinLensIsThatOfADisc) {
  for (const double diameter : {1e-3, 1.0, 25.0})
    for (const double d : {20.0, 55.0, 400.0}) {
      const auto c = test::lensCamera(test::thinLens(50, diameter),
                                      {test::flag("simpleweighting", false),
                                       number("aperturediameter", static_cast<float>(diameter)),
                                       number("filmdistance", static_cast<float>(d))});
      for (const Point2 raster : {Point2(45, 30), Point2(70, 30), Point2(1, 2)}) {
        const test::Mean mean = irradiance(*c, raster, 40000, 2);
        const double r2 = lengthSquared(DVec3(filmPlace(raster), 0)), a2 = sqr(diameter / 2);
        // 1 - x / sqrt(y) without its cancellation, as y - x^2 = 4 a^2 d^2.
        const double x = d * d + r2 - a2, y = sqr(d * d + r2 + a2) - 4 * r2 * a2;
        const double expected =
            std::numbers::pi / 2 * 4 * a2 * d * d / (std::sqrt(y) * (std::sqrt(y) + x));
        EXPECT_NEAR(mean.mean(), expected, kSigmas * std::sqrt(mean.variance()) + 1e-5 * expected)
            << diameter << " " << d << " " << raster.x;
        EXPECT_LT(std::sqrt(mean.variance()), 0.01 * expected);
      }
    }
}

// Backwards through the stack means forwards through the one turned about.
LensRows turnedAbout(const LensRows& rows) {
  LensRows turned;
  for (std::size_t i = rows.size(); i-- > 0;)
    turned.push_back({-rows[i].radius, i > 0 ? rows[i - 1].thickness : 0,
                      i > 0 ? rows[i - 1].index : 1, rows[i].diameter});
  return turned;
}

// x on the plane of the first vertex from which light of a point of the meridian comes to a height
// at the stop, found by secants. Rims do not matter.
long double entrance(LensRows rows, const test::LVec3& from, long double height) {
  rows.erase(std::ranges::find(rows, 0, &test::LensRow::radius) + 1, rows.end());
  for (test::LensRow& row : rows) row.diameter = 1e9L;
  const auto miss = [&](long double x) {
    test::LightRay ray{from, glm::normalize(test::LVec3(x, 0, 0) - from)};
    EXPECT_TRUE(test::traceToFilm(rows, 1e9L, ray));
    return ray.o.x - height;
  };
  long double x0 = 0, x1 = 1, m0 = miss(x0), m1 = miss(x1);
  for (int i = 0; i < 30 && m1 != m0; ++i) {
    const long double x2 = x1 - m1 * (x1 - x0) / (m1 - m0);
    x0 = std::exchange(x1, x2);
    m0 = std::exchange(m1, miss(x2));
  }
  EXPECT_NEAR(static_cast<double>(m1), 0, 1e-12);
  return x1;
}

// No light is cut off by the outline that rays are sampled in: its integral is that of rays to a
// square about all of the last surface, or about what a small stop leaves of it, by the second
// tracer.
TEST(RealisticCamera, AllOfThePupilIsSampled) {
  const LensRows turned = turnedAbout(test::readLens(test::kDoubleGauss));
  const long double behind = filmDistance(test::readLens(test::kDoubleGauss), 2000);
  for (const float stop : {17.1F, 8.F, 1e-3F, 3e-4F})
    for (const float x : {45.F, 50.F, 60.F, 75.F, 89.F}) {
      const auto c = test::lensCamera(
          test::kDoubleGauss, {test::flag("simpleweighting", false), number("focusdistance", 2000),
                               number("aperturediameter", stop)});
      const test::Mean own = irradiance(*c, {x, 30}, 50000, 3);
      const test::LVec3 film(filmPlace({x, 30}).x, 0, -behind);
      const bool small = stop < 1;
      const long double middle = small ? entrance(turned, film, 0) : 0;
      const long double half =
          small ? 1.5L * std::abs(entrance(turned, film, stop / 2) - middle) : 15;
      Rng rng(4);
      test::Mean all;
      for (int i = 0; i < 80000; ++i) {
        const test::LVec3 rear(middle + half * (2 * rng.uniform() - 1),
                               half * (2 * rng.uniform() - 1), 0);
        test::LightRay ray{film, glm::normalize(rear - film)};
        const auto cosine = static_cast<double>(ray.d.z);
        const bool through = test::traceToFilm(turned, stop / 2, ray);
        all.add(through ? sqr(sqr(cosine)) * static_cast<double>(sqr(2 * half / behind)) : 0);
      }
      EXPECT_NEAR(own.mean(), all.mean(), kSigmas * std::sqrt(own.variance() + all.variance()))
          << stop << " " << x;
      // Nor are many rays wasted: weights are nearly all alike, where others are mostly 0. Of a
      // tiny stop half are of use: it is smaller than what its way over the film may be missed
      // by.
      EXPECT_LT(50000 * own.variance(), (small ? 1.5 : 0.15) * sqr(own.mean())) << stop << " " << x;
    }
}

// Half of the width in mm of what a film place sees of the plane `focus` ahead of the film.
double spot(const Camera& c, double focus, Point2 raster) {
  Rng rng(5);
  glm::dvec2 lo(kInfinity), hi(-kInfinity);
  for (int i = 0; i < 500; ++i) {
    const CameraRay r = c.generate({raster, {rng.uniform(), rng.uniform()}, 0}, false);
    if (r.weight == 0) continue;
    const DPoint3 o(r.ray.o);
    const DVec3 d(r.ray.d);
    const glm::dvec2 p(o + (focus - o.z) / d.z * d);
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  return 0.5 * std::max(hi.x - lo.x, hi.y - lo.y);
}

TEST(RealisticCamera, APointAtTheFocusDistanceIsSharp) {
  for (const float focus : {400.F, 1000.F, 5000.F, 1e5F}) {
    const auto setting = [&](float stop) {
      return ParamList{number("aperturediameter", stop), number("focusdistance", focus)};
    };
    // On the film, by the magnification of a lens of 50 mm.
    const double onFilm = 50 / (focus - 50.0);
    const auto open = test::lensCamera(test::kDoubleGauss, setting(17.1F));
    const auto narrow = test::lensCamera(test::kDoubleGauss, setting(2.F));
    EXPECT_LT(onFilm * spot(*open, focus, {45, 30}), 0.05) << focus;
    EXPECT_LT(onFilm * spot(*narrow, focus, {45, 30}), 2.5e-4) << focus;
    // What is not in focus is blurred, by similar triangles: from the focus on the cone of rays
    // grows evenly, and far away it is as wide as the stop looks from the scene: the front half of
    // this lens magnifies it 1.4506 times.
    const auto pinhole = test::lensCamera(test::kDoubleGauss, setting(0.5F));
    const double blur = spot(*pinhole, 2 * focus, {45, 30});
    EXPECT_NEAR(spot(*pinhole, 4 * focus, {45, 30}) / blur, 3, 0.1) << focus;
    EXPECT_TRUE(focus < 1e4 || std::abs(blur - 0.25 * 1.4506) < 0.03) << blur;
  }
}

TEST(RealisticCamera, BrightnessOfAllApertureShapesIsTheSame) {
  const test::Folder folder;
  const std::string black(4, '\0'), white("\0\0\x80\x3f", 4);
  folder.write("half.pfm", "Pf\n1 2\n-1\n" + black + white);
  folder.write("white.pfm", "Pf\n2 1\n-1\n" + white + white);
  for (const std::string& shape :
       {std::string("gaussian"), std::string("square"), std::string("pentagon"),
        std::string("star"), (folder.path() / "half.pfm").string(),
        (folder.path() / "white.pfm").string()}) {
    const auto c = test::lensCamera(test::thinLens(50, 1),
                                    {text("aperture", shape), test::flag("simpleweighting", false),
                                     number("filmdistance", 100)});
    const test::Mean mean = irradiance(*c, {45, 30}, 100000, 6);
    const double circle = std::numbers::pi * sqr(0.5) / (sqr(0.5) + sqr(100));
    EXPECT_NEAR(mean.mean(), circle, kSigmas * std::sqrt(mean.variance())) << shape;
  }
}

// Seen from the film, the upper half of the picture lets light through: it leaves upwards.
TEST(RealisticCamera, ApertureShapesAreUpright) {
  const test::Folder folder;
  // A PFM file begins with its lowest row.
  folder.write("upper.pfm", std::string("Pf\n1 2\n-1\n") + std::string("\0\0\0\0\0\0\x80\x3f", 8));
  const auto mean = [&](const std::string& shape) {
    const auto c = test::lensCamera(
        test::thinLens(50, 10),
        {text("aperture", shape), number("aperturediameter", 10), number("filmdistance", 100)});
    Rng rng(7);
    glm::dvec3 sum(0);
    for (int i = 0; i < 20000; ++i) {
      const CameraRay r = c->generate({{45, 30}, {rng.uniform(), rng.uniform()}, 0}, false);
      sum += glm::dvec3(double{r.weight} * r.ray.o.x, double{r.weight} * r.ray.o.y, r.weight);
    }
    return glm::dvec2(sum) / sum.z;
  };
  EXPECT_GT(mean((folder.path() / "upper.pfm").string()).y, 1);
  for (const std::string shape : {"square", "pentagon", "star", "gaussian"}) {
    EXPECT_NEAR(mean(shape).x, 0, 0.1) << shape;
    EXPECT_NEAR(mean(shape).y, 0, 0.1) << shape;
  }
}

// By pbrt-v3's simple weighting a full circle in its square has pi / 4, whatever stop and film.
TEST(RealisticCamera, SimpleBrightnessIsThatOfAFullCircle) {
  for (const float stop : {17.1F, 1.F, 1e-3F}) {
    const auto c = test::lensCamera(
        test::kDoubleGauss, {number("aperturediameter", stop), number("focusdistance", 3000)});
    const test::Mean mean = irradiance(*c, {45, 30}, 50000, 8);
    const double cosines = stop > 10 ? 0.05 : 1e-3;
    EXPECT_NEAR(mean.mean(), std::numbers::pi / 4, kSigmas * std::sqrt(mean.variance()) + cosines);
  }
}

TEST(RealisticCamera, TimeAddsLight) {
  const auto light = [](const ParamList& more) {
    ParamList list = more;
    list.push_back(number("shutterclose", 0.25F));
    return irradiance(*test::lensCamera(test::kDoubleGauss, list), {45, 30}, 1000, 9).mean();
  };
  const Param no = test::flag("simpleweighting", false);
  const double untimed = light({no, test::flag("timeweighting", false)});
  EXPECT_NEAR(light({no}), 0.25 * untimed, 1e-6 * untimed);
}

// Neighbours are those that the next pixel's rays have, which a tiny stop makes one.
TEST(RealisticCamera, DifferentialsAreTheNeighboursRays) {
  const Transform moved = Transform::translate({3, -2, 7}) * Transform::rotate(50, {1, 2, -1});
  const auto c = test::lensCamera(test::kDoubleGauss, {number("aperturediameter", 1e-4F)},
                                  {moved, {90, 60}, 43.27F});
  Rng rng(10);
  for (int i = 0; i < 300; ++i) {
    CameraSample s = test::randomSample(rng);
    s.film = glm::clamp(s.film, Point2(2), Point2(87, 57));
    const CameraRay r = c->generate(s, true);
    if (r.weight == 0) continue;
    ASSERT_TRUE(r.ray.hasDifferentials);
    for (int axis = 0; axis < 2; ++axis) {
      CameraSample next = s;
      next.film[axis] += 1;
      const CameraRay n = c->generate(next, false);
      if (n.weight == 0) continue;
      EXPECT_LT(glm::distance(axis ? r.ray.ryDirection : r.ray.rxDirection, n.ray.d), 2e-3F);
      EXPECT_GT(glm::distance(r.ray.d, n.ray.d), 5e-3F);
    }
  }
}

}  // namespace
}  // namespace pbrt
