// Every scene at hand is read whole: those of other people (../shared/scenes, by generation) and
// our own.

#include <regex>
#include <set>

#include "tests/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

const fs::path kShared = fs::path(PBRT_SOURCE_DIR) / "../shared/scenes";

// Those whose pictures are not at hand; they pass where the missing is passed over.
const std::set<std::string> kWithoutTextures = {"v1/disks.pbrt",
                                                "v1/miscquads.pbrt",
                                                "v3/simple/miscquads.pbrt",
                                                "v3/simple/anim-bluespheres.pbrt",
                                                "v3/simple/room-path.pbrt",
                                                "v3/killeroos/killeroo-gold.pbrt"};

// Included files, which have no WorldBegin, are left out.
std::vector<std::string> scenesUnder(const fs::path& root) {
  std::vector<std::string> names;
  if (fs::exists(root))
    for (const auto& entry : fs::recursive_directory_iterator(root))
      if (entry.path().extension() == ".pbrt" &&
          test::contents(entry.path()).find("WorldBegin") != std::string::npos)
        names.push_back(fs::relative(entry.path(), root));
  std::sort(names.begin(), names.end());
  return names;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

// Whether what --check said of a scene's generation allows for `dialect`: it is that one, or one
// that the text does not tell from it.
testing::AssertionResult canBe(const std::string& said, const std::string& dialect) {
  std::smatch found;
  if (!std::regex_search(said, found, std::regex(R"(: pbrt-(v\d) \(([^)]*)\); )")))
    return testing::AssertionFailure() << "no dialect in: " << said;
  const bool open = found.str(2).find("nothing tells it from") != std::string::npos;
  if (found[1] == dialect || (open && found.str(2).find(dialect) != std::string::npos))
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << "taken for " << found[1] << ": " << found[2];
}

TEST(Census, ScenesOfAllGenerationsAreRead) {
  const std::vector<std::string> scenes = scenesUnder(kShared);
  if (scenes.empty()) GTEST_SKIP() << "no " << kShared;
  const test::Folder folder;
  for (const std::string& scene : scenes) {
    SCOPED_TRACE(scene);
    const std::string file = "'" + (kShared / scene).string() + "'";
    const test::Outcome strict = folder.pbrt("--check " + file);
    EXPECT_TRUE(canBe(strict.out, scene.substr(0, scene.find('/'))));
    if (!kWithoutTextures.contains(scene)) {
      EXPECT_EQ(strict.code, 0) << strict.err;
      continue;
    }
    EXPECT_EQ(strict.code, 3);
    EXPECT_GT(count(strict.err, ": error: "), 0U);
    EXPECT_EQ(count(strict.err, ": error: "), count(strict.err, "names a file that is not there"))
        << strict.err;
    const test::Outcome permissive = folder.pbrt("--check --permissive " + file);
    EXPECT_EQ(permissive.code, 0) << permissive.err;
  }
  for (const std::string& scene : kWithoutTextures)
    EXPECT_TRUE(std::binary_search(scenes.begin(), scenes.end(), scene)) << scene;
}

TEST(Census, OurOwnScenesDrawNoWarning) {
  const fs::path root = fs::path(PBRT_SOURCE_DIR) / "scenes";
  const std::vector<std::string> scenes = scenesUnder(root);
  ASSERT_GT(scenes.size(), 10U);
  const test::Folder folder;
  for (const std::string& scene : scenes) {
    SCOPED_TRACE(scene);
    const test::Outcome outcome = folder.pbrt("--check '" + (root / scene).string() + "'");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
  }
}

}  // namespace
}  // namespace pbrt
