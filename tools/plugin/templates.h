#pragma once
// The files of a new project, kept in the program: templates/*.in.

#include <span>
#include <string_view>

namespace pbrt {

struct Template {
  std::string_view name;  // of the file, such as shape.cpp or CMakeLists.txt
  std::string_view text;  // with places to fill in, such as @NAME@
};
std::span<const Template> templates();

}  // namespace pbrt
