// What the command does with a scene beside rendering it whole: --check, --permissive, --format.

#include "tests/command.h"

namespace pbrt::test {
namespace {

// A scene of 8 x 8 pixels about some statements.
std::string world(const std::string& statements) {
  return "Camera \"perspective\"\nFilm \"image\" \"integer xresolution\" 8 "
         "\"integer yresolution\" 8 \"string filename\" \"out.exr\"\n"
         "Sampler \"random\" \"integer pixelsamples\" 1\nIntegrator \"path\"\nWorldBegin\n"
         "LightSource \"point\"\nTranslate 0 0 5\n" +
         statements + "\nWorldEnd\n";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The code of a command over a scene, which must not write anything.
Outcome run(const Folder& folder, const std::string& options, const std::string& scene) {
  folder.write("scene.pbrt", scene);
  return folder.pbrt(options + " scene.pbrt");
}

// Statements that each are wrong in their own way; the sphere is not.
const std::string kWrong =
    "Shape \"spere\"\n"
    "Shape \"sphere\" \"float raduis\" 1\n"
    "Shape \"sphere\" \"float radius\" -1\n"
    "NamedMaterial \"wood\"\n"
    "ObjectInstance \"tree\"\n"
    "AreaLightSource \"diffuse\" \"float L\" 1\n"
    "Shape \"sphere\"\n"
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0]\n"
    "AreaLightSource \"point\"\n"
    "Shape \"sphere\"\n"
    "Shape \"sphere\" \"float radius\" 0.5\n";
constexpr const char* kTold[] = {"\"spere\"", "\"raduis\"", "must be above 0", "\"wood\"",
                                 "\"tree\"",  "\"L\"",      "\"point\" light"};

TEST(Check, TellsAllThatIsWrongAndWritesNothing) {
  const Folder folder;
  const Outcome outcome = run(folder, "--check", world(kWrong));
  EXPECT_EQ(outcome.code, 3);
  for (const char* told : kTold) EXPECT_TRUE(has(outcome.err, told)) << told << outcome.err;
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Check, OfAGoodSceneSaysWhatItIs) {
  const Folder folder;
  const Outcome outcome = run(folder, "--check", world("Shape \"sphere\""));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "scene.pbrt: pbrt-v3 (Integrator \"path\" tells); 1 shapes"))
      << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(folder.files(), 1U);
}

// What stands before the world is wrong in many ways at once, too.
TEST(Check, TellsAllThatIsWrongWithTheCamera) {
  const Folder folder;
  const Outcome outcome =
      run(folder, "--check",
          "Film \"rbg\" \"integer xresolution\" 0\nSampler \"raandom\"\nCamera \"perspective\" "
          "\"float fov\" -1\nIntegrator \"pat\"\nPixelFilter \"bx\"\nWorldBegin\n");
  EXPECT_EQ(outcome.code, 3);
  for (const char* told : {"xresolution", "raandom", "fov", "pat", "bx"})
    EXPECT_TRUE(has(outcome.err, told)) << told << outcome.err;
}

TEST(Permissive, RendersTheRestAndCounts) {
  const Folder folder;
  const Outcome outcome = run(folder, "--permissive", world(kWrong));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* told : kTold) EXPECT_TRUE(has(outcome.err, told)) << told << outcome.err;
  EXPECT_TRUE(has(outcome.err, "9 errors passed over")) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out.exr"));
}

// The picture of the scene without what is wrong.
TEST(Permissive, WhatIsWrongDisturbsNothingElse) {
  const Folder folder;
  const std::string rest =
      "Shape \"trianglemesh\" \"point3 P\" [-1 -1 0  0 -1 0  0 1 0]\n"
      "Material \"mirror\"\nShape \"sphere\" \"float radius\" 0.5\n";
  run(folder, "--outfile good.png", world("Shape \"sphere\"\n" + rest));
  const Outcome outcome =
      run(folder, "--permissive --outfile bad.png",
          world("AttributeBegin\nAreaLightSource \"diffuse\" \"float L\" 1\nShape \"sphere\"\n"
                "AttributeEnd\n" +
                rest));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(contents(folder.path() / "good.png"), contents(folder.path() / "bad.png"));
}

// The generation is told by how types are written, which the normal form changes.
TEST(Format, KeepsTheGeneration) {
  const Folder folder;
  const std::string old =
      "WorldBegin\nLightSource \"point\" \"color I\" [1 1 1] \"point from\" [0 0 1]\n"
      "Material \"plastic\"\nShape \"sphere\"\nWorldEnd\n";
  for (const char* scene : {old.c_str(), "SurfaceIntegrator \"path\"\nWorldBegin\nWorldEnd\n",
                            "WorldBegin\nMaterial \"clay\"\nWorldEnd\n"}) {
    const auto generation = [&](const std::string& of) {
      const std::string told = folder.pbrt("--check " + of).out;
      return told.substr(told.find("pbrt-"), 7);
    };
    folder.write("scene.pbrt", scene);
    folder.write("formatted.pbrt", folder.pbrt("--format scene.pbrt").out);
    EXPECT_EQ(generation("formatted.pbrt"), generation("scene.pbrt")) << scene;
  }
}

TEST(Format, IncludesThatAreMissingMayBePassedOver) {
  const Folder folder;
  const std::string scene = world("Include \"nowhere.pbrt\"\nShape \"sphere\"");
  const Outcome outcome = run(folder, "--format --permissive", scene);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(has(outcome.out, "Shape \"sphere\"")) << outcome.out;
  EXPECT_TRUE(has(outcome.err, "1 error passed over")) << outcome.err;
}

TEST(Format, AFullDiskIsAnError) {
  const Folder folder;
  folder.write("scene.pbrt", world("Shape \"sphere\""));
  const Outcome outcome =
      folder.command("sh -c '" + Folder::program() + " --format scene.pbrt >/dev/full'");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(has(outcome.err, "standard output")) << outcome.err;
}

TEST(Files, ThePathsThatWereTriedAreNamed) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "part");
  folder.write("part/part.pbrt",
               "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\"\n"
               "Material \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\"\n"
               "Shape \"plymesh\" \"string filename\" \"meshes/a.ply\"\nInclude \"b.pbrt\"\n");
  folder.write("scene.pbrt", world("Include \"part/part.pbrt\""));
  const std::string first = folder.path().string();
  const Outcome outcome =
      folder.command("sh -c 'cd / && " + Folder::program() + " --check " + first + "/scene.pbrt'");
  EXPECT_EQ(outcome.code, 3);
  for (const std::string& tried :
       {first + "/part/wood.png, " + first + "/wood.png, wood.png",
        first + "/part/meshes/a.ply, " + first + "/meshes/a.ply, meshes/a.ply",
        first + "/part/b.pbrt, nor " + first + "/b.pbrt"})
    EXPECT_TRUE(has(outcome.err, tried)) << tried << "\n" << outcome.err;
}

// An archive may bring a scene and a link from the name of its picture to anywhere.
TEST(Files, APictureReplacesOnlyPictures) {
  const Folder folder;
  folder.write("scene.pbrt", world("Shape \"sphere\""));
  folder.write("precious", "of the user");
  std::filesystem::create_symlink("precious", folder.path() / "out.exr");
  const Outcome outcome = folder.pbrt("scene.pbrt");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(has(outcome.err, "precious")) << outcome.err;
  EXPECT_EQ(contents(folder.path() / "precious"), "of the user");
}

TEST(Files, APictureReplacesNoPipe) {
  const Folder folder;
  folder.write("scene.pbrt", world("Shape \"sphere\""));
  folder.command("mkfifo out.exr");
  const Outcome outcome = folder.pbrt("scene.pbrt");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(has(outcome.err, "out.exr")) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_fifo(folder.path() / "out.exr"));
}

}  // namespace
}  // namespace pbrt::test
