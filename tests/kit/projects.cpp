// Projects of plug-ins as a stranger builds them: with the programs, headers and libraries of an
// installed prefix and nothing else of this project. install.cmake makes the prefix.

#include <algorithm>
#include <cctype>
#include <numeric>
#include <set>

#include "core/base/image.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

const fs::path kPrefix = PBRT_KIT "/prefix";

struct Project {
  std::string kind;  // empty: an example
  std::string name;
  std::string compiler;
  std::string label() const {
    std::string text = (kind.empty() ? "example" : kind) + "_" + name + "_" +
                       fs::path(compiler).filename().string();
    for (char& c : text)
      if (!std::isalnum(static_cast<unsigned char>(c))) c = c == '+' ? 'x' : '_';
    return text;
  }
};

void PrintTo(const Project& project, std::ostream* out) {
  *out << project.label();
}

// Runs a line of a shell with the programs of the prefix in PATH.
Outcome run(const fs::path& folder, const std::string& compiler, const std::string& line) {
  const std::string launcher = PBRT_LAUNCHER;
  return Folder().command(
      "env -u PBRT_PLUGIN_PATH -u LD_LIBRARY_PATH -u CMAKE_PREFIX_PATH -u pbrt_ROOT "
      "-u CMAKE_BUILD_TYPE 'PATH=" +
      (kPrefix / "bin").string() + ":'\"$PATH\" 'CXX=" + compiler +
      "' 'CMAKE_GENERATOR=" + PBRT_GENERATOR + "' " +
      (launcher.empty() ? "" : "'CMAKE_CXX_COMPILER_LAUNCHER=" + launcher + "' ") +
      "CMAKE_EXPORT_COMPILE_COMMANDS=1 'CXXFLAGS=-Wall -Wextra -Wpedantic -Wshadow -Werror' "
      "sh -c 'cd \"" +
      folder.string() + "\" && " + line + "'");
}

class Projects : public testing::TestWithParam<Project> {};

TEST_P(Projects, BuildObeyTheLawsAndRender) {
  const Project& project = GetParam();
  const fs::path folder = fs::path(PBRT_KIT) / project.label();
  fs::remove_all(folder);
  fs::create_directory(folder);
  const auto succeeds = [&](const std::string& line) {
    const Outcome o = run(folder, project.compiler, line);
    EXPECT_EQ(o.code, 0) << line << "\n" << o.out << o.err;
    return o.code == 0 ? o.out : "";
  };
  const std::string& name = project.name;
  if (project.kind.empty())
    fs::copy(PBRT_SOURCE_DIR "/examples/" + name, folder / name, fs::copy_options::recursive);
  else
    ASSERT_NE(succeeds("pbrt-plugin new " + project.kind + " " + name), "");
  ASSERT_NE(succeeds(PBRT_CMAKE " -S " + name + " -B " + name + "/build"), "");
  ASSERT_NE(succeeds(PBRT_CMAKE " --build " + name + "/build"), "");

  const fs::path build = folder / name / "build";
  const std::string commands = contents(build / "compile_commands.json");
  EXPECT_NE(commands.find((kPrefix / "include/pbrt").string() + " "), commands.npos) << commands;
  for (const std::string option : {"-I", "-isystem "})
    EXPECT_EQ(commands.find(option + PBRT_SOURCE_DIR " "), commands.npos) << commands;
  EXPECT_NE(commands.find(" -O3 "), commands.npos) << "not the build type Release\n" << commands;

  const std::string report =
      succeeds(PBRT_CTEST " --test-dir " + name + "/build --output-on-failure");
  EXPECT_NE(report.find("0 tests failed out of 2"), report.npos) << report;
  const Image picture = readImage((build / (name + ".png")).string());
  EXPECT_EQ(picture.resolution, Point2i(200));
  const std::vector<float>& green = *picture.channel("G");
  const double mean = std::accumulate(green.begin(), green.end(), 0.0) / (200 * 200);
  EXPECT_TRUE(mean > 0.02 && mean < 0.95) << mean;

  succeeds(PBRT_CMAKE " --install " + name + "/build --prefix installed");
  const std::string kinds = fs::directory_iterator(build / "plugins")->path().filename();
  EXPECT_TRUE(fs::exists(folder / "installed" / PBRT_LIBDIR / "pbrt" / kinds / (name + ".so")));
}

std::vector<Project> projects() {
  std::vector<Project> all;
  for (const std::string compiler : {PBRT_CXX, PBRT_OTHER_CXX})
    if (!compiler.empty())
      for (const char* example : {"torus", "gyroid", "curvature"})
        all.push_back({"", example, compiler});
  // Names that are hard on the source: a digit first, keywords, macros, words that it uses itself.
  for (const auto& [kind, name] :
       std::initializer_list<std::pair<const char*, const char*>>{{"shape", "box"},
                                                                  {"integrator", "3d-look"},
                                                                  {"material", "class"},
                                                                  {"light", "params"},
                                                                  {"texture", "texture"},
                                                                  {"sampler", "EOF"},
                                                                  {"filter", "_"},
                                                                  {"camera", "ray"},
                                                                  {"volume", "test"}})
    all.push_back({kind, name, PBRT_CXX});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, Projects, testing::ValuesIn(projects()),
                         [](const auto& test) { return test.param.label(); });

TEST(Prefix, StandsAloneWhereverItIs) {
  // What it brings.
  std::set<std::string> headers;
  for (const auto& entry : fs::directory_iterator(kPrefix / "include/pbrt/core"))
    headers.insert(entry.path().filename());
  EXPECT_EQ(headers, (std::set<std::string>{"api", "base", "plugin"}));
  for (const char* program : {"pbrt", "pbrt-diff", "pbrt-plugin"}) {
    const Outcome o = run(kPrefix, "", std::string(program) + " --version && ldd bin/" + program);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_NE(o.out.find("=> " + kPrefix.string() + "/"), o.out.npos) << o.out;
    EXPECT_EQ(o.out.find("not found"), o.out.npos) << o.out;
  }
  // Nothing names the build, the sources or where it was first.
  for (const auto& entry : fs::recursive_directory_iterator(kPrefix)) {
    if (!entry.is_regular_file()) continue;
    const std::string text = contents(entry.path());
    for (const char* elsewhere :
         {PBRT_KIT "/first", PBRT_BUILD_DIR "/lib", PBRT_SOURCE_DIR "/core"})
      EXPECT_EQ(text.find(elsewhere), text.npos) << entry.path() << " names " << elsewhere;
  }
}

}  // namespace
}  // namespace pbrt::test
