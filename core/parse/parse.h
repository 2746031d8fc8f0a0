#pragma once
// Scene text in, directives out (grammar in scene.y, tokens in scene.l).

#include <deque>
#include <filesystem>
#include <vector>

#include "core/parse/directive.h"

namespace pbrt {

// Reads scene files and keeps their text, into which the locations of the directives point.
// Not thread-safe; any number of parsers may work side by side.
class Parser {
 public:
  explicit Parser(DirectiveSink sink) : sink_(std::move(sink)) {}

  // Parses a file and all that it includes: found relative to the including file or, as in
  // pbrt-v3, to the first one; at most 32 deep; a file that includes itself is an error. Throws
  // Error: Failure::io if the first file cannot be read, Failure::scene for everything in the
  // text. What the sink throws passes through. The first error ends the parse.
  void file(const std::filesystem::path& path);
  // Parses a text, e.g. standard input; includes are relative to `directory`.
  void text(std::string name, std::string text, const std::filesystem::path& directory = ".");

 private:
  void parse(std::string name, std::string text, std::filesystem::path path);
  void include(const Location& quoted);

  DirectiveSink sink_;
  std::deque<Source> sources_;               // addresses stay valid
  std::vector<std::filesystem::path> open_;  // being read now, outermost first
};

}  // namespace pbrt
