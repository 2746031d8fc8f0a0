#include "core/base/image.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cctype>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/base/error.h"
#include "core/base/image_format.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

[[noreturn]] void cannotWrite(const fs::path& file, std::string_view why) {
  throw Error(fmt::format("cannot write {}: {}", file.string(), why), Failure::io);
}

[[noreturn]] void systemError(int code) {
  throw std::runtime_error(std::generic_category().message(code));
}

auto encoderFor(const fs::path& file) {
  std::string suffix = file.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (suffix == ".exr") return encodeExr;
  if (suffix == ".png") return encodePng;
  throw std::runtime_error("its name must end in .exr or .png");
}

// A new file in the folder of `target` that takes the target's place once it is complete, and
// vanishes if it never is.
class Replacement {
 public:
  explicit Replacement(const fs::path& target)
      : target_(fs::is_symlink(target) ? fs::weakly_canonical(target) : target) {
    const fs::file_status status = fs::status(target_);  // throws if the name is too long
    if (fs::is_directory(status)) throw std::runtime_error("it is a folder");
    if (fs::exists(status) && access(target_.c_str(), W_OK) != 0) systemError(errno);
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    if (!fs::is_directory(folder)) throw std::runtime_error("there is no such folder");
    // The name does not contain the target's, which may be as long as names can be.
    static std::atomic<int> count = 0;
    do {
      temporary_ = folder / fmt::format(".pbrt-{}-{}.tmp", getpid(), count++);
      stream_ = std::fopen(temporary_.c_str(), "wbx");
    } while (stream_ == nullptr && errno == EEXIST);
    if (stream_ == nullptr) systemError(errno);
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  ~Replacement() {
    if (stream_ != nullptr) std::fclose(stream_);
    if (!temporary_.empty()) std::remove(temporary_.c_str());
  }

  std::FILE* stream() { return stream_; }

  void commit() {
    // An earlier failure may have been seen only by a destructor, which could not report it.
    const bool failed = std::ferror(stream_) != 0;
    const int closed = std::fclose(std::exchange(stream_, nullptr));
    if (failed || closed != 0) systemError(closed != 0 ? errno : EIO);
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) systemError(errno);
    temporary_.clear();
  }

 private:
  fs::path target_;
  fs::path temporary_;
  std::FILE* stream_ = nullptr;
};

}  // namespace

const std::vector<float>* Image::channel(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &channels[found - names.begin()];
}

void writeImage(const fs::path& file, const Image& image) try {
  const auto encode = encoderFor(file);
  Replacement replacement(file);
  encode(replacement.stream(), image);
  replacement.commit();
} catch (const std::exception& error) {
  cannotWrite(file, error.what());
}

void checkWritable(const fs::path& file) try {
  encoderFor(file);
  Replacement replacement(file);
} catch (const std::exception& error) {
  cannotWrite(file, error.what());
}

}  // namespace pbrt
