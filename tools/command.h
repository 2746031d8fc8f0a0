#pragma once
// What all commands have in common: the command line, and the place where errors end.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "core/base/error.h"

namespace pbrt {

// Tells an error, and returns its exit code.
inline int tell(const Error& error) {
  for (const Diagnostic& d : error.diagnostics()) fmt::print(stderr, "{}\n", format(d));
  return static_cast<int>(error.failure());
}

// Parses the words of the command line (the last first, as CLI11 wants them), then calls body(),
// which returns the exit code. Errors are printed and become exit codes: those of Failure, 3 if
// memory is short, `bug` for what should not be.
template <class Body>
int runCommand(CLI::App& app, std::vector<std::string> words, Body body, int bug = 1) {
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(Failure::usage);
  }
  try {
    const int code = body();
    if (std::fflush(stdout) == 0) return code;
    fmt::print(stderr, "error: cannot write to standard output\n");
    return static_cast<int>(Failure::io);
  } catch (const Error& error) {
    return tell(error);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory\n");
    return static_cast<int>(Failure::scene);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) {
      fmt::print(stderr, "error: cannot write to standard output\n");
      return static_cast<int>(Failure::io);
    }
    fmt::print(stderr, "error: {} (this is a bug in {})\n", error.what(), app.get_name());
    return bug;
  }
}

// Finite and above 0. CLI11's own lets "nan" pass, and shows all digits of the largest double.
inline CLI::Validator positiveNumber() {
  return {[](std::string& text) {
            double value = 0;
            const bool fine = CLI::detail::lexical_cast(text, value) && value > 0;
            return fine && std::isfinite(value) ? "" : "must be a number above 0, not " + text;
          },
          "NUMBER"};
}

// The words after the command's name, the last first.
inline std::vector<std::string> reversedWords(int argc, char** argv) {
  return {std::reverse_iterator(argv + argc), std::reverse_iterator(argv + 1)};
}

}  // namespace pbrt
