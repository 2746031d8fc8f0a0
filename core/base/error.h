#pragma once
// What went wrong, where, and how it is shown: places in a scene's text, diagnostics with the
// quoted line and a caret, and the one exception type of the renderer.

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pbrt {

// A text that was read: its name as the user knows it, and its bytes. Outlives every Location
// that points into it.
struct Source {
  std::string name;
  std::string text;
};

// `length` bytes of a source from byte `begin`; nowhere if `source` is null.
// Line and column are worked out only when somebody asks.
struct Location {
  const Source* source = nullptr;
  std::size_t begin = 0;
  std::size_t length = 1;
};

enum class Severity : std::uint8_t { note, warning, error };

// One message, complete in itself: it holds copies, so it outlives the source.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string message;
  std::string file;             // empty: no place is known
  std::size_t line = 0;         // from 1
  std::size_t column = 0;       // from 1, in bytes
  std::size_t length = 0;       // of the marked text, in bytes, within the line
  std::string quote;            // the line (a window of it, if it is very long)
  std::size_t quoteColumn = 0;  // where the mark starts inside `quote`, from 0
};

Diagnostic diagnose(Severity severity, const Location& where, std::string message);

// "file:line:column: error: message", then the quoted line and a line with the caret.
// Ends without a newline.
std::string format(const Diagnostic& diagnostic);

// Receives warnings and notes as they arise. May be called from one thread at a time.
using Reporter = std::function<void(const Diagnostic&)>;

// What kind of thing failed; the values are the exit codes of the commands.
enum class Failure : std::uint8_t { usage = 2, scene = 3, io = 4, plugin = 5 };

// Carries one or more diagnostics to the command that prints them.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, Failure failure = Failure::scene);
  Error(const Location& where, const std::string& message, Failure failure = Failure::scene);
  explicit Error(std::vector<Diagnostic> diagnostics, Failure failure = Failure::scene);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  Failure failure() const { return failure_; }
  // Gives the place to those diagnostics that have none yet.
  Error at(const Location& where) const;

 private:
  std::vector<Diagnostic> diagnostics_;
  Failure failure_;
};

// A name for a message: cut if it is very long, longer than `most` bytes.
std::string shown(std::string_view name, std::size_t most = 60);

// The candidate that `name` was probably meant to be: within a third of its length in edits
// (insert, delete, replace, swap of neighbours; case is free). Empty if none is near.
std::string_view closest(std::string_view name, std::span<const std::string> candidates);

// `; did you mean "..."?` or nothing.
std::string didYouMean(std::string_view name, std::span<const std::string> candidates);

}  // namespace pbrt
