#include "core/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/memory_limit.h"

namespace pbrt {

namespace {

// How many bytes to expect. A gzipped file says at its end what it holds, modulo 2^32 (RFC 1952,
// section 2.3.1); deflate packs no more than 1032 bytes into one.
std::size_t expectedSize(int descriptor, std::size_t size, bool packed) {
  std::array<unsigned char, 4> last{};
  if (!packed || size < last.size()) return size;
  if (pread(descriptor, last.data(), last.size(), static_cast<off_t>(size - last.size())) !=
      static_cast<ssize_t>(last.size()))
    return 0;
  const std::size_t held =
      last[0] | last[1] << 8 | last[2] << 16 | static_cast<std::size_t>(last[3]) << 24;
  return std::min(held, 1032 * size);
}

// The order counts: files are read by the thread that builds the scene. Were they read by several,
// the lock would keep the hash whole, and the same scene would no longer have the same one.
std::mutex digesting;
FileDigest* digest = nullptr;

}  // namespace

FileDigest::FileDigest() {
  const std::lock_guard lock(digesting);
  if (digest != nullptr) throw std::logic_error("two file digests at a time");
  digest = this;
}

FileDigest::~FileDigest() {
  const std::lock_guard lock(digesting);
  digest = nullptr;
}

std::string reasonOf(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "out of memory" : error.what();
}

std::string readFile(const std::filesystem::path& path, FileKind allowed, std::size_t longest) {
  constexpr unsigned kPiece = 1 << 18;
  const auto fail = [&](const std::string& reason) {
    throw Error(fmt::format("cannot read {}: {}", path.string(), reason), Failure::io);
  };

  // Nobody waits at a pipe that is about to be refused.
  const int wait = allowed == FileKind::any ? 0 : O_NONBLOCK;
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | wait);
  if (descriptor < 0) fail(std::strerror(errno));
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzdopen(descriptor, "rb"), &gzclose);
  if (!file) {
    close(descriptor);
    fail("out of memory");
  }
  gzbuffer(file.get(), kPiece / 4);  // pieces of a plain file go past it

  struct stat status {};
  if (fstat(descriptor, &status) != 0) fail(std::strerror(errno));
  const bool regular = S_ISREG(status.st_mode);
  if (S_ISDIR(status.st_mode) || (allowed == FileKind::regular && !regular))
    fail("it is not a file");

  longest = std::min(longest, halfOfMemory());
  const bool packed = gzdirect(file.get()) == 0;
  const auto size = regular ? static_cast<std::size_t>(status.st_size) : 0;
  std::string bytes;
  try {
    bytes.reserve(std::min(expectedSize(descriptor, size, packed), longest) + kPiece);
    int got = 0;
    do {
      const std::size_t length = bytes.size();
      if (length + kPiece > bytes.capacity())
        bytes.reserve(std::min(2 * bytes.capacity(), longest + kPiece));
      bytes.resize(length + kPiece);
      got = gzread(file.get(), bytes.data() + length, kPiece);
      bytes.resize(length + static_cast<std::size_t>(std::max(got, 0)));
      if (bytes.size() > longest)
        fail(fmt::format("it is longer than {:.0f} MiB{}", static_cast<double>(longest) / 0x1p20,
                         packed ? " when unpacked" : ""));
    } while (got == static_cast<int>(kPiece));
  } catch (const std::bad_alloc&) {
    fail("out of memory");
  }

  int code = Z_OK;
  gzerror(file.get(), &code);
  if (code == Z_ERRNO) fail(std::strerror(errno));
  if (code == Z_BUF_ERROR) fail("the packed data end too early");
  if (code < 0) fail("the packed data are damaged");
  if (bytes.size() < kPiece) bytes.shrink_to_fit();  // a scene may consist of many small files
  if (const std::lock_guard lock(digesting); digest != nullptr)
    digest->value_ = hashBytes(bytes, digest->value_);
  return bytes;
}

}  // namespace pbrt
