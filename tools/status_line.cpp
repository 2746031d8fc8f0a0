#include "status_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string_view>

namespace pbrt {

namespace {

constexpr const char* kErase = "\r\x1b[K";

std::mutex mutex;
std::string status;

// In one piece. What cannot be written is lost: there is nowhere to say so.
void write(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

bool hasStatusLine() {
  const char* const terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && terminal && *terminal &&
         terminal != std::string_view("dumb");
}

int statusWidth() {
  int width = 0;
  if (const char* const columns = std::getenv("COLUMNS")) {
    const std::string_view text = columns;
    std::from_chars(text.data(), text.data() + text.size(), width);
  }
  if (winsize size{}; width <= 0 && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0)
    width = size.ws_col;
  return (width > 0 ? width : 80) - 1;
}

void showStatus(const std::string& text) {
  const std::lock_guard lock(mutex);
  if (text == status) return;
  write(kErase + text);
  status = text;
}

void printError(const std::string& line) {
  const std::lock_guard lock(mutex);
  write(status.empty() ? line + '\n' : kErase + line + '\n' + status);
}

}  // namespace pbrt
