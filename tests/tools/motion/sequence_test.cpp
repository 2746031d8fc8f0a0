// Sequences of files: what is read, which velocities, and what is refused.

#include "tools/particles/motion/sequence.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "tests/command.h"
#include "tests/shapes/metaballs/particle_files.h"
#include "tools/particles/motion/match.h"

namespace pbrt::motion {
namespace {

using testing::HasSubstr;

// A grid of spacing 0.1, moved.
std::vector<Point3> grid(int count, const Vec3& by = Vec3(0)) {
  std::vector<Point3> points;
  for (int i = 0; i < count; ++i) points.push_back(0.1F * Vec3(i % 5, i / 5 % 5, i / 25) + by);
  return points;
}

std::string xyz(const std::vector<Point3>& points) {
  std::string text = "x y z\n";
  for (const Point3& p : points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  return text;
}

class Sequences : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
  }
  std::unique_ptr<Motion> open(const std::string& name, const SequenceSettings& settings = {}) {
    return openSequence((folder_.path() / name).string(), settings);
  }
  // The velocities of one frame.
  std::vector<Vec3> velocities(Motion& motion, int number) {
    Fluid fluid;
    motion.frame(number, fluid);
    EXPECT_EQ(fluid.atoms.size(), fluid.velocities.size());
    return fluid.velocities;
  }
  template <class Do>
  std::string refusal(Do&& what) {
    try {
      what();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  test::Folder folder_;
};

TEST_F(Sequences, AreTheFilesThatFitThePattern) {
  for (const char* name :
       {"f0008.xyz", "f0009.xyz", "f0010.xyz", "f12345.xyz", "f007.xyz", "f00011.xyz", "f0013.ply",
        "g0014.xyz", "f-015.xyz", "f001x.xyz", "f99999999999.xyz"})
    write(name, xyz(grid(30)));
  const auto motion = open("f####.xyz");
  EXPECT_EQ(motion->first(), 8);
  EXPECT_EQ(motion->last(), 12345);
  EXPECT_EQ(motion->dt(), 1. / 24);
  EXPECT_THAT(refusal([&] { velocities(*motion, 11); }),
              testing::AllOf(HasSubstr("f0011.xyz is missing"), HasSubstr("f0010.xyz"),
                             HasSubstr("f12345.xyz")));
  EXPECT_THAT(refusal([&] { velocities(*motion, 1); }), HasSubstr("there is"));
}

TEST_F(Sequences, RefusePatternsThatNameNoSequence) {
  write("f1.xyz", xyz(grid(30)));
  EXPECT_THAT(refusal([&] { open("f1.xyz"); }), HasSubstr("one run of #"));
  EXPECT_THAT(refusal([&] { open("f#a#.xyz"); }), HasSubstr("one run of #"));
  EXPECT_THAT(refusal([&] { open("h#.xyz"); }), HasSubstr("there is no file"));
  EXPECT_THAT(refusal([&] { open("none/f#.xyz"); }), HasSubstr("none"));
  EXPECT_THAT(refusal([&] { open("f#.xyz", {.fps = 0}); }), HasSubstr("frames a second"));
  EXPECT_THAT(refusal([&] { open("f#.xyz", {.radius = -1.F}); }), HasSubstr("radius is -1"));
  EXPECT_THAT(refusal([&] { open("f#.xyz", {.threshold = 0.F}); }), HasSubstr("threshold is 0"));
}

TEST_F(Sequences, TakeWhatEveryFormatSays) {
  Particles p;
  p.positions = grid(30);
  for (int i = 0; i < 30; ++i) {
    p.radii.push_back(0.05F + 0.001F * static_cast<float>(i));
    p.colors.push_back(Spectrum(0.2F));
    p.velocities.push_back(Vec3(i, -i, 0.5F));
    p.strengths.push_back(1 + 0.1F * static_cast<float>(i));
  }
  const std::vector<std::pair<std::string, std::string>> files{{"ply", test::plyText(p)},
                                                               {"vtk", test::vtk(p, true)},
                                                               {"csv", test::csv(p)},
                                                               {"bgeo", test::bgeo(p)}};
  for (const auto& [suffix, bytes] : files) {
    write("f1." + suffix, bytes);
    const auto motion = open("f#." + suffix);
    Fluid fluid;
    motion->frame(1, fluid);
    ASSERT_EQ(fluid.atoms.size(), 30U) << suffix;
    // The default threshold is over the cube of the largest support.
    const double largest = 4 * 0.079F, threshold = 0.5 / (largest * largest * largest);
    for (std::size_t i = 0; i < 30; ++i) {
      EXPECT_NEAR(fluid.atoms[i].radius, 4 * p.radii[i], 1e-6) << suffix;
      EXPECT_EQ(fluid.velocities[i], p.velocities[i]) << suffix;
      const double weight = p.strengths[i] *
                            metaballs::scale(metaballs::Kernel::poly6, fluid.atoms[i].radius) /
                            threshold;
      EXPECT_NEAR(fluid.atoms[i].weight / weight, 1, 1e-5) << suffix;
    }
  }
}

TEST_F(Sequences, VelocitiesAreCentralDifferences) {
  const auto path = [](double t) { return Vec3(0.02 * t * t, -0.01 * t, 0.003); };
  for (int k = 1; k <= 4; ++k) write(fmt::format("f{}.xyz", k), xyz(grid(60, path(k))));
  const auto motion = open("f#.xyz", {.fps = 10});
  // Exact for a parabola, but at the ends.
  for (const int k : {2, 3})
    for (const Vec3& v : velocities(*motion, k))
      EXPECT_LT(glm::length(v - Vec3(0.4 * k, -0.1, 0)), 1e-4);
  for (const Vec3& v : velocities(*motion, 1)) EXPECT_LT(glm::length(v - Vec3(0.6, -0.1, 0)), 1e-4);
  for (const Vec3& v : velocities(*motion, 4)) EXPECT_LT(glm::length(v - Vec3(1.4, -0.1, 0)), 1e-4);
}

TEST_F(Sequences, ALoneFrameIsAtRest) {
  write("f7.xyz", xyz(grid(30)));
  const auto motion = open("f#.xyz");
  EXPECT_EQ(motion->first(), motion->last());
  for (const Vec3& v : velocities(*motion, 7)) EXPECT_EQ(v, Vec3(0));
}

TEST_F(Sequences, AnEmitterAddsParticlesAtTheEnd) {
  for (int k = 1; k <= 3; ++k)
    write(fmt::format("f{}.xyz", k),
          xyz(grid(40 + 10 * k, Vec3(0.3F * static_cast<float>(k), 0, 0))));
  const auto motion = open("f#.xyz", {.fps = 1});
  const std::vector<Vec3> middle = velocities(*motion, 2);
  ASSERT_EQ(middle.size(), 60U);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_LT(glm::length(middle[i] - Vec3(0.3, 0, 0)), 1e-5);
  // Those of the first frame know only what follows, the new ones of the second, too.
  for (std::size_t i = 50; i < 60; ++i) EXPECT_NEAR(middle[i].x, 0.3, 0.31) << i;
}

TEST_F(Sequences, RadiiAndThresholdAreOfTheWhole) {
  write("f1.xyz", xyz({Point3(0), Point3(9, 0, 0)}));  // an emitter's first two
  write("f2.xyz", xyz(grid(100)));
  const auto motion = open("f#.xyz");
  Fluid one, two;
  motion->frame(1, one);
  motion->frame(2, two);
  EXPECT_NEAR(one.atoms[0].radius, 0.2, 1e-6);
  EXPECT_EQ(one.atoms[0].radius, two.atoms[0].radius);
  EXPECT_EQ(one.atoms[0].weight, two.atoms[0].weight);
  const Bounds3 bounds = motion->bounds();
  for (const Fluid& fluid : {one, two})
    for (const metaballs::Atom& atom : fluid.atoms) {
      EXPECT_TRUE(bounds.contains(atom.centre + 0.5F * atom.radius));
      EXPECT_TRUE(bounds.contains(atom.centre - 0.5F * atom.radius));
    }
}

TEST_F(Sequences, FaultsNameTheFileAndTheAtom) {
  write("f1.xyz", xyz(grid(30)));
  write("f2.xyz", "x y z\n1 2\n");
  EXPECT_THAT(refusal([&] { open("f#.xyz"); }), HasSubstr("f2.xyz"));
  write("f2.xyz", "x y z pscale\n1 2 3 0.5\n1 2 3 0\n");
  EXPECT_THAT(refusal([&] {
                const auto motion = open("f#.xyz");
                velocities(*motion, 1);
                velocities(*motion, 2);
              }),
              testing::AllOf(HasSubstr("f2.xyz"), HasSubstr("atom 1")));
  write("g1.xyz", xyz({Point3(1)}));
  EXPECT_THAT(refusal([&] { velocities(*open("g#.xyz"), 1); }), HasSubstr("give a radius"));
  EXPECT_EQ(velocities(*open("g#.xyz", {.radius = 1.F}), 1).size(), 1U);
}

TEST(Shifts, FollowTheOrderHoweverFast) {
  const auto from = grid(100), to = grid(100, Vec3(5, 0, 0));
  for (const auto& shift : shifts(from, to, true, 8, 0.05F)) {
    ASSERT_TRUE(shift);
    EXPECT_NEAR(shift->x, 5, 1e-5);
  }
}

TEST(Shifts, FindTheNearestWhereTheOrderIsLost) {
  const auto from = grid(100);
  std::vector<Point3> to;
  for (std::size_t i = 0; i < 100; ++i) to.push_back(from[(i * 37 + 11) % 100] + Vec3(0, 0.02F, 0));
  for (const auto& shift : shifts(from, to, true, 8, 0.05F)) {
    ASSERT_TRUE(shift);
    EXPECT_LT(glm::length(*shift - Vec3(0, 0.02F, 0)), 1e-6);
  }
}

TEST(Shifts, KnowWhatTheyCannotTell) {
  const auto from = grid(100);
  auto to = from;
  to.resize(60);
  const auto known = shifts(from, to, true, 8, 0.05F);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(known[i].has_value(), i < 60);
  // One that is born again elsewhere.
  auto jumped = from;
  jumped[3] += Vec3(20, 0, 0);
  EXPECT_FALSE(shifts(from, from, true, 8, 0.05F)[3] != Vec3(0));
  auto spread = from;
  for (Point3& p : spread) p *= 100.F;
  auto moved = spread;
  moved[3] += Vec3(20, 0, 0);
  EXPECT_FALSE(shifts(spread, moved, true, 8, 0.05F)[3]);
  EXPECT_TRUE(shifts(spread, moved, true, 8, 0.05F)[4]);
}

}  // namespace
}  // namespace pbrt::motion
