// Frames of an animation: what a scene's motion looks like from a later time on, against the whole
// motion and against scenes that are written for one moment.

#include <fmt/format.h>

#include <numbers>

#include "core/scene/scene.h"
#include "tests/scenes.h"

namespace pbrt::test {
namespace {

BuildOptions at(double time) {
  BuildOptions options;
  options.time = time;
  return options;
}

// Seen from (0, 0, 0) along +z, so that render space is world space. The shutter is open for a
// tenth of a second, the motion goes from 2 to 6.
std::unique_ptr<Scene> world(const std::string& statements, double time) {
  return buildText(
      "TransformTimes 2 6 Camera \"perspective\" \"float shutterclose\" 0.1\n"
      "Integrator \"whitted\" WorldBegin\n" +
          statements + "\nWorldEnd",
      at(time));
}

// How far above z = 0 a ray down the z axis at (x, y) meets something; NaN: it does not.
float height(const Scene& scene, double x, double y, float time) {
  const Hit hit = scene.intersect(Ray{{float(x), float(y), 100}, 0, {0, 0, -1}, kInfinity, time});
  return hit.found() ? 100 - hit.t : std::numeric_limits<float>::quiet_NaN();
}

// The top of the ball is where the whole motion has it, so long after the frame begins.
TEST(FrameTime, AShapeIsWhereTheWholeMotionHasIt) {
  for (const double time : {0.0, 1.95, 2.0, 3.0, 4.37, 5.95, 6.0, 100.0}) {
    const auto scene = world("ActiveTransform EndTime Translate 8 0 0 Shape \"sphere\"", time);
    for (const float since : {0.F, 0.025F, 0.05F, 0.1F}) {
      const double x = 8 * std::clamp((time + since - 2) / 4, 0.0, 1.0);
      EXPECT_NEAR(height(*scene, x, 0, since), 1, 1e-5) << time << ' ' << since;
      EXPECT_TRUE(std::isnan(height(*scene, x + 1.001, 0, since)));
      EXPECT_FALSE(std::isnan(height(*scene, x + 0.999, 0, since)));
    }
  }
}

TEST(FrameTime, NothingMovesBeforeAndAfter) {
  const std::string ball = "ActiveTransform EndTime Translate 8 0 0 Shape \"sphere\"";
  EXPECT_FALSE(world(ball, 1)->moves());
  EXPECT_TRUE(world(ball, 1.95)->moves());
  EXPECT_TRUE(world(ball, 5.95)->moves());
  EXPECT_FALSE(world(ball, 6)->moves());
}

// An instance turns by 170 degrees at even speed: the ball in it goes by a circle, not by chords
// from frame to frame.
TEST(FrameTime, TurnsGoAtEvenSpeed) {
  for (const double time : {2.0, 2.7, 4.0, 5.3, 5.9}) {
    const auto scene = world(
        "ObjectBegin \"o\" Translate 10 0 0 Shape \"sphere\" ObjectEnd\n"
        "ActiveTransform EndTime Rotate 170 0 0 1 ObjectInstance \"o\"",
        time);
    for (const float since : {0.F, 0.04F, 0.1F}) {
      const double a = 170 * (time + since - 2) / 4 * std::numbers::pi / 180;
      EXPECT_NEAR(height(*scene, 10 * std::cos(a), 10 * std::sin(a), since), 1, 1e-5) << time;
    }
  }
}

std::string picture(const std::string& camera, const std::string& light, const std::string& ball) {
  return camera + R"(
Camera "perspective" "float fov" 40 "float shutterclose" 0
Film "image" "integer xresolution" 32 "integer yresolution" 24
Sampler "halton" "integer pixelsamples" 4
Integrator "whitted"
WorldBegin
AttributeBegin )" +
         light + R"( LightSource "point" "rgb I" [30 30 30] AttributeEnd
Material "matte"
AttributeBegin )" +
         ball + R"( Shape "sphere" AttributeEnd
Shape "disk" "float radius" 9 "float height" -1
WorldEnd
)";
}

double difference(const Image& a, const Image& b) {
  const std::vector<float>&x = *a.channel("R"), &y = *b.channel("R");
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::abs(x[i] - y[i]);
  return sum / static_cast<double>(x.size());
}

// Camera, light and shape go by 4 units in 2 seconds: at 1.5 they are 3 units from their start.
TEST(FrameTime, CameraLightsAndShapesStandWhereAStillSceneHasThem) {
  const std::string look = "LookAt 0 -8 4  0 0 0  0 0 1", lamp = "Translate 0 -3 5";
  const std::string end = " ActiveTransform EndTime ", all = " ActiveTransform All ";
  const auto still = [](const std::string& c, const std::string& l, const std::string& b) {
    return renderText(picture(c, l, b));
  };
  const auto frame = [&](double t, const std::string& c, const std::string& l,
                         const std::string& b) {
    return renderText(picture("TransformTimes 0 2 " + c, l, b), 0, at(t));
  };
  // The camera goes by +x where the world goes by -x in its eyes.
  const std::string travel = look + end + "Translate -4 0 0" + all;
  const Image base = still(look, lamp, "");
  EXPECT_GT(mean(base, "R"), 0.02);
  const double none = 1e-6;
  struct Case {
    Image got, wanted;
  };
  for (const auto& [got, wanted] :
       {Case{frame(1.5, travel, lamp, ""), still(look + " Translate -3 0 0", lamp, "")},
        Case{frame(1.5, look, end + "Translate 4 0 0" + all + lamp, ""),
             still(look, "Translate 3 0 0 " + lamp, "")},
        Case{frame(1.5, look, lamp, end + "Translate 4 0 0" + all),
             still(look, lamp, "Translate 3 0 0")}}) {
    EXPECT_LT(difference(got, wanted), none);
    EXPECT_GT(difference(got, base), 1e-3) << "something moved";
  }
}

TEST(FrameTime, TheTimesAreKnownBeforeTheWorld) {
  EXPECT_THROW(buildText("Camera \"perspective\" Integrator \"whitted\" WorldBegin\n"
                         "TransformTimes 0 2 Shape \"sphere\" WorldEnd",
                         at(0)),
               Error);
}

}  // namespace
}  // namespace pbrt::test
