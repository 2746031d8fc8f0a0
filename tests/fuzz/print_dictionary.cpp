// Prints the dictionary as libFuzzer and AFL++ read it.

#include <fmt/format.h>

#include "tests/fuzz/dictionary.h"

int main() {
  for (const std::string& word : pbrt::fuzz::dictionary()) {
    std::string escaped;
    for (const char c : word)
      if (c == '\n')
        escaped += "\\x0a";
      else
        escaped += c == '"' ? "\\\"" : std::string(1, c);
    fmt::print("\"{}\"\n", escaped);
  }
}
