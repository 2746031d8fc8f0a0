// What `./dev fuzz` does, short and on any compiler: the seeds, all that the engines ever found,
// and some thousands of damaged scenes, always the same.

#include <fmt/format.h>

#include <algorithm>

#include "core/base/rng.h"
#include "tests/command.h"
#include "tests/fuzz/dictionary.h"
#include "tests/fuzz/scene_target.h"

namespace pbrt::fuzz {
namespace {

namespace fs = std::filesystem;

class SceneFuzz : public testing::Test {
 protected:
  SceneFuzz() { fs::current_path(folder_.path()); }
  ~SceneFuzz() override { fs::current_path(before_); }

  // The input lies in the folder as long as it is tried: a crash leaves it there.
  // Returns whether it is a scene without errors.
  bool expectOrderly(const std::string& input, const std::string& name) {
    static SceneTarget target;
    folder_.write(name, input);
    bool good = false;
    try {
      good = target.run(input);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << '\n' << name << ":\n" << input;
    }
    fs::remove(name);
    return good;
  }

 private:
  fs::path before_ = fs::current_path();
  test::Folder folder_;
};

std::vector<fs::path> filesOf(const char* folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(PBRT_SOURCE_DIR) / folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// A seed that is refused leads nowhere; one is there for what --permissive does.
TEST_F(SceneFuzz, Seeds) {
  for (const fs::path& file : filesOf("tests/fuzz/seeds"))
    EXPECT_EQ(expectOrderly(test::contents(file), file.filename()), file.stem() != "errors")
        << file;
}

TEST_F(SceneFuzz, Finds) {
  for (const fs::path& file : filesOf("tests/fuzz/finds"))
    expectOrderly(test::contents(file), file.filename());
}

// Changes inputs by words of the dictionary and by pieces of others.
class Mutator {
 public:
  explicit Mutator(std::vector<std::string> inputs) : inputs_(std::move(inputs)) {}

  std::string next() {
    std::string text = pick(inputs_);
    for (std::uint32_t changes = 1 + below(4); changes > 0; --changes) change(text);
    return text;
  }

 private:
  std::uint32_t below(std::size_t end) { return rng_.uniform(static_cast<std::uint32_t>(end)); }
  const std::string& pick(const std::vector<std::string>& from) { return from[below(from.size())]; }

  // Where a word begins, at or after a random place.
  std::size_t wordOf(const std::string& text) {
    const std::size_t blank = text.find_first_of(" \n", below(text.size() + 1));
    return blank == text.npos ? 0 : blank + 1;
  }

  void change(std::string& text) {
    const std::size_t at = wordOf(text);
    const std::size_t length = text.find_first_of(" \n", at) - at;
    switch (below(6)) {
      case 0:
        text.insert(at, pick(words_));
        break;
      case 1:
        text.replace(at, length, pick(words_));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.erase(at, below(200));
        break;
      case 4: {
        const std::string& other = pick(inputs_);
        const std::size_t from = wordOf(other);
        text.insert(at, other, from, below(300));
        break;
      }
      default:
        text.insert(below(text.size() + 1), 1, static_cast<char>(rng_.bits()));
    }
  }

  Rng rng_{1};
  std::vector<std::string> words_ = dictionary();
  std::vector<std::string> inputs_;
};

TEST_F(SceneFuzz, DamagedSeeds) {
  std::vector<std::string> inputs;
  for (const fs::path& file : filesOf("tests/fuzz/seeds")) inputs.push_back(test::contents(file));
  Mutator mutator(std::move(inputs));
  for (int i = 0; i < 4000; ++i) expectOrderly(mutator.next(), fmt::format("mutant-{}", i));
}

}  // namespace
}  // namespace pbrt::fuzz
