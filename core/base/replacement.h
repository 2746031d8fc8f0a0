#pragma once
// Files that appear whole or not at all.

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>

namespace pbrt {

// The file that a path names, through links; the path itself if it is no link.
std::filesystem::path throughLinks(const std::filesystem::path& file);

// A new file in the folder of `target` that takes the target's place once it is complete, and
// vanishes if it never is. What fails throws std::exception with the reason alone; the caller names
// the file.
class Replacement {
 public:
  explicit Replacement(const std::filesystem::path& target);
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  ~Replacement();

  std::FILE* stream() { return stream_; }
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  std::FILE* stream_ = nullptr;
};

// Throws Error, Failure::io, if a file of this name could not be written: ask before long work.
void checkReplaceable(const std::filesystem::path& file);

// Writes a file, whole or not at all: `write` is given its open stream, and may throw. Throws
// Error, Failure::io, with the file's name and the reason.
void replaceFile(const std::filesystem::path& file, const std::function<void(std::FILE*)>& write);
// The same for bytes that are at hand.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace pbrt
