#pragma once
// The statement that is being read. The grammar fills it in, piece by piece.

#include "core/parse/directive.h"
#include "core/parse/parameter.h"

namespace pbrt {

constexpr const char* kNoMemory = "out of memory";

class Statement {
 public:
  // The sink outlives it.
  explicit Statement(const DirectiveSink& sink) : sink_(sink) {}

  void name(const Location& quoted);
  // The word after ActiveTransform.
  void time(const Location& word);

  // A value is one list of numbers, or some items and then their place with the brackets.
  void list(const Location& where);
  void item(const Location& where) { value_.items.push_back(where); }
  void items(const Location& where) { value_.where = where; }

  // What the last value is for: a parameter, the one of Option, or the numbers of a transform.
  void parameter(const Location& declaration);
  void option(const Location& declaration);
  void numbers(DirectiveKind kind, const Location& keyword);

  // Hands the statement over; another may begin.
  void end(DirectiveKind kind, const Location& keyword);

 private:
  void add(Param param);

  const DirectiveSink& sink_;
  Directive directive_;
  Value value_;
  std::vector<double> numbers_;
};

}  // namespace pbrt
