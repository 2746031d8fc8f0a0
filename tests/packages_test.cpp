// The packages that `./dev package` makes: what is in them runs from wherever it is unpacked.

#include <gmock/gmock.h>

#include "tests/command.h"

namespace pbrt {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// The picture of a sphere, as this pbrt renders it.
std::string picture(const test::Folder& folder, const std::string& program) {
  folder.write("scene.pbrt",
               "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nLookAt 0 -5 "
               "0  0 0 0  0 0 1\nCamera \"perspective\"\nWorldBegin\nLightSource \"point\" "
               "\"point from\" [3 -5 3]\nShape \"sphere\"\n");
  const test::Outcome outcome = folder.command("env -u PBRT_PLUGIN_PATH " + program +
                                               " --quiet scene.pbrt --outfile picture.png");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return test::contents(folder.path() / "picture.png");
}

TEST(Packages, HoldWhatRendersAndWhatPluginsAreBuiltWith) {
  const test::Folder folder;
  if (folder.command("dpkg-shlibdeps --version").code != 0) GTEST_SKIP() << "needs dpkg-dev";
  const test::Outcome made =
      folder.command("cpack --config " PBRT_BUILD_DIR "/CPackConfig.cmake -B packages");
  ASSERT_EQ(made.code, 0) << made.out << made.err;
  const auto ask = [&](const std::string& command) {
    const test::Outcome outcome = folder.command(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  };

  EXPECT_THAT(ask("dpkg-deb -I packages/pbrt_*.deb"),
              AllOf(HasSubstr("libembree"), HasSubstr("libopenexr"), HasSubstr("libtbb"),
                    HasSubstr("libpng"), HasSubstr("libjpeg")));
  EXPECT_THAT(ask("dpkg-deb -I packages/pbrt-dev_*.deb"),
              AllOf(HasSubstr("pbrt (= "), HasSubstr("libglm-dev"), HasSubstr("libfmt-dev")));
  EXPECT_THAT(ask("dpkg-deb -c packages/pbrt_*.deb"),
              AllOf(HasSubstr("/bin/pbrt-plugin\n"), HasSubstr("/pbrt/shapes/sphere.so\n"),
                    Not(HasSubstr(".h\n"))));
  EXPECT_THAT(ask("dpkg-deb -c packages/pbrt-dev_*.deb"),
              AllOf(HasSubstr("/include/pbrt/core/api/shape.h\n"),
                    HasSubstr("/cmake/pbrt/pbrtConfig.cmake\n"), Not(HasSubstr("core/scene"))));

  const std::string here = picture(folder, test::Folder::program());
  ask("dpkg-deb -x packages/pbrt_*.deb deb");
  EXPECT_EQ(picture(folder, "deb/usr/bin/pbrt"), here);
  ask("tar xzf packages/pbrt-*.tar.gz");
  EXPECT_EQ(picture(folder, "pbrt-*/bin/pbrt"), here);
}

}  // namespace
}  // namespace pbrt
