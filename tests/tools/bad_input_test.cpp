// Everything that goes wrong at the command: one clear line with its place, the documented exit
// code, no crash, no file left behind.

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

// Textures that ask the one before twice each: 2^n times the first.
std::string doubled(int n) {
  std::string text = "Texture \"t0\" \"float\" \"constant\"\n";
  for (int i = 1; i <= n; ++i)
    text += "Texture \"t" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex1\" \"t" +
            std::to_string(i - 1) + "\" \"texture tex2\" \"t" + std::to_string(i - 1) + "\"\n";
  return text + "Material \"matte\" \"texture sigma\" \"t" + std::to_string(n) + "\"\n";
}

// So many statements, each with a default of its own.
std::string defaults(int n) {
  std::string text;
  for (int i = 0; i < n; ++i)
    text += "Attribute \"shape\" \"float x" + std::to_string(i) + "\" 1\n";
  return text;
}

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
    {"MediaUnseen",
     world("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\""), 0,
     "scene.pbrt:9:\\d+: warning: this integrator sees no participating media"},
    {"VolumeEverywhere", world("Volume \"homogeneous\""), 3,
     "scene.pbrt:9:1: error: a Volume needs"},
    {"ColorSpaceMistyped", world("ColorSpace \"srbg\""), 3,
     "scene.pbrt:9:12: error: there is no color space \"srbg\" .*did you mean \"srgb\""},
    {"AttributeOfNothing", world("Attribute \"shap\" \"float radius\" 1"), 3,
     "scene.pbrt:9:11: error: Attribute sets defaults of .*did you mean \"shape\""},
    {"DefaultThatNobodyReads", world("Attribute \"shape\" \"string radius\" \"big\"\n" + kSphere),
     3, "scene.pbrt:9:\\d+: error: shapes/sphere: \"radius\" has type \"string\""},
    {"TooManyDefaults", world(defaults(1001)), 3,
     "scene.pbrt:1009:19: error: there are defaults of 1000 parameters already"},
    {"OptionMistyped", world(kSphere, "Option \"integer sead\" 1"), 3,
     "scene.pbrt:4:8: error: Option: \"sead\" is not .*did you mean \"seed\""},
    {"OptionOfAnotherType", world(kSphere, "Option \"seed\" \"one\""), 3,
     "scene.pbrt:4:15: error: Option: \"seed\" has type \"string\""},
    {"OptionWithoutValue", world(kSphere, "Option \"seed\""), 3,
     "scene.pbrt:4:8: error: expected the value"},
    {"OptionInWorld", world("Option \"seed\" 1"), 3,
     "scene.pbrt:9:1: error: Option belongs before WorldBegin"},
    {"TruthForANumber", world("Shape \"sphere\" \"float radius\" true"), 3,
     "scene.pbrt:9:31: error: expected numbers"},
    {"TruthMistyped", world("Shape \"sphere\" \"bool a\" ture"), 3,
     "scene.pbrt:9:25: error: .*did you mean \"true\""},
    {"NamedMaterialWithoutType", world("MakeNamedMaterial \"a\" \"rgb reflectance\" [1 1 1]"), 3,
     "scene.pbrt:9:1: error: MakeNamedMaterial needs a parameter \"string type\""},
    {"TransformOfNoTime", world("ActiveTransform Endtime"), 3,
     "scene.pbrt:9:17: error: .*did you mean \"EndTime\""},
    {"TimesInReverse", world(kSphere, "TransformTimes 1 0"), 3,
     "scene.pbrt:4:1: error: TransformTimes"},
    {"MissingImport", world("Import \"nowhere.pbrt\""), 3, "scene.pbrt:9:8: error: .*nowhere.pbrt"},
    {"FilmMistyped", "Film \"rbg\"\nWorldBegin\n", 3,
     "scene.pbrt:1:6: error: there is no film \"rbg\" .*did you mean \"rgb\""},
    {"MaterialNotHereYet", world("Material \"hair\"\n" + kSphere), 3,
     "scene.pbrt:9:1: error: \"hair\" is a material of pbrt-v3 and v4 that is not here yet"},
    {"ParameterByItsOldName", world("Material \"diffuse\" \"rgb reflectence\" [1 1 1]\n" + kSphere),
     3, "\"reflectence\" is not .*did you mean \"reflectance\""},
    {"MissingMesh", world("Shape \"plymesh\" \"string filename\" \"a.ply\""), 3,
     "scene.pbrt:9:35: error: shapes/plymesh: \"filename\" names a file that is not there: a.ply"},
    {"MissingPicture",
     world("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\"\n"
           "Material \"diffuse\" \"texture reflectance\" \"t\"\n" +
           kSphere),
     3, "scene.pbrt:9:53: error: textures/imagemap: .*not there: wood.png"},
    {"MissingSpectrum", world("LightSource \"point\" \"spectrum I\" \"lamp.spd\""), 3,
     "scene.pbrt:9:34: error: lights/point: .*neither a file \\(lamp.spd\\) nor one of the named"},
    {"FolderAsMesh", world("Shape \"plymesh\" \"string filename\" \"/tmp\""), 3,
     "scene.pbrt:9:35: error: shapes/plymesh: .*which is not a file"},
    {"DeviceAsMesh", world("Shape \"plymesh\" \"string filename\" \"/dev/zero\""), 3,
     "scene.pbrt:9:35: error: shapes/plymesh: .*which is not a file"},
    {"LongFileName",
     world("Shape \"plymesh\" \"string filename\" \"" + std::string(5000, 'x') + "\""), 3,
     "scene.pbrt:9:35: error: shapes/plymesh: .*not there: x+\\.\\.\\."},
    {"LongObjectName", world("ObjectInstance \"" + std::string(5000, 'x') + "\""), 3,
     "scene.pbrt:9:16: error: there is no object \"x+\\.\\.\\.\""},
    {"TexturesThatDouble", world(doubled(40) + kSphere), 3,
     "scene.pbrt:22:1: error: to look this texture up takes more than 10000 lookups"},
    {"EmptyCrop", world(kSphere), 3, "holds no pixel", "--cropwindow 0.5,0.5,0,1 scene.pbrt"},
    {"UnknownOption", world(kSphere), 2, "--sp", "--sp 4 scene.pbrt"},
    {"ZeroSamples", world(kSphere), 2, "--spp", "--spp 0 scene.pbrt"},
    {"FolderAsOutput", world(kSphere), 4, "error: .*", "--outfile /tmp scene.pbrt"},
    {"UnknownImageFormat", world(kSphere), 4, "error: .*out.xyz", "--outfile out.xyz scene.pbrt"},
    {"SceneFileAsOutput",
     "Film \"image\" \"string filename\" \"scene.pbrt\"\nWorldBegin\n" + kSphere, 4,
     "error: cannot write scene.pbrt: its name must end in .exr or .png"},
    {"MissingOutputFolder", world(kSphere), 4, "error: .*nowhere",
     "--outfile nowhere/a.exr "
     "scene.pbrt"},
    {"DescribeUnknownKind", "", 2, "did you mean \"shape\"", "--describe shaep sphere"},
    {"DescribeUnknownName", "", 3, "did you mean \"sphere\"", "--describe shape spher"},
    {"DescribeWithoutName", "", 2, "--describe takes KIND NAME, or all", "--describe shape"},
    {"DescribeAllAndMore", "", 2, "--describe takes KIND NAME, or all", "--describe all sphere"},
    {"NoSuchDialect", world(kSphere), 2, "--dialect.*v5", "--dialect v5 scene.pbrt"},
    {"CheckAndFormat", world(kSphere), 2, "--check", "--check --format scene.pbrt"},
    {"CheckOfNoFile", "", 4, "error: .*nowhere.pbrt", "--check nowhere.pbrt"},
    {"CheckOfBadSyntax", world("Shape"), 3, "scene.pbrt:9:1: error: expected a quoted name",
     "--check scene.pbrt"},
    {"PermissiveWithBadSyntax", world("Shape"), 3, "scene.pbrt:9:1: error: expected a quoted name",
     "--permissive scene.pbrt"},
    {"FormatOfBadSyntax", world("Shape"), 3, "scene.pbrt:9:1: error: expected a quoted name",
     "--format scene.pbrt"},
    {"FormatOfMissingInclude", world("Include \"nowhere.pbrt\""), 3,
     "scene.pbrt:9:9: error: ", "--format scene.pbrt"},
};

INSTANTIATE_TEST_SUITE_P(Table, BadInput, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST(BadInput, ABillionSamplesStartAndCanBeStopped) {
  const Folder folder;
  folder.write("scene.pbrt", world(kSphere));
  const Outcome outcome =
      folder.command("timeout -s INT 2 " + Folder::program() + " --spp 1000000000 scene.pbrt");
  EXPECT_EQ(outcome.code, 124) << outcome.err;  // it was rendering when the time was over
  EXPECT_EQ(folder.files(), 2U) << "the scene, and the picture so far";
}

TEST(BadInput, StandardInputIsNamedInErrors) {
  const Folder folder;
  const Outcome outcome = folder.command("echo 'Shpae' | " + Folder::program() + " -");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("<stdin>:1:1: error"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pbrt::test
