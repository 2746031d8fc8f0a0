// Perfect reflection and refraction in closed form, and the differentials of such rays.

#include "core/api/specular.h"
#include "core/base/rng.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

// One pixel from the origin along +z.
double along(const std::string& world, const std::string& integrator) {
  return test::mean(
      test::renderText("Camera \"perspective\" \"float fov\" 0.001\n"
                       "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
                       "Sampler \"random\" \"integer pixelsamples\" 1\nIntegrator " +
                       integrator + "\nWorldBegin\n" + world + "\nWorldEnd"),
      "G");
}

class Specular : public testing::TestWithParam<std::string> {};

TEST_P(Specular, AChainOfMirrorsEndsAtMaxdepth) {
  // Between two mirrors that face each other, one of which shines with radiance 1: the rays 1, 3,
  // 5, ... meet it, each weakened by the mirrors before.
  const std::string world =
      "Material \"mirror\" \"rgb Kr\" [0.5 0.5 0.5]\n"
      "TransformBegin Translate 0 0 -1 Shape \"disk\" TransformEnd\n"
      "AreaLightSource \"diffuse\" Translate 0 0 1 ReverseOrientation Shape \"disk\"\n";
  double expected = 0, weight = 1;
  for (int depth = 1; depth <= 9; ++depth, weight *= 0.5) {
    if (depth % 2 == 1) expected += weight;
    EXPECT_NEAR(along(world, '"' + GetParam() + "\" \"integer maxdepth\" " + std::to_string(depth)),
                expected, 1e-5)
        << depth;
  }
}

TEST_P(Specular, AGlassSlabSendsOnWhatTheSeriesSays) {
  // Frontal reflectance R = ((n - 1) / (n + 1))^2; all the inner reflections together let through
  // (1 - R)^2 / (1 - R^2) = (1 - R) / (1 + R).
  const std::string world =
      "AttributeBegin AreaLightSource \"diffuse\" Translate 0 0 9 ReverseOrientation\n"
      "Shape \"disk\" \"float radius\" 5 AttributeEnd\n"
      "Material \"glass\" \"float index\" 1.5\nTranslate 0 0 1 Shape \"disk\"\n";
  const std::string slab =
      "TransformBegin ReverseOrientation Shape \"disk\" ReverseOrientation\n"
      "TransformEnd Translate 0 0 1 Shape \"disk\"\n";
  const std::string base = world.substr(0, world.rfind("Shape"));
  const double R = sqr(0.5 / 2.5);
  EXPECT_NEAR(along(base + slab, '"' + GetParam() + "\" \"integer maxdepth\" 12"),
              (1 - R) / (1 + R), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Specular, testing::Values("whitted", "directlighting"),
                         [](const auto& test) { return test.param; });

// The ray that follows the hit of a ray, by one lobe.
RayDifferential followed(const Scene& scene, const RayDifferential& ray, std::uint8_t lobe) {
  const Hit hit = scene.intersect(ray);
  EXPECT_TRUE(hit.found());
  SurfaceInteraction at = scene.surface(ray, hit);
  Scratch scratch;
  const auto s = scene.bsdf(at, scratch).sample(at.wo, {0.5F, 0.5F}, lobe | kSpecular);
  EXPECT_TRUE(s);
  return specularRay(at, ray, s.value_or(BsdfSample{}));
}

TEST(SpecularRay, DifferentialsAreThoseOfRealNeighbours) {
  // A sphere, in place as it is, scaled, inside out, and as an instance.
  for (const std::string& place :
       {std::string("Shape \"sphere\" \"float radius\" 2"),
        std::string("Scale 2 2 2 Shape \"sphere\""),
        std::string("Scale 20 20 20 Shape \"sphere\" \"float radius\" 0.1"),
        std::string("Scale 2 3 1.5 Shape \"sphere\""),
        std::string("TransformBegin Identity ObjectBegin \"o\" Scale 4 4 4 Shape "
                    "\"sphere\" ObjectEnd TransformEnd Scale 0.5 0.5 0.5 "
                    "ObjectInstance \"o\"")}) {
    const auto scene = test::buildText(
        "SurfaceIntegrator \"whitted\" WorldBegin Material \"glass\"\n"
        "Translate 0.3 0.2 6 Rotate 70 1 1 0\n" +
        place + "\nWorldEnd");
    for (const Vec3& start : {Vec3(0), Vec3(0.3F, 0.2F, 6)}) {
      const float h = 2e-3F;
      const Vec3 d = glm::normalize(Vec3(0.03F, -0.05F, 1));
      const auto ray = [&](const Vec3& direction) {
        RayDifferential r(Ray{start, 0, glm::normalize(direction), kInfinity, 0});
        r.hasDifferentials = true;
        r.rxOrigin = r.ryOrigin = start;
        r.rxDirection = glm::normalize(direction + Vec3(h, 0, 0));
        r.ryDirection = glm::normalize(direction + Vec3(0, h, 0));
        return r;
      };
      for (const std::uint8_t lobe : {kReflection, kTransmission}) {
        const RayDifferential out = followed(*scene, ray(d), lobe);
        const RayDifferential x = followed(*scene, ray(d + Vec3(h, 0, 0)), lobe);
        const RayDifferential y = followed(*scene, ray(d + Vec3(0, h, 0)), lobe);
        const auto near = [&](const Vec3& got, const Vec3& real, const Vec3& centre, float least) {
          EXPECT_LT(glm::length(got - real), 0.05F * glm::length(real - centre) + least)
              << place << (lobe == kReflection ? " reflected" : " refracted") << start.z;
        };
        near(out.rxDirection, x.d, out.d, 1e-5F);
        near(out.ryDirection, y.d, out.d, 1e-5F);
        near(out.rxOrigin, x.o, out.o, 2e-5F);
        near(out.ryOrigin, y.o, out.o, 2e-5F);
      }
    }
  }
}

}  // namespace
}  // namespace pbrt
