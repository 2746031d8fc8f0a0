// Everything that goes wrong at the command: one clear line with its place, the documented exit
// code, no crash, no file left behind.

#include <sys/mount.h>
#include <unistd.h>

#include <regex>

#include "tests/command.h"

namespace pbrt::test {
namespace {

// A whole scene about one statement.
std::string world(const std::string& statements, const std::string& options = "") {
  return "LookAt 0 0 5  0 0 0  0 1 0\n"
         "Camera \"perspective\" \"float fov\" 40\n"
         "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 "
         "\"string filename\" \"out.exr\"\n" +
         options +
         "\nIntegrator \"whitted\"\nSampler \"random\" \"integer pixelsamples\" 1\n"
         "WorldBegin\nLightSource \"point\" \"point from\" [0 0 5]\n" +
         statements + "\nWorldEnd\n";
}

const std::string kSphere = "Shape \"sphere\"";

struct Case {
  std::string name;
  std::string scene;  // contents of scene.pbrt
  int code;
  std::string message;  // regular expression, searched for in standard error
  std::string arguments = "scene.pbrt";
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, IsOneClearLineAndTheRightExitCode) {
  const Case& c = GetParam();
  const Folder folder;
  folder.write("scene.pbrt", c.scene);
  folder.write("self.pbrt", "Include \"self.pbrt\"\n");
  const Outcome quiet = folder.pbrt(c.arguments + " --quiet");
  const Outcome outcome = folder.pbrt(c.arguments);
  EXPECT_EQ(outcome.code, c.code) << outcome.err;
  EXPECT_TRUE(std::regex_search(outcome.err, std::regex(c.message)))
      << "not found: " << c.message << "\nin: " << outcome.err;
  EXPECT_LT(outcome.err.size(), 2000U) << "too long to read";
  if (c.code != 0) {
    EXPECT_TRUE(outcome.err.ends_with(quiet.err)) << "--quiet must hide no error: " << quiet.err;
    EXPECT_NE(quiet.err, "");
    EXPECT_EQ(outcome.out, "") << "errors and results share no stream";
    EXPECT_EQ(folder.files(), 2U) << "a failed render must leave nothing behind";
  } else {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out.exr"));
    EXPECT_EQ(quiet.err, "");
  }
}

const Case kCases[] = {
    {"UnclosedString", "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\n", 3,
     "scene.pbrt:2:8: error: .*string"},
    {"UnknownShape", world("Shape \"spere\""), 3,
     "scene.pbrt:9:\\d+: error: there is no shape \"spere\"; did you mean \"sphere\"\\?"},
    {"NanParameter", world("Shape \"sphere\" \"float radius\" [nan]"), 3,
     "scene.pbrt:9:\\d+: error:"},
    {"HugeRadius", world("Shape \"sphere\" \"float radius\" [1e999]"), 3,
     "scene.pbrt:9:32: error: .*1e999.*range"},
    {"NegativeRadius", world("Shape \"sphere\" \"float radius\" [-1]"), 3,
     "scene.pbrt:9:\\d+: error: shapes/sphere: \"radius\" must be above 0, not -1"},
    {"MissingInclude", world("Include \"nowhere.pbrt\""), 3,
     "scene.pbrt:9:\\d+: error: .*nowhere.pbrt"},
    {"IncludeOfItself", "", 3, "self.pbrt:1:\\d+: error: .*includes itself", "self.pbrt"},
    {"EmptyFile", "", 3, "error: there is no WorldBegin"},
    {"RandomBytes", std::string("\x7f\x45\x4c\x46\0\x01\xff\xfe\x80 \"\x00\x01[", 15), 3,
     "scene.pbrt:1:1: error:"},
    {"IndexTooLarge",
     world("Shape \"trianglemesh\" \"integer indices\" [0 1 3] \"point P\" [0 0 0 1 0 0 0 1 0]"), 3,
     "scene.pbrt:9:\\d+: error: shapes/trianglemesh: .*indices.*3"},
    {"NegativeIndex",
     world("Shape \"trianglemesh\" \"integer indices\" [0 1 -1] \"point P\" [0 0 0 1 0 0 0 1 0]"),
     3, "scene.pbrt:9:\\d+: error: shapes/trianglemesh: .*indices.*-1"},
    {"LookAtAlongUp", "LookAt 0 0 5  0 0 0  0 0 1\nWorldBegin\nWorldEnd\n", 3,
     "scene.pbrt:1:1: error: LookAt: the up vector"},
    {"LookAtNowhere", "LookAt 0 0 5  0 0 5  0 1 0\nWorldBegin\nWorldEnd\n", 3,
     "scene.pbrt:1:1: error: LookAt"},
    {"LongString", world("Shape \"" + std::string(100000, 'x') + "\""), 3,
     "scene.pbrt:9:\\d+: error: "},
    {"ResolutionZero", "Film \"image\" \"integer xresolution\" 0\nWorldBegin\nWorldEnd\n", 3,
     "scene.pbrt:1:36: error: film/image: \"xresolution\" must be from 1"},
    {"ResolutionNegative", "Film \"image\" \"integer yresolution\" [-5]\nWorldBegin\nWorldEnd\n", 3,
     "scene.pbrt:1:\\d+: error: film/image: \"yresolution\" must be from 1"},
    {"NoWorldEnd", world(kSphere).substr(0, world(kSphere).find("WorldEnd")), 0,
     "warning: the file ends without WorldEnd"},
    {"AttributeEndTooMany", world(kSphere + "\nAttributeEnd"), 3,
     "scene.pbrt:10:1: error: AttributeEnd without"},
    {"TransformEndForAttribute", world("AttributeBegin\nTransformEnd"), 3,
     "scene.pbrt:10:1: error: TransformEnd without"},
    {"AttributeBeginUnclosed", world("AttributeBegin\n" + kSphere), 0,
     "scene.pbrt:9:1: warning: AttributeBegin is never closed"},
    {"NoSuchFile", "", 4, "error: .*nowhere.pbrt", "nowhere.pbrt"},
    {"FolderAsScene", "", 4, "error: ", "."},
    {"TypoInParameter", world("Shape \"sphere\" \"float raduis\" [2]"), 3,
     "scene.pbrt:9:\\d+: error: shapes/sphere: \"raduis\" is not a parameter of it; did you mean "
     "\"radius\"\\?\n.*Shape \"sphere\" \"float raduis\" \\[2\\]\n[^]*\\^"},
    {"TwoTypos", world("Shape \"sphere\" \"float raduis\" [2] \"float zmni\" [1]"), 3,
     "\"raduis\"[^]*\"zmni\""},
    {"TypoInMaterial", world("Material \"matte\" \"rgb Kdd\" [1 1 1]\n" + kSphere), 3,
     "scene.pbrt:9:\\d+: error: materials/matte: \"Kdd\" is not .*\"Kd\""},
    {"TypoInTexture",
     world("Texture \"t\" \"color\" \"checkerboard\" \"float uscael\" [1]\n"
           "Material \"matte\" \"texture Kd\" \"t\"\n" +
           kSphere),
     3, "textures/checkerboard: \"uscael\" is not .*\"uscale\""},
    {"TypoInDirective", world("Shpae \"sphere\""), 3,
     "scene.pbrt:9:1: error: unknown directive; did you mean .*Shape"},
    {"WrongType", world("Shape \"sphere\" \"string radius\" \"big\""), 3,
     "scene.pbrt:9:\\d+: error: shapes/sphere: \"radius\" has type \"string\""},
    {"WrongCount", world("Shape \"sphere\" \"float radius\" [1 2]"), 3,
     "\"radius\" needs 1 number, not 2"},
    {"NoSuchTexture", world("Material \"matte\" \"texture Kd\" \"wood\"\n" + kSphere), 3,
     "scene.pbrt:9:\\d+: error: .*texture \"wood\""},
    {"NoSuchMaterial", world("NamedMaterial \"wood\""), 3,
     "scene.pbrt:9:\\d+: error: there is no named material \"wood\""},
    {"NoSuchObject", world("ObjectInstance \"tree\""), 3,
     "scene.pbrt:9:\\d+: error: there is no object \"tree\""},
    {"NoSuchCoordinateSystem", world("CoordSysTransform \"camra\""), 3, "did you mean \"camera\""},
    {"PathAsName", world("Shape \"../shapes/sphere\""), 3, "there is no shape"},
    {"ScaleByZero", world("Scale 0 1 1\n" + kSphere), 3,
     "scene.pbrt:9:1: error: Scale gives a transform that cannot be undone"},
    {"ShapeBeforeWorld", "Shape \"sphere\"\nWorldBegin\nWorldEnd\n", 3,
     "scene.pbrt:1:1: error: Shape belongs after WorldBegin"},
    {"CameraInWorld", world("Camera \"perspective\""), 3,
     "scene.pbrt:9:1: error: Camera belongs before WorldBegin"},
    {"SecondWorld", world(kSphere) + "WorldBegin\nWorldEnd\n", 3, "one scene makes one picture"},
    {"NoCamera",
     "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string filename\" "
     "\"out.exr\"\nWorldBegin\n" +
         kSphere + "\nWorldEnd\n",
     0, "warning: the scene has no Camera"},
    {"NoShape", world(""), 0, "warning: the scene has no shapes"},
    {"Media", world("Volume \"homogeneous\""), 0, "warning: participating media"},
    {"EmptyCrop", world(kSphere), 3, "holds no pixel", "--cropwindow 0.5,0.5,0,1 scene.pbrt"},
    {"UnknownOption", world(kSphere), 2, "--sp", "--sp 4 scene.pbrt"},
    {"ZeroSamples", world(kSphere), 2, "--spp", "--spp 0 scene.pbrt"},
    {"FolderAsOutput", world(kSphere), 4, "error: .*", "--outfile /tmp scene.pbrt"},
    {"UnknownImageFormat", world(kSphere), 4, "error: .*out.xyz", "--outfile out.xyz scene.pbrt"},
    {"MissingOutputFolder", world(kSphere), 4, "error: .*nowhere",
     "--outfile nowhere/a.exr "
     "scene.pbrt"},
    {"DescribeUnknownKind", "", 2, "did you mean \"shape\"", "--describe shaep sphere"},
    {"DescribeUnknownName", "", 3, "did you mean \"sphere\"", "--describe shape spher"},
};

INSTANTIATE_TEST_SUITE_P(Table, BadInput, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST(BadInput, ABillionSamplesStartAndCanBeStopped) {
  const Folder folder;
  folder.write("scene.pbrt", world(kSphere));
  const Outcome outcome =
      folder.command("timeout -s INT 2 " + Folder::program() + " --spp 1000000000 scene.pbrt");
  EXPECT_EQ(outcome.code, 124) << outcome.err;  // it was rendering when the time was over
  EXPECT_EQ(folder.files(), 1U) << "an interrupted render must leave nothing behind";
}

TEST(BadInput, StandardInputIsNamedInErrors) {
  const Folder folder;
  const Outcome outcome = folder.command("echo 'Shpae' | " + Folder::program() + " -");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("<stdin>:1:1: error"), std::string::npos) << outcome.err;
}

TEST(BadInput, AFullDiskLeavesTheOldPicture) {
  const Folder folder;
  const std::string disk = (folder.path() / "disk").string();
  std::filesystem::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "only root can make a small disk";
  folder.write("scene.pbrt", world(kSphere));
  folder.write("disk/out.exr", "the old picture");
  folder.command("dd if=/dev/zero of=disk/fill bs=1k count=1000");
  const Outcome outcome = folder.pbrt("--outfile disk/out.exr scene.pbrt");
  const std::string kept = contents(folder.path() / "disk/out.exr");
  const auto files = std::distance(std::filesystem::directory_iterator(disk), {});
  umount(disk.c_str());
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("out.exr"), std::string::npos) << outcome.err;
  EXPECT_EQ(kept, "the old picture");
  EXPECT_EQ(files, 2);
}

}  // namespace
}  // namespace pbrt::test
