#pragma once
// What all commands have in common: the command line, and the place where errors end.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "core/base/error.h"
#include "core/base/memory_limit.h"

namespace pbrt {

// Before anything else. A standard stream that is closed is opened, for the wrong direction, so
// that its use fails: else the next file, a picture perhaps, would get its number and its messages.
// Where nobody reads, or a file may not grow, writing fails instead of ending the process by a
// signal.
inline void settle() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0)  // open() takes the lowest number that is free
      static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

// Nobody who listens is no failure: fmt::print would throw.
inline void complain(const std::string& line) {
  std::fputs((line + "\n").c_str(), stderr);
}

// What a command does whose results cannot be written: if their reader has left, it ends as by
// default, without a word.
inline int outputFailed(int reason) {
  if (reason == EPIPE) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  complain(fmt::format("error: cannot write to standard output: {}",
                       std::generic_category().message(reason)));
  return static_cast<int>(Failure::io);
}

// Tells an error, and returns its exit code.
inline int tell(const Error& error) {
  for (const Diagnostic& d : error.diagnostics()) complain(format(d));
  return static_cast<int>(error.failure());
}

// Parses the words of the command line (the last first, as CLI11 wants them), then calls body(),
// which returns the exit code. Errors are printed and become exit codes: those of Failure, 3 if
// memory is short, 4 if the system refuses something, `bug` for what should not be.
template <class Body>
int runCommand(CLI::App& app, std::vector<std::string> words, Body body, int bug = 1) {
  settle();
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(Failure::usage);
  }
  try {
    const int code = body();
    return std::fflush(stdout) == 0 ? code : outputFailed(errno);
  } catch (const Error& error) {
    return tell(error);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "error: out of memory: there is room for %.1f GiB\n",
                 static_cast<double>(memoryLimit()) / 0x1p30);
    return static_cast<int>(Failure::scene);
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0) return outputFailed(error.code().value());
    complain(fmt::format("error: {}", error.what()));
    return static_cast<int>(Failure::io);
  } catch (const std::exception& error) {
    complain(fmt::format("error: {} (this is a bug in {})", error.what(), app.get_name()));
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
