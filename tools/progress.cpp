#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace pbrt {

Progress::Progress(const RenderControl& control, int tiles)
    : control_(control), tiles_(tiles), terminal_(isatty(STDERR_FILENO) != 0) {
  thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Progress::begin(double from, double to, std::optional<double> error) {
  const std::lock_guard lock(mutex_);
  tilesBefore_ = control_.tilesDone;
  from_ = from;
  to_ = to;
  error_ = error;
}

void Progress::run() {
  using namespace std::chrono_literals;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, 100ms, [this] { return done_; })) show(seconds(), false);
  show(seconds(), true);
}

void Progress::show(double seconds, bool last) {
  const double ofPass =
      static_cast<double>(control_.tilesDone - tilesBefore_) / std::max(1, tiles_);
  const double part = from_ + (to_ - from_) * ofPass;
  const double raysPerSecond = static_cast<double>(control_.rays) / std::max(seconds, 1e-6);
  const double remaining = part > 0 ? seconds * (1 - part) / part : 0;
  std::string text = fmt::format("{:3.0f} %  {:.1f} s elapsed, {:.1f} s remaining, {:.2f} Mrays/s",
                                 100 * part, seconds, remaining, raysPerSecond / 1e6);
  if (error_) text += fmt::format(", error about {:.2g}", *error_);
  if (terminal_) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(kWidth * part);
    fmt::print(stderr, "\r[{:#<{}}{:<{}}] {}\x1b[K", "", filled, "", kWidth - filled, text);
    if (last) fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
    return;
  }
  // In a log, a line after 1, 2, 4, ... ten-second steps is enough.
  if (last || seconds < 10.0 * (1 << std::min(linesShown_, 20))) return;
  ++linesShown_;
  fmt::print(stderr, "{}\n", text);
}

}  // namespace pbrt
