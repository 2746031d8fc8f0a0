#pragma once
// Files that appear whole or not at all.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>

namespace pbrt {

// The file that a path names, through links; the path itself if it is no link.
std::filesystem::path throughLinks(const std::filesystem::path& file);

// How much has happened when a file has taken its place.
enum class Durability : std::uint8_t {
  cached,  // the system knows it: it outlives the process
  onDisk,  // it outlives a loss of power
};

// A new file in the folder of `target` that takes the target's place once it is complete, and
// vanishes if it never is. At every moment the target is the old file or the new one. What fails
// throws std::exception with the reason alone; the caller names the file.
//
// The new file has no name before it is complete, where the file system can have that (O_TMPFILE;
// NFS cannot), so that nothing is left of a process that was killed. Where something may be left
// (".pbrt-*.tmp"), the next write of the same target removes it: a file that nobody holds a lock
// on belongs to nobody.
class Replacement {
 public:
  explicit Replacement(const std::filesystem::path& target);
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  ~Replacement();

  std::FILE* stream() { return stream_; }
  void commit(Durability durability = Durability::cached);

 private:
  bool openNameless(const std::filesystem::path& folder);
  void openNamed();
  void giveName();
  void release();

  std::filesystem::path target_;
  std::filesystem::path temporary_;  // its name so far; empty if it has none
  int descriptor_ = -1;              // holds the lock to the end
  std::FILE* stream_ = nullptr;      // of a copy of the descriptor
};

// Throws Error, Failure::io, if a file of this name could not be written: ask before long work.
void checkReplaceable(const std::filesystem::path& file);

// Writes a file, whole or not at all: `write` is given its open stream, and may throw. Throws
// Error, Failure::io, with the file's name and the reason.
void replaceFile(const std::filesystem::path& file, const std::function<void(std::FILE*)>& write);
// The same for bytes that are at hand.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace pbrt
