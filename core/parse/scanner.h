#pragma once
// Between the generated scanner (scene.l) and the generated parser (scene.y).

#include "core/parse/directive.h"
#include "parse/scene.tab.h"

namespace pbrt {

// Splits one source into tokens; the source outlives it.
class Scanner {
 public:
  explicit Scanner(const Source& source);
  ~Scanner();
  Scanner(const Scanner&) = delete;
  Scanner& operator=(const Scanner&) = delete;

  // The kind of the next token, of SceneParser::token. Throws Error at what is none.
  int next() { return scan(flex_); }
  // For flex: copies the text that comes next, up to `size` bytes; returns how many.
  std::size_t fill(char* window, std::size_t size);

  Location token;                                // the last one
  DirectiveKind kind = DirectiveKind::Identity;  // of a keyword
  // The last of their kind, for messages about what is missing after them; and the keyword of the
  // statement before.
  Location keyword, keywordBefore, bracket, string;

 private:
  int scan(void* yyscanner);  // written by flex
  int word(std::string_view text);

  void advance(std::size_t length);  // makes the next bytes the token

  const Source& source_;
  std::size_t end_ = 0;     // of the token
  std::size_t filled_ = 0;  // up to here flex was given the text
  void* flex_ = nullptr;
};

}  // namespace pbrt
