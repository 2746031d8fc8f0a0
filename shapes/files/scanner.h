#pragma once
// Words and numbers of a text, one after the other.

#include <string_view>

#include "input.h"

namespace pbrt::files {

constexpr bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}
constexpr bool isSpace(char c) {
  return isBlank(c) || c == '\n';
}

// ASCII letters made small.
std::string lowered(std::string_view text);

// Converts the number that begins at p and returns where it ends, or null if there is none. What
// is out of range is an infinity.
const char* convert(const char* p, const char* end, double& value);
const char* convert(const char* p, const char* end, float& value);

class Scanner {
 public:
  explicit Scanner(const Input& input)
      : input_(&input), p_(input.bytes().data()), end_(p_ + input.bytes().size()) {}

  // Skips white space. True: nothing follows.
  bool atEnd();
  // The next word. These throw Error at the end of the text and at what is not as wanted.
  std::string_view word();
  double number();
  std::size_t count();  // a whole number from 0
  // The rest of this line, without its end and the spaces before; the next line comes next.
  std::string_view line();
  // Skips blanks. True: nothing follows on this line.
  bool atLineEnd();
  // Goes to the next line; nothing but blanks may be left on this one.
  void endLine();

  // For the binary parts of a file.
  const char* position() const { return p_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - p_); }
  void skip(std::size_t bytes) { p_ += bytes; }  // <= left()

  [[noreturn]] void fail(std::string_view marked, const std::string& message) const {
    input_->failAtText(marked, message);
  }

 private:
  const Input* input_;
  const char* p_;
  const char* end_;
};

}  // namespace pbrt::files
