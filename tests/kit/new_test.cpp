// What `pbrt-plugin new` writes and what it refuses. That the projects build is in projects.cpp.

#include "tools/plugin/new.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKinds[] = {"shape",   "integrator", "material", "light", "texture",
                                  "sampler", "filter",     "camera",   "volume"};

std::string sourceOf(const fs::path& project) {
  return contents(project / (project.filename().string() + ".cpp"));
}

// The failure, and the message.
std::pair<Failure, std::string> refusal(const NewPlugin& plugin) {
  try {
    writeProject(plugin);
  } catch (const Error& error) {
    return {error.failure(), error.what()};
  }
  ADD_FAILURE() << "writes " << plugin.kind << " " << plugin.name;
  return {};
}

TEST(NewPlugin, IsWhole) {
  const Folder folder;
  for (const std::string kind : kKinds) {
    SCOPED_TRACE(kind);
    const fs::path project = writeProject({kind, "my-" + kind, folder.path()});
    EXPECT_EQ(project, folder.path() / ("my-" + kind));
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(project)) {
      ++files;
      const std::string text = contents(entry.path());
      EXPECT_FALSE(text.empty()) << entry.path();
      // Places that were not filled in.
      for (auto at = text.find('@'); at != text.npos; at = text.find('@', at + 1))
        EXPECT_FALSE(at + 1 < text.size() && std::isupper(text[at + 1])) << text.substr(at, 20);
    }
    EXPECT_EQ(files, 5U);  // CMakeLists.txt, README.md, .gitignore, source and scene
    EXPECT_NE(sourceOf(project).find("\"my-" + kind + "\""), std::string::npos);
    EXPECT_NE(contents(project / ("my-" + kind + ".pbrt")).find("\"my-" + kind + "\""),
              std::string::npos);
    const auto lines = std::ranges::count(sourceOf(project), '\n');
    EXPECT_TRUE(lines > 15 && lines < 80) << lines;
  }
  EXPECT_EQ(folder.files(), std::size(kKinds)) << "something else is left";
}

TEST(NewPlugin, HasAClassThatTheSourceDoesNotUseForSomethingElse) {
  const Folder folder;
  const std::pair<const char*, const char*> names[] = {
      {"torus", "Torus"},      {"my-torus_2", "MyTorus2"},
      {"myTorus", "MyTorus"},  {"class", "Class"},
      {"EOF", "Eof"},          {"3ball", "Shape3ball"},
      {"x--y_", "XY"},         {"Params", "ParamsShape"},
      {"shape", "ShapeShape"}, {"_-", "ShapeShape"}};
  for (const auto& [name, expected] : names) {
    const std::string source = sourceOf(writeProject({"shape", name, folder.path()}));
    EXPECT_NE(source.find(fmt::format("class {} final", expected)), source.npos) << name << "\n"
                                                                                 << source;
  }
}

TEST(NewPlugin, RefusesNamesThatNoSceneCanSay) {
  const Folder folder;
  for (const std::string& name :
       {std::string(), std::string("-x"), std::string("a b"), std::string("a/b"),
        std::string("../x"), std::string("."), std::string("a.b"), std::string("b\xc3\xa4r"),
        std::string("a\"b"), std::string("a\nb"), std::string(100, 'a'), std::string(300, 'a')}) {
    const auto [failure, message] = refusal({"shape", name, folder.path()});
    EXPECT_EQ(failure, Failure::usage) << name;
    EXPECT_NE(message.find("letters"), message.npos) << message;
  }
  EXPECT_EQ(folder.files(), 0U);
  EXPECT_NO_THROW(writeProject({"shape", std::string(99, 'a'), folder.path()}));
}

TEST(NewPlugin, KnowsKindsInTheSingularAndThePlural) {
  const Folder folder;
  EXPECT_NO_THROW(writeProject({"volumes", "fog", folder.path()}));
  const auto [failure, message] = refusal({"shap", "x", folder.path()});
  EXPECT_EQ(failure, Failure::usage);
  EXPECT_NE(message.find("did you mean \"shape\"?"), message.npos) << message;
}

TEST(NewPlugin, TouchesNothingThatIsThere) {
  const Folder folder;
  folder.write("file", "mine");
  fs::create_directory(folder.path() / "empty");
  fs::create_symlink("nowhere", folder.path() / "link");
  for (const char* name : {"file", "empty", "link"}) {
    const auto [failure, message] = refusal({"shape", name, folder.path()});
    EXPECT_EQ(failure, Failure::usage) << name;
    EXPECT_NE(message.find("is there already"), message.npos) << message;
  }
  EXPECT_EQ(contents(folder.path() / "file"), "mine");
  EXPECT_TRUE(fs::is_empty(folder.path() / "empty"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(folder.files(), 3U);
}

TEST(NewPlugin, LeavesNothingWhereItCannotWrite) {
  const Folder folder;
  folder.write("file", "mine");
  for (const char* into : {"nowhere", "file"}) {
    const auto [failure, message] = refusal({"shape", "x", folder.path() / into});
    EXPECT_EQ(failure, Failure::io) << message;
    EXPECT_NE(message.find(into), message.npos) << message;
  }
  EXPECT_EQ(folder.files(), 1U);
}

TEST(NewPlugin, TellsWherePbrtIsInstalled) {
  const Folder folder;
  const fs::path project = writeProject({"shape", "x", folder.path(), "/opt/my pbrt"});
  const std::string text = contents(project / "CMakeLists.txt");
  EXPECT_NE(text.find("find_package(pbrt REQUIRED PATHS [[/opt/my pbrt]])\n"), text.npos) << text;
}

TEST(NewPlugin, IsACommand) {
  const Folder folder;
  const std::string program = PBRT_BUILD_DIR "/bin/pbrt-plugin new ";
  const Outcome made = folder.command(program + "shape ring");
  EXPECT_EQ(made.code, 0) << made.err;
  // A build holds no package for CMake; kit/install.cmake and projects.cpp see to one that does.
  EXPECT_NE(made.err.find("warning: " PBRT_BUILD_DIR " holds no CMake package"), made.err.npos)
      << made.err;
  EXPECT_NE(made.err.find("install pbrt first"), made.err.npos) << made.err;
  EXPECT_NE(contents(folder.path() / "ring/CMakeLists.txt").find("find_package(pbrt REQUIRED)\n"),
            std::string::npos);
  EXPECT_NE(made.out.find("cmake -S ring -B ring/build"), made.out.npos) << made.out;
  EXPECT_EQ(folder.command(program + "shape ring").code, 2);
  const Outcome known = folder.command(program + "shape sphere --into " + folder.path().string());
  EXPECT_EQ(known.code, 0);
  EXPECT_NE(known.err.find("warning: pbrt itself has a shape \"sphere\""), known.err.npos);
  EXPECT_EQ(folder.command(program + "shape -- -x").code, 2);
  EXPECT_EQ(folder.command(program + "shape").code, 2);
  EXPECT_EQ(folder.command(program + "shape x --into nowhere").code, 4);
  EXPECT_EQ(folder.files(), 2U);
}

}  // namespace
}  // namespace pbrt::test
