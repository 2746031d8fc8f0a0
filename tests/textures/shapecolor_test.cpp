#include "core/scene/placement.h"
#include "tests/scenes.h"
#include "tests/textures/library.h"

namespace pbrt::test {
namespace {

// A plane z = 0 whose colour is where it is hit, in its own space, and on which primitive.
class Chart final : public Shape, public SurfaceColor {
 public:
  Bounds3 bounds(std::uint32_t) const override { return {{-9, -9, 0}, {9, 9, 0}}; }
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t primitive) const override {
    return ShapeHit{static_cast<float>(-ray.o.z / ray.d.z), 0, 0, primitive};
  }
  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    SurfacePoint at;
    at.p = ray.at(hit.t);
    at.n = {0, 0, 1};
    return at;
  }
  const SurfaceColor* color() const override { return this; }
  Spectrum at(const DPoint3& p, std::uint32_t primitive) const override {
    return {p.x, p.y, primitive};
  }
};

SurfaceInteraction hitOf(const Chart& chart, const Transform& map, Point2 p,
                         std::uint32_t primitive) {
  const DPoint3 end(p, 0), from(1, 2, 3);
  const Ray ray{Point3(map.point(from)), 0, Vec3(map.vector(end - from)), kInfinity, 0};
  const auto hit = chart.intersect(map.inverse().ray(ray), primitive);
  return placedSurface(chart, map, false, ray, *hit);
}

TEST(ShapeColor, IsThatOfTheShapeInItsOwnSpace) {
  const Chart chart;
  for (const Transform& map : {Transform(), Transform::translate({50, 60, 70}),
                               Transform::scale({2, -1, 3}) * Transform::rotate(40, {1, 2, 3})}) {
    SurfaceInteraction at = hitOf(chart, map, {0.25F, 0.5F}, 3);
    const Spectrum color = make<Texture<Spectrum>>("shapecolor")->evaluate(at);
    EXPECT_LT(glm::length(color - Spectrum(0.25F, 0.5F, 3)), 1e-4F);
    EXPECT_EQ(make<Texture<float>>("shapecolor")->evaluate(at), luminance(color));

    // A further map, as of an instance whose interaction is carried over, leaves it alone.
    transformInteraction(at, Transform::scale(DVec3(7)));
    EXPECT_EQ(make<Texture<Spectrum>>("shapecolor")->evaluate(at), color);
  }
}

TEST(ShapeColor, FallsBackWhereThereIsNone) {
  SurfaceInteraction at;
  at.uv = {0.5F, 0};
  EXPECT_EQ(make<Texture<Spectrum>>("shapecolor")->evaluate(at), Spectrum(1));
  EXPECT_EQ(make<Texture<Spectrum>>("shapecolor", {rgb("fallback", 1, 2, 3)})->evaluate(at),
            Spectrum(1, 2, 3));
  EXPECT_EQ(make<Texture<float>>("shapecolor", {number("fallback", 4)})->evaluate(at), 4);
  EXPECT_EQ(makeOver<float>("shapecolor", {ramp("fallback")})->evaluate(at), 0.5F);
  EXPECT_FALSE(make<Texture<float>>("shapecolor")->filters());
  EXPECT_TRUE(makeOver<Spectrum>("shapecolor", {ramp("fallback")})->filters());
}

TEST(ShapeColor, FeedsAMaterialOfAScene) {
  const auto picture = [](const std::string& reflectance) {
    return renderText(
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "Sampler \"random\" \"integer pixelsamples\" 4\n"
        "LookAt 0 0 5  0 0 0  0 1 0\n"
        "Camera \"perspective\" \"float fov\" 10\n"
        "WorldBegin\n"
        "LightSource \"distant\" \"point from\" [ 0 0 1 ] \"point to\" [ 0 0 0 ]\n"
        "Texture \"own\" \"spectrum\" \"shapecolor\" \"rgb fallback\" [ 0.25 0.5 0.75 ]\n"
        "Material \"matte\" " +
        reflectance +
        "\n"
        "Shape \"sphere\"\n"
        "WorldEnd\n");
  };
  const Image textured = picture("\"texture Kd\" \"own\"");
  const Image constant = picture("\"rgb Kd\" [ 0.25 0.5 0.75 ]");
  for (const char* channel : {"R", "G", "B"}) {
    EXPECT_GT(mean(constant, channel), 0);
    EXPECT_FLOAT_EQ(mean(textured, channel), mean(constant, channel));
  }
}

}  // namespace
}  // namespace pbrt::test
