// Every law of cameras finds the camera that breaks it.

#include <atomic>

#include "core/plugin/plugin.h"
#include "core/plugin/projective_camera.h"
#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum Kind {
  kGood,
  kLong,
  kNoNumber,
  kNegative,
  kSeesACircle,
  kStays,
  kAlwaysDifferential,
  kFarNeighbours,
  kSecretLens,
  kNoShutter,
  kUpsideDown,
  kBackwards,
  kBlurred,
  kNoClip,
  kNoWindow,
  kCountsCalls,
  kCountsObjects,
  kAllocates
};

// Parallel rays, as those of "orthographic", but for what is wrong with them.
template <Kind kind>
class Parallel final : public ProjectiveCamera {
 public:
  Parallel(Params& p, const Setup& setup)
      : ProjectiveCamera(p, kind == kStays ? Setup{{}, setup.resolution} : setup),
        resolution_(setup.resolution) {
    static float objects = 0;
    if (kind == kCountsObjects) shift_ = ++objects;
  }

  CameraRay generate(const CameraSample& sample, bool differentials) const override {
    CameraRay result;
    RayDifferential& ray = result.ray;
    const Point2 film = fromMiddle(sample.film);
    const Vec3 right(window().pixel().x * x()), down(window().pixel().y * y());
    ray.o = Point3(origin() + window().centre().x * x() + window().centre().y * y()) +
            (film.x + shift_) * right + film.y * down;
    Vec3 d(kind == kBackwards ? -z() : z());
    if (!pinhole()) {
      ray.o += lens(sample.lens);
      if (kind != kBlurred) d -= inverseFocus() * lens(sample.lens);
    }
    finish(ray, d, sample.time);
    if (differentials || kind == kAlwaysDifferential) {
      const float step = kind == kFarNeighbours ? 1.01F : 1;
      ray.hasDifferentials = true;
      ray.rxOrigin = ray.o + step * right;
      ray.ryOrigin = ray.o + step * down;
      ray.rxDirection = ray.ryDirection = ray.d;
    }
    if (kind == kLong) ray.d *= 1.01F;
    if (kind == kNoNumber && sample.film.x < 10) ray.o.x = std::numeric_limits<float>::quiet_NaN();
    if (kind == kNegative) result.weight = sample.lens.x - 0.5F;
    if (kind == kSecretLens) ray.o.x += sample.lens.x;
    if (kind == kNoShutter) ray.time = sample.time;
    if (kind == kSeesACircle && glm::length(film) > 20)
      return {RayDifferential(), 0};  // nobody asks what ray it would be
    if (kind == kNoClip) ray.tMin = 0, ray.tMax = kInfinity;
    if (kind == kCountsCalls) ray.time += static_cast<float>(++calls_ % 7);
    if (kind == kAllocates) ::operator delete(::operator new(16));
    return result;
  }

  std::optional<glm::dmat4> screenFromCamera() const override {
    if (kind == kNoWindow) {
      Params nothing("nothing", {}, {});
      return ScreenWindow(nothing, resolution_).toNdc();
    }
    glm::dmat4 m = window().toNdc();
    if (kind == kUpsideDown)
      m = glm::dmat4({1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 1}) * m;
    return m;
  }

 private:
  Point2i resolution_;
  float shift_ = 0;
  mutable std::atomic<int> calls_ = 0;
};

// Reads a lens and a shutter, whatever they are, and has none.
class Careless final : public Camera {
 public:
  explicit Careless(Params& p) {
    for (const char* name : {"lensradius", "focaldistance", "hither", "yon"})
      p.number(name, 1, "not looked at");
  }
  CameraRay generate(const CameraSample&, bool) const override { return {}; }
  std::optional<glm::dmat4> screenFromCamera() const override { return glm::dmat4(1); }
};

template <Kind kind>
const PluginInfo* plugin() {
  return &own<Camera, Parallel<kind>>();
}

TEST(CameraLaws, AreObeyedByParallelRays) {
  expectGood({plugin<kGood>()});
  EXPECT_EQ(judged({plugin<kSeesACircle>()}, "well-formed-rays").failures(), 0U);
  EXPECT_EQ(judged({plugin<kSeesACircle>()}, "moves-with-its-space").failures(), 0U);
}

TEST(CameraLaws, FindEveryFlaw) {
  expectFound(PluginKind::camera,
              {
                  {plugin<kLong>(), "well-formed-rays", "has length 1.00999"},
                  {plugin<kNoNumber>(), "well-formed-rays", "begins at (nan"},
                  {plugin<kNegative>(), "well-formed-rays", "the weight is -0."},
                  {plugin<kAlwaysDifferential>(), "well-formed-rays", "nobody asked for"},
                  {plugin<kFarNeighbours>(), "differentials-are-neighbours", "the neighbour in x"},
                  {plugin<kStays>(), "moves-with-its-space", "toRender takes the ray"},
                  {plugin<kSecretLens>(), "lens-is-used", "usesLens() is false"},
                  {plugin<kNoShutter>(), "shutter-gives-the-time", "not 3"},
                  {plugin<kUpsideDown>(), "matrix", "screenFromCamera() puts"},
                  {plugin<kBackwards>(), "matrix", "backwards"},
                  {plugin<kBlurred>(), "lens-focuses", "crosses the focal plane"},
                  {plugin<kBlurred>(), "extreme-lenses-focus", "the focus is along"},
                  {plugin<kNoClip>(), "clips-by-depth", "to inf"},
                  {plugin<kNoWindow>(), "screen-window", "screenwindow -0.5 2 0.25 1"},
                  {&own<Camera, Careless>(), "refuses-nonsense", "lensradius -1 is not refused"},
                  {plugin<kCountsCalls>(), "repeatable", "asked again"},
                  {plugin<kCountsObjects>(), "twins", "another object"},
                  {plugin<kCountsCalls>(), "thread-safe", "other threads"},
                  {plugin<kAllocates>(), "allocates-nothing", "operator new"},
              });
}

}  // namespace
}  // namespace pbrt::test
