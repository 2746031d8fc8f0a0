#include "status_line.h"

#include <sys/ioctl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <string_view>

namespace pbrt {

namespace {

constexpr std::string_view kErase = "\r\x1b[K";

std::mutex mutex;
std::string status;

// In one piece, for several programs may write to one log. What cannot be written is lost: there is
// nowhere to say so.
void write(std::initializer_list<std::string_view> parts) {
  std::array<iovec, 4> pieces{};
  int n = 0;
  for (const std::string_view part : parts)
    pieces[static_cast<std::size_t>(n++)] = {const_cast<char*>(part.data()), part.size()};
  static_cast<void>(!writev(STDERR_FILENO, pieces.data(), n));
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
  write({kErase, text});
  status = text;
}

void printError(std::string_view line) noexcept {
  const std::lock_guard lock(mutex);
  if (status.empty())
    write({line, "\n"});
  else
    write({kErase, line, "\n", status});
}

}  // namespace pbrt
