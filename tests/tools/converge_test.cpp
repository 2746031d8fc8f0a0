// pbrt-converge as a user runs it: what it leaves behind, what it prints, how it ends.

#include <nlohmann/json.hpp>

#include "core/base/image.h"
#include "tests/command.h"
#include "tests/tools/stripes.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

// A picture of one value, as the reference of stripes.
Image flat(int size, float value) {
  Image image{.window = {{0, 0}, {size, size}}, .resolution = {size, size}};
  for (const char* name : {"R", "G", "B"}) {
    image.names.emplace_back(name);
    image.channels.emplace_back(static_cast<std::size_t>(size * size), value);
  }
  return image;
}

class Converge : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("scene.pbrt", stripes(8));
    writeImage(folder.path() / "right.exr", flat(8, 0.5F));
  }
  Outcome converge(const std::string& arguments) const {
    return folder.command(PBRT_BUILD_DIR "/bin/pbrt-converge " + arguments);
  }
  nlohmann::json json(const std::string& out = "out") const {
    return nlohmann::json::parse(contents(folder.path() / out / "report.json"));
  }
  std::size_t filesIn(const std::string& out) const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path() / out), {}));
  }

  Folder folder;
};

TEST_F(Converge, LeavesAPageAndItsNumbers) {
  const Outcome outcome = converge(
      "scene.pbrt --with '' --with 'it'\\''s=Sampler \"halton\"' --max-spp 9 --seeds 3 "
      "--reference right.exr --nthreads 1 --out out");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(filesIn("out"), 3U);
  EXPECT_NE(contents(folder.path() / "out/index.html").find("</html>"), std::string::npos);
  EXPECT_TRUE(contents(folder.path() / "out/report.csv").starts_with("scene,variant,"));
  EXPECT_TRUE(outcome.out.ends_with("out/index.html\n")) << outcome.out;
  EXPECT_NE(outcome.out.find("\nscene "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nit's "), std::string::npos) << outcome.out;
  const nlohmann::json report = json();
  EXPECT_EQ(report["threads"], 1);
  ASSERT_EQ(report["notes"].size(), 1U) << "what the pictures cost, and nothing else";
  EXPECT_NE(report["notes"][0].get<std::string>().find("not counted"), std::string::npos);
  EXPECT_EQ(report["variants"][0]["label"], "scene");
  EXPECT_EQ(report["variants"][1]["label"], "it's");
  EXPECT_EQ(report["variants"][1]["statements"], "Sampler \"halton\"");
  EXPECT_EQ(report["references"][0]["description"], "right.exr");
  std::vector<int> samples;
  for (const auto& s : report["variants"][0]["snapshots"]) {
    samples.push_back(s["samples"]);
    EXPECT_EQ(s["seeds"], 3);
  }
  EXPECT_EQ(samples, (std::vector<int>{1, 2, 4, 8}));
}

// What stands in the report can be typed again.
TEST_F(Converge, TellsItsCommandAsAPersonWouldTypeIt) {
  const std::string arguments =
      "scene.pbrt --with 'it'\\''s=Sampler \"halton\"' --max-spp 2 --seeds 1 --quiet --out out";
  const Outcome outcome = converge(arguments);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(json()["command"], "pbrt-converge " + arguments);
}

TEST_F(Converge, NamesVariantsOfSeveralScenes) {
  folder.write("other.pbrt", stripes(8));
  EXPECT_EQ(converge("scene.pbrt other.pbrt --with '' --with 'h=Sampler \"halton\"' --max-spp 2 "
                     "--seeds 1 --reference-spp 8 --out out")
                .code,
            0);
  const nlohmann::json report = json();
  std::vector<std::string> labels;
  for (const auto& v : report["variants"]) labels.push_back(v["label"]);
  EXPECT_EQ(labels, (std::vector<std::string>{"scene", "scene h", "other", "other h"}));
  ASSERT_EQ(report["references"].size(), 2U);
  EXPECT_EQ(report["references"][1]["samples"], 8);
  EXPECT_EQ(report["variants"][3]["reference"], 1);
}

TEST_F(Converge, TakesSnapshotsAtTimes) {
  EXPECT_EQ(
      converge("scene.pbrt --times 0.005,0.02 --seeds 1 --reference right.exr --out out").code, 0);
  const nlohmann::json report = json(), snapshots = report["variants"][0]["snapshots"];
  ASSERT_EQ(snapshots.size(), 2U);
  EXPECT_GE(snapshots[1]["samples"], snapshots[0]["samples"]);
}

TEST_F(Converge, ReplacesItsEarlierReport) {
  for (const char* samples : {"2", "4"})
    EXPECT_EQ(converge("scene.pbrt --seeds 1 --reference right.exr --out out --max-spp " +
                       std::string(samples))
                  .code,
              0);
  EXPECT_EQ(json()["variants"][0]["snapshots"].size(), 3U);
  EXPECT_EQ(filesIn("out"), 3U);
}

TEST_F(Converge, TellsOfSamplesThatAreNoNumbers) {
  folder.write("scene.pbrt", R"(PixelFilter "box"
Film "image" "integer xresolution" 8 "integer yresolution" 8
Sampler "random"
SurfaceIntegrator "whitted"
WorldBegin
LightSource "point" "point from" [0 0 0] "rgb I" [3e38 3e38 3e38]
Shape "sphere" "float radius" 0.001
WorldEnd
)");
  const Outcome outcome =
      converge("scene.pbrt --max-spp 1 --seeds 2 --reference right.exr --out out");
  EXPECT_EQ(outcome.code, 0);
  const std::string said = "scene: 128 samples were not a number or infinite";
  EXPECT_NE(outcome.err.find("warning: " + said), std::string::npos) << outcome.err;
  EXPECT_TRUE(json()["notes"][0].get<std::string>().starts_with(said));
}

TEST_F(Converge, OfBytesThatAreNoTextEndsWell) {
  fs::copy(folder.path() / "scene.pbrt", folder.path() / "caf\xe9.pbrt");
  EXPECT_EQ(converge("caf\xe9.pbrt --max-spp 2 --seeds 1 --reference right.exr --out out").code, 0);
  EXPECT_EQ(json()["variants"][0]["label"], "caf\uFFFD");
}

struct Case {
  std::string name, arguments;
  int code;
  std::string message;  // part of the last line, or of the only one
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class BadConverge : public Converge, public testing::WithParamInterface<Case> {};

TEST_P(BadConverge, IsOneClearLineAndTheRightExitCode) {
  const Case& c = GetParam();
  folder.write("file", "");
  folder.write("broken.pbrt", "WorldBegin\nShape \"spere\"\nWorldEnd\n");
  folder.write("broken.exr", "no picture");
  folder.write("empty.pbrt", "Camera \"perspective\"\n");
  Image nan = flat(8, 0.5F);
  nan.channels[1][13] = std::numeric_limits<float>::quiet_NaN();
  writeImage(folder.path() / "nan.exr", nan);
  writeImage(folder.path() / "small.exr", flat(4, 0.5F));
  fs::create_directories(folder.path() / "taken" / "report.csv");
  const std::size_t before = folder.files();
  const Outcome outcome = converge(c.arguments + " --quiet");
  EXPECT_EQ(outcome.code, c.code) << outcome.err;
  EXPECT_NE(outcome.err.find(c.message), std::string::npos) << outcome.err;
  EXPECT_LT(outcome.err.size(), 400U) << outcome.err;
  EXPECT_EQ(outcome.err.find("bug"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  // At most an empty folder is left.
  if (fs::exists(folder.path() / "out")) {
    EXPECT_EQ(filesIn("out"), 0U);
  } else {
    EXPECT_EQ(folder.files(), before);
  }
  EXPECT_EQ(filesIn("taken"), 1U);
}

const Case kCases[] = {
    {"NoScene", "--out out", 2, "scene"},
    {"NoOut", "scene.pbrt", 2, "--out"},
    {"NoSuchScene", "nowhere.pbrt --out out", 4, "nowhere.pbrt"},
    {"BrokenScene", "broken.pbrt --out out", 3, "broken.pbrt:2:1: error: there is no shape"},
    {"SceneWithoutWorld", "empty.pbrt --out out", 3, "WorldBegin"},
    {"NoSuchPlugin", "scene.pbrt --with 'Integrator \"pth\"' --out out", 3,
     "--with:1:1: error: there is no integrator \"pth\"; did you mean \"path\"?"},
    {"WithText", "scene.pbrt --with 'nonsense' --out out", 3, "--with:1:1: error: "},
    {"WithUnclosed", "scene.pbrt --with 'Sampler \"random' --out out", 3, "--with:1:9: error: "},
    {"WithCamera", "scene.pbrt --with 'Camera \"perspective\"' --out out", 3,
     "--with:1:1: error: Camera cannot be changed here"},
    {"TimesFall", "scene.pbrt --times 2,1 --out out", 2, "--times must grow"},
    {"TimesStay", "scene.pbrt --times 1,1 --out out", 2, "--times must grow"},
    {"TimeZero", "scene.pbrt --times 0 --out out", 2, "--times"},
    {"TimesNaN", "scene.pbrt --times nan --out out", 2, "--times"},
    {"TimesAndSamples", "scene.pbrt --times 1 --max-spp 4 --out out", 2, "excludes"},
    {"SeedsZero", "scene.pbrt --seeds 0 --out out", 2, "--seeds"},
    {"MinAboveMax", "scene.pbrt --min-spp 257 --out out", 2, "--min-spp is more than --max-spp"},
    {"ReferencesForSome", "scene.pbrt --reference right.exr --reference right.exr --out out", 2,
     "one --reference for all scenes, or one for each"},
    {"NoSuchReference", "scene.pbrt --reference nowhere.exr --out out", 4, "nowhere.exr"},
    {"BrokenReference", "scene.pbrt --reference broken.exr --out out", 4, "broken.exr"},
    {"NanReference", "scene.pbrt --reference nan.exr --out out", 4,
     "nan.exr: channel G holds values that are not a number or infinite"},
    {"SmallReference", "scene.pbrt --reference small.exr --out out", 2,
     "the reference of scene has other pixels than the scene"},
    {"OutIsAFile", "scene.pbrt --out file", 4, "file"},
    {"OutBelowAFile", "scene.pbrt --out file/out", 4, "file/out"},
    {"OutIsNowhereToBe", "scene.pbrt --out /proc/out", 4, "/proc/out"},
    {"AFileOfTheReportIsAFolder", "scene.pbrt --out taken", 4, "taken/report.csv: it is a folder"},
    {"BadDialect", "scene.pbrt --dialect v7 --out out", 2, "--dialect"},
};

INSTANTIATE_TEST_SUITE_P(Table, BadConverge, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST_F(Converge, EndsWith5IfAPluginIsBroken) {
  fs::create_directories(folder.path() / "plugins/samplers");
  folder.write("plugins/samplers/random.so", "no library");
  const Outcome outcome =
      converge("scene.pbrt --plugin-path plugins --reference right.exr --out out");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("random.so"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace pbrt::test
