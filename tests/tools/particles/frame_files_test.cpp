#include "tools/particles/frame_files.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "shapes/metaballs/particles/particles.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

using testing::HasSubstr;

class Files : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return (folder.path() / name).string(); }
  // How the pattern is refused; empty if it is not.
  std::string refusal(const std::string& pattern, Failure failure, int last = 9) const {
    try {
      FrameFiles(pattern, 1, last);
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), failure) << error.what();
      return error.what();
    }
    return "";
  }

  Folder folder;
};

TEST_F(Files, AreNumbered) {
  const FrameFiles four(at("a####b.png"), 1, 3);
  EXPECT_EQ(four.file(7), at("a0007b.png"));
  EXPECT_EQ(four.file(12345), at("a12345b.png"));
  EXPECT_FALSE(four.ofSurfels() || four.ofChannels());
  const FrameFiles one(at("#.EXR"), 1, 3);
  EXPECT_EQ(one.file(12), at("12.EXR"));
  EXPECT_TRUE(one.ofChannels());
  const FrameFiles alone(at("still.ply"), 5, 5);
  EXPECT_EQ(alone.file(5), at("still.ply"));
  EXPECT_TRUE(alone.ofSurfels());
  EXPECT_EQ(folder.files(), 0U) << "asking leaves nothing behind";
}

TEST_F(Files, AreRefusedBeforeTheWork) {
  EXPECT_THAT(refusal(at("a.png"), Failure::usage), HasSubstr("frames/####.png"));
  EXPECT_THAT(refusal(at("a##b##.png"), Failure::usage), HasSubstr("one run of #"));
  EXPECT_THAT(refusal(at("a##/b.png"), Failure::usage), HasSubstr("one run of #"));
  EXPECT_THAT(refusal(at("##.jpg"), Failure::usage), HasSubstr(".ply"));
  EXPECT_THAT(refusal(at("##"), Failure::usage), HasSubstr(".ply"));
  for (const char* name : {"nowhere/##.png", "nowhere/##.ply", "nowhere/##.exr"})
    EXPECT_THAT(refusal(at(name), Failure::io), HasSubstr("nowhere/01"));
}

TEST_F(Files, OfSurfelsCanBeReadAsParticles) {
  std::vector<surfels::Surfel> surfels(3);
  for (int i = 0; i < 3; ++i) {
    surfels[i].p = {i + 0.5, -i, 1e6 * i};
    surfels[i].n = {0, 0.6F, -0.8F};
    surfels[i].radius = 0.25F * static_cast<float>(i + 1);
    surfels[i].density = static_cast<float>(i);
  }
  writePly(at("s.ply"), surfels);
  const Particles particles = readParticles(at("s.ply"));
  ASSERT_EQ(particles.positions.size(), 3U);
  ASSERT_EQ(particles.radii.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(particles.positions[i], Point3(surfels[i].p));
    EXPECT_EQ(particles.radii[i], surfels[i].radius);
  }
  const std::string bytes = contents(at("s.ply"));
  const std::size_t header = bytes.find("end_header\n") + 11;
  ASSERT_EQ(bytes.size(), header + std::size_t{3} * 8 * 4);
  EXPECT_EQ(bytes.substr(header + 12, 12),
            std::string("\0\0\0\0\x9a\x99\x19\x3f\xcd\xcc\x4c\xbf", 12))
      << "the normal, little-endian";
}

TEST_F(Files, OfNoSurfelsAreFiles) {
  writePly(at("none.ply"), {});
  EXPECT_TRUE(contents(at("none.ply"))
                  .ends_with("element vertex 0\nproperty float x\nproperty float y\n"
                             "property float z\nproperty float nx\nproperty float ny\n"
                             "property float nz\nproperty float radius\n"
                             "property float density\nend_header\n"));
}

}  // namespace
}  // namespace pbrt::test
