#pragma once
// Runs the pbrt command as a user does, in a folder of its own.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace pbrt::test {

struct Outcome {
  int code = -1;  // exit code; 128 + n if signal n ended it, 124 if it took too long
  std::string out, err;
};

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A folder that goes away with the test.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pbrt-test-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // In a folder below, too, which is made if it is not there.
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

  // Runs `pbrt ARGUMENTS` here; the arguments are words of a shell command line.
  Outcome pbrt(const std::string& arguments) const { return command(program() + " " + arguments); }

  Outcome command(const std::string& line) const {
    const std::string out = path_.string() + ".out", err = path_.string() + ".err";
    const std::string whole =
        "cd '" + path_.string() + "' && timeout 120 " + line + " >'" + out + "' 2>'" + err + "'";
    const int status = std::system(whole.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out),
                    contents(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return outcome;
  }

  static std::string program() { return PBRT_BUILD_DIR "/bin/pbrt"; }

 private:
  std::filesystem::path path_;
};

}  // namespace pbrt::test
