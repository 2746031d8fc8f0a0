#pragma once
// Scene text in, directives out (grammar in scene.y, tokens in scene.l).

#include <deque>
#include <filesystem>
#include <map>
#include <vector>

#include "core/parse/directive.h"

namespace pbrt {

// Reads scene files and keeps their text, into which the locations of the directives point.
// Not thread-safe; any number of parsers may work side by side.
class Parser {
 public:
  // With `passOver`, a file that cannot be included is reported there and left out.
  // With `frame`, each run of # in a quoted name or string becomes this number (numbered_name.h).
  explicit Parser(DirectiveSink sink, Reporter passOver = {}, std::optional<int> frame = {});

  // Parses a file, perhaps gzipped, and all that it includes: found relative to the including file
  // or, as in pbrt-v3, to the first one; at most 32 deep and 100000 in all; a file that includes
  // itself is an error. Only the first file may be a pipe. Throws Error: Failure::io if the first
  // file cannot be read, Failure::scene for everything in the text. What the sink throws passes
  // through, but for std::bad_alloc: that becomes an Error at the statement. The first error ends
  // the parse.
  void file(const std::filesystem::path& path);
  // Parses a text, e.g. standard input; includes are relative to `directory`.
  void text(std::string name, std::string text, const std::filesystem::path& directory = ".");

 private:
  // A file that is being read.
  struct Open {
    const Source& source;
    std::filesystem::path path;
  };

  // A file to include, and the path by which it was found.
  struct Included {
    const Source* source;
    std::filesystem::path path;
  };

  const Source& keep(std::string name, std::string text);
  Included find(const Location& quoted);
  void parse(const Source& source, std::filesystem::path path);
  void include(const Location& quoted);

  DirectiveSink sink_;
  Reporter passOver_;
  std::optional<int> frame_;
  std::deque<Source> sources_;  // addresses stay valid
  // By the path without links, as a file has many names.
  std::map<std::filesystem::path, const Source*> files_;
  std::vector<Open> open_;  // outermost first
  std::size_t includes_ = 0;
};

}  // namespace pbrt
