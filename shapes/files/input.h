#pragma once
// A data file in memory, and the errors that name a place in it.

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace pbrt::files {

class Input {
 public:
  // The whole file, unpacked if it is gzipped. Throws Error, Failure::io.
  explicit Input(const std::filesystem::path& file);
  Input(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

  const std::string& name() const { return name_; }
  std::string_view bytes() const { return bytes_; }

  // Throw Error: about the file as a whole, about its bytes from `at` on, about `marked`, which is
  // a part of a line of its text.
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void failAtByte(const char* at, const std::string& message) const;
  [[noreturn]] void failAtText(std::string_view marked, const std::string& message) const;

 private:
  std::string name_;
  std::string bytes_;
};

}  // namespace pbrt::files
