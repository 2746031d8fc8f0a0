#pragma once
// How files that a scene names are read: the one place that opens them, for reading alone.

#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>

namespace pbrt {

// What may be read. Pipes and devices may never end or wait for ever, so only those may be read
// that the user names on the command line, as in `pbrt <(generate)`.
enum class FileKind : std::uint8_t { regular, any };

// Longer files are refused; geometry of that size belongs in binary files of its own. So the
// numbers of a text can be counted in an int, and a gzipped file can state its true length.
constexpr std::size_t kLongestFile = std::size_t{4} << 30;

// What an exception says, for messages: that memory is short has no words of its own.
std::string reasonOf(const std::exception& error);

// All bytes of a file, unpacked if it is gzipped (told by its first bytes; RFC 1952). Throws Error,
// Failure::io: it cannot be opened or read, is of the wrong kind, is damaged, or would be longer
// than `longest` or halfOfMemory(), so that a few packed bytes cannot fill it.
std::string readFile(const std::filesystem::path& path, FileKind allowed = FileKind::regular,
                     std::size_t longest = kLongestFile);

// Hashes all bytes that readFile() returns while it lives, in their order: what two scenes were
// built from is the same if this is. Neither the names of the files count (who names a file is
// itself read) nor their folders or times. One at a time; outside of it nothing is hashed.
class FileDigest {
 public:
  // Throws std::logic_error if there is another.
  FileDigest();
  ~FileDigest();
  FileDigest(const FileDigest&) = delete;
  FileDigest& operator=(const FileDigest&) = delete;

  std::uint64_t value() const { return value_; }

 private:
  friend std::string readFile(const std::filesystem::path&, FileKind, std::size_t);

  std::uint64_t value_ = 0;
};

}  // namespace pbrt
