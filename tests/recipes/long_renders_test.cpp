// docs/long-renders.md, word for word: the commands of each section, in a folder with a scene and
// the files of examples/long-renders, while runs of pbrt are killed, warned and requeued
// (bad-day/pbrt). In the end the picture has the same bits as one that was rendered in peace.

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "core/base/image.h"
#include "tests/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;

const fs::path kExamples = PBRT_SOURCE_DIR "/examples/long-renders";

// A light, a ball of glass, and a gaussian filter that reaches over pixels; seconds on one core.
constexpr const char* kScene = R"(LookAt 0 2 7  0 0.6 0  0 1 0
Camera "perspective" "float fov" 40
Film "image" "integer xresolution" 200 "integer yresolution" 150 "string filename" "scene.exr"
PixelFilter "gaussian"
Sampler "random" "integer pixelsamples" 64
Integrator "path" "integer maxdepth" 6
WorldBegin
LightSource "infinite" "rgb L" [0.4 0.5 0.6]
Material "glass"
Shape "sphere" "float radius" 1
Material "matte" "rgb Kd" [0.7 0.5 0.2]
Translate 1.6 0.4 0.5
Shape "sphere" "float radius" 0.9
Translate -1.6 -1.4 -0.5
Shape "bilinearmesh" "point3 P" [-9 0 -9  9 0 -9  -9 0 9  9 0 9]
WorldEnd
)";

// The commands of each section that has any, by its heading.
std::map<std::string, std::string> sections() {
  std::ifstream in(PBRT_SOURCE_DIR "/docs/long-renders.md");
  std::map<std::string, std::string> found;
  std::string heading;
  bool code = false, commands = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      code = !code;
      commands = line == "```sh";
    } else if (commands && code) {
      found[heading] += line + "\n";
    } else if (!code && line.starts_with("## ")) {
      heading = line.substr(3);
    }
  }
  return found;
}

bool there(const std::string& program) {
  return std::system(("PATH=$PATH:/usr/sbin command -v " + program + " >/dev/null").c_str()) == 0;
}

struct Recipe {
  std::string heading;
  std::string troubles;            // what befalls the runs of pbrt, in their order
  std::vector<std::string> codes;  // what they end with, in any order
  std::vector<std::string> needs;  // programs
  std::vector<std::string> pictures;
};

std::ostream& operator<<(std::ostream& out, const Recipe& recipe) {
  return out << recipe.heading;
}

const Recipe kRecipes[] = {
    {"Pausing and going on", "TERM KILL", {"TERM: 75", "KILL: 137"}, {}, {"scene.exr"}},
    {"Splitting and merging", "", {}, {}, {"scene.exr"}},
    {"GNU parallel", "KILL TERM", {"TERM: 75", "KILL: 137"}, {"parallel"}, {"scene.exr"}},
    {"Slurm", "warn requeue", {"warn: 75", "requeue: 75"}, {"slurmd", "munged"}, {"scene.exr"}},
    {"Animations", "", {}, {}, {"frame-0001.exr", "frame-0003.exr"}},
    {"An animation by Slurm",
     "warn requeue",
     {"warn: 75", "requeue: 75"},
     {"slurmd", "munged"},
     {"frame-0001.exr", "frame-0002.exr"}},
};

class LongRenders : public testing::Test {
 protected:
  // Carries out a recipe, which is recipe.sh there, or others with that.
  void follow(const Recipe& recipe, const std::string& command = "bash recipe.sh") const {
    for (const std::string& program : recipe.needs)
      if (!there(program)) GTEST_SKIP() << "there is no " << program;
    folder_.write("scene.pbrt", kScene);
    for (const auto& file : fs::directory_iterator(kExamples))
      fs::copy_file(file, folder_.path() / file.path().filename());
    folder_.write("recipe.sh", "set -e\n" + sections()[recipe.heading]);
    const bool slurm = std::ranges::count(recipe.needs, "slurmd") > 0;

    const test::Outcome run = folder_.command(
        "env -u PBRT_PLUGIN_PATH PBRT='" + test::Folder::program() + "' TROUBLES='" +
        recipe.troubles +
        "' PATH='" PBRT_SOURCE_DIR "/tests/recipes/bad-day:" PBRT_BUILD_DIR "/bin':\"$PATH\" " +
        (slurm ? PBRT_SOURCE_DIR "/tests/recipes/with-slurm " : "") + command);
    std::string logs;  // of tasks, whose errors go there
    for (const auto& file : fs::directory_iterator(folder_.path()))
      if (file.path().extension() == ".log") logs += test::contents(file);
    ASSERT_EQ(run.code, 0) << run.out << run.err << logs;

    std::istringstream troubles(test::contents(folder_.path() / "troubles.log"));
    std::vector<std::string> codes;
    for (std::string line; std::getline(troubles, line);) codes.push_back(line);
    EXPECT_THAT(codes, UnorderedElementsAreArray(recipe.codes)) << logs;

    ASSERT_EQ(folder_.pbrt("scene.pbrt --quiet --outfile peace.exr").code, 0);
    const Image peace = readExr(folder_.path() / "peace.exr");
    for (const std::string& picture : recipe.pictures) {
      const Image image = readExr(folder_.path() / picture);
      EXPECT_EQ(image.names, peace.names);
      EXPECT_EQ(image.channels, peace.channels);
      EXPECT_EQ(image.attributes.at("samplesPerPixel"), peace.attributes.at("samplesPerPixel"));
    }
  }

 private:
  const test::Folder folder_;
};

class EachRecipe : public LongRenders, public testing::WithParamInterface<Recipe> {};

TEST_P(EachRecipe, MakeTheSamePictureWhateverBefallsThem) {
  follow(GetParam());
}

// A task is killed: the second job neither waits for ever nor makes a picture of the others. Then
// tasks are repeated by their numbers.
TEST_F(LongRenders, SlurmTellsOfATaskThatFailed) {
  follow({"Slurm", "KILL", {"KILL: 137"}, {"slurmd", "munged"}, {"scene.exr"}},
         "sh -c 'bash recipe.sh; test $? = 3 && test ! -e scene.exr && "
         "sed s/array=0-3/array=0,1,2,3/ recipe.sh | bash'");
}

INSTANTIATE_TEST_SUITE_P(LongRenders, EachRecipe, testing::ValuesIn(kRecipes),
                         [](const auto& tested) {
                           std::string name;
                           for (const char c : tested.param.heading)
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           return name;
                         });

// The command of a task of frames.openjd.yaml; the rest of the template was held to its
// specification (jobtemplate-2023-09) by hand.
TEST(Recipes, OpenJobDescriptionRendersAFrame) {
  const test::Folder folder;
  folder.write("scene.pbrt", kScene);
  std::ifstream in(kExamples / "frames.openjd.yaml");
  const std::string item = "            - ";
  std::string arguments;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(item)) arguments += line.substr(item.size()) + " ";
  for (const auto& [name, value] :
       {std::pair{"{{Param.Scene}}", "scene.pbrt"}, std::pair{"{{Param.Pictures}}", "."},
        std::pair{"{{Task.Param.Frame}}", "7"}})
    for (std::size_t at; (at = arguments.find(name)) != arguments.npos;)
      arguments.replace(at, std::string(name).size(), value);
  EXPECT_EQ(arguments.find("{{"), arguments.npos) << arguments;
  const test::Outcome run = folder.pbrt(arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("openjd_progress: 100"));
  EXPECT_TRUE(fs::exists(folder.path() / "frame-0007.exr"));
}

TEST(Recipes, AreAllTested) {
  std::set<std::string> documented, tested;
  for (const auto& [heading, commands] : sections()) documented.insert(heading);
  for (const Recipe& recipe : kRecipes) tested.insert(recipe.heading);
  EXPECT_EQ(documented, tested);
}

}  // namespace
}  // namespace pbrt
