#include "core/base/replacement.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/hash.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

[[noreturn]] void systemError(int code) {
  throw std::runtime_error(std::generic_category().message(code));
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

// The names that the new file may have, the first that is free. They do not contain the target's,
// which may be as long as names can be.
fs::path temporaryName(const fs::path& target, int k) {
  const std::uint64_t hash = hashBytes(target.filename().string());
  return folderOf(target) / fmt::format(".pbrt-{:016x}-{}.tmp", hash, k);
}

bool lock(int descriptor) {
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

// Removes what killed processes have left. Only many at a time that write the same file have names
// beyond these. A file system without locks keeps it all. Until the lock is ours, the file may have
// become the target and its name another's: whoever holds the lock of the file that has the name
// now is its only owner.
void removeAbandoned(const fs::path& target) {
  for (int k = 0; k < 8; ++k) {
    const fs::path file = temporaryName(target, k);
    const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) continue;
    struct stat held {
    }, named{};
    if (lock(descriptor) && fstat(descriptor, &held) == 0 && lstat(file.c_str(), &named) == 0 &&
        held.st_dev == named.st_dev && held.st_ino == named.st_ino)
      unlink(file.c_str());
    close(descriptor);
  }
}

// Some file systems have nothing to do for folders, and say so.
void syncFolder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // one may write into it but not read it
  const int code = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  if (code != 0 && code != EINVAL) systemError(code);
}

}  // namespace

fs::path throughLinks(const fs::path& file) {
  constexpr int kMost = 40;  // as Linux
  fs::path target = file;    // which need not be there
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error); ++links) {
    if (links == kMost) return file;
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  return target;
}

Replacement::Replacement(const fs::path& target) : target_(throughLinks(target)) {
  const fs::file_status status = fs::status(target_);  // throws if the name is too long
  if (fs::is_directory(status)) throw std::runtime_error("it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw std::runtime_error("it is a device or a pipe");
  if (fs::exists(status) && access(target_.c_str(), W_OK) != 0) systemError(errno);
  const fs::path folder = folderOf(target_);
  if (!fs::is_directory(folder)) throw std::runtime_error("there is no such folder");
  removeAbandoned(target_);
  if (!openNameless(folder)) openNamed();
  const int copy = fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (copy >= 0) stream_ = fdopen(copy, "wb");
  if (stream_ != nullptr) return;
  const int code = errno;
  if (copy >= 0) close(copy);
  release();
  systemError(code);
}

Replacement::~Replacement() {
  release();
}

void Replacement::release() {
  if (stream_ != nullptr) std::fclose(stream_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

// Whether it could; a name can be had later only through /proc.
bool Replacement::openNameless(const fs::path& folder) {
  if (access("/proc/self/fd", X_OK) != 0) return false;
  descriptor_ = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (descriptor_ >= 0) lock(descriptor_);
  return descriptor_ >= 0;
}

void Replacement::openNamed() {
  for (int k = 0; descriptor_ < 0; ++k) {
    const fs::path file = temporaryName(target_, k);
    descriptor_ = open(file.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) systemError(errno);
    if (descriptor_ < 0) continue;
    // Somebody may have taken it for abandoned before the lock.
    struct stat status {};
    if ((lock(descriptor_) || errno != EWOULDBLOCK) && fstat(descriptor_, &status) == 0 &&
        status.st_nlink > 0)
      temporary_ = file;
    else
      close(std::exchange(descriptor_, -1));
  }
}

void Replacement::giveName() {
  const std::string self = fmt::format("/proc/self/fd/{}", descriptor_);
  for (int k = 0; temporary_.empty(); ++k) {
    const fs::path file = temporaryName(target_, k);
    if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, file.c_str(), AT_SYMLINK_FOLLOW) == 0)
      temporary_ = file;
    else if (errno != EEXIST)
      systemError(errno);
  }
}

void Replacement::commit(Durability durability) {
  // An earlier failure may have been seen only by a destructor, which could not report it.
  const bool failed = std::ferror(stream_) != 0;
  const int closed = std::fclose(std::exchange(stream_, nullptr));
  if (failed || closed != 0) systemError(closed != 0 ? errno : EIO);
  const bool onDisk = durability == Durability::onDisk;
  if (onDisk && fsync(descriptor_) != 0) systemError(errno);
  if (temporary_.empty()) giveName();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) systemError(errno);
  temporary_.clear();
  if (onDisk) syncFolder(folderOf(target_));
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
