#pragma once
// Directives back to text: a scene in its normal form.

#include <string>

#include "core/parse/directive.h"

namespace pbrt {

// Prints one scene, statement after statement. What is printed parses to the same directives and is
// printed as it is: numbers have the shortest digits that read back to the same value. The names of
// types stay as they are, since they tell for which pbrt a scene is written. What Include and
// Import brought stands in their place, so that one file holds the scene. Comments are lost.
class Formatter {
 public:
  // The lines of a statement, the last ended too; indented within Begin and End. The text that the
  // directive came from must still be there.
  std::string print(const Directive& directive);

 private:
  std::size_t depth_ = 0;  // blocks that are open
};

}  // namespace pbrt
