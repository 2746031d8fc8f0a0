#include "core/base/replacement.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/base/error.h"
#include "core/base/file.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

[[noreturn]] void systemError(int code) {
  throw std::runtime_error(std::generic_category().message(code));
}

}  // namespace

fs::path throughLinks(const fs::path& file) {
  std::error_code error;
  if (!fs::is_symlink(file, error)) return file;
  const fs::path target = fs::weakly_canonical(file, error);
  return error ? file : target;
}

Replacement::Replacement(const fs::path& target) : target_(throughLinks(target)) {
  const fs::file_status status = fs::status(target_);  // throws if the name is too long
  if (fs::is_directory(status)) throw std::runtime_error("it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw std::runtime_error("it is a device or a pipe");
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

Replacement::~Replacement() {
  if (stream_ != nullptr) std::fclose(stream_);
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void Replacement::commit() {
  // An earlier failure may have been seen only by a destructor, which could not report it.
  const bool failed = std::ferror(stream_) != 0;
  const int closed = std::fclose(std::exchange(stream_, nullptr));
  if (failed || closed != 0) systemError(closed != 0 ? errno : EIO);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) systemError(errno);
  temporary_.clear();
}

namespace {

template <class Work>
void named(const fs::path& file, Work work) try {
  work();
} catch (const std::exception& error) {
  throw Error(fmt::format("cannot write {}: {}", file.string(), reasonOf(error)), Failure::io);
}

}  // namespace

void checkReplaceable(const fs::path& file) {
  named(file, [&] { Replacement replacement(file); });
}

void replaceFile(const fs::path& file, const std::function<void(std::FILE*)>& write) {
  named(file, [&] {
    Replacement replacement(file);
    write(replacement.stream());
    replacement.commit();
  });
}

void writeFile(const fs::path& file, std::string_view bytes) {
  replaceFile(file, [&](std::FILE* stream) { std::fwrite(bytes.data(), 1, bytes.size(), stream); });
}

}  // namespace pbrt
