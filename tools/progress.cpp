#include "progress.h"

#include <algorithm>
#include <cstdio>

#include "status_line.h"

namespace pbrt {

Progress::Progress(ProgressStyle style, const RenderControl& control, int pixels,
                   std::uint32_t firstSample, std::uint64_t samplesThere, std::optional<int> frame)
    : style_(style),
      control_(control),
      pixels_(pixels),
      firstSample_(firstSample),
      samplesThere_(static_cast<double>(samplesThere)),
      pass_{firstSample, firstSample} {
  state_.frame = frame;
  if (style != ProgressStyle::none) thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
  if (hasStatusLine()) showStatus("");
}

void Progress::next(const Passes::Pass& pass) {
  const std::lock_guard lock(mutex_);
  pass_ = pass;
}

void Progress::begin() {
  const std::lock_guard lock(mutex_);
  begun_ = true;
  resting_ = false;
}

void Progress::rest() {
  const std::lock_guard lock(mutex_);
  look();
  resting_ = true;
  rate_.rest();
}

void Progress::error(double error) {
  const std::lock_guard lock(mutex_);
  state_.error = error;
}

void Progress::end(Stage stage) {
  const std::lock_guard lock(mutex_);
  ProgressState state = look();
  state.stage = stage;
  if (stage == Stage::done) state.part = 1, state.remaining = 0;
  ended_ = true;
  nextReport_ = 0;
  if (style_ == ProgressStyle::lines || style_ == ProgressStyle::json) show(state);
}

void Progress::run() {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, 100ms, [this] { return ended_; }))
    if (begun_) show(look());
}

ProgressState Progress::look() {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const auto taken = static_cast<double>(control_.samplesDone);
  if (!resting_) rate_.add(seconds, taken);
  const double whole = pixels_ * (pass_.end - pass_.first);
  const double samples = samplesThere_ + taken;
  const double there = std::min(samples - pixels_ * (pass_.first - firstSample_), whole);
  const double ofPass = whole > 0 ? there / whole : 0;
  state_.part = pass_.from + (pass_.to - pass_.from) * ofPass;
  state_.seconds = seconds;
  // This pass is the part to - from of the whole.
  const double later = pass_.to > pass_.from ? whole * (1 - pass_.to) / (pass_.to - pass_.from) : 0;
  state_.remaining = rate_.remaining(whole - there + later);
  state_.samplesPerPixel = samples / pixels_;
  state_.raysPerSecond = static_cast<double>(control_.rays) / std::max(seconds, 1e-3);
  return state_;
}

void Progress::show(const ProgressState& state) {
  if (style_ == ProgressStyle::bar && hasStatusLine()) {
    showStatus(statusText(state, statusWidth(), true));
    return;
  }
  if (style_ == ProgressStyle::bar) {
    // In a log, a line after 10, 20, 40, ... seconds is enough.
    if (nextReport_ == 0) nextReport_ = 10;
    if (state.seconds < nextReport_) return;
    nextReport_ = 2 * state.seconds;
    printError(statusText(state, 200, false));
    return;
  }
  if (state.seconds < nextReport_) return;
  nextReport_ = state.seconds + 1;
  const std::string text = style_ == ProgressStyle::json ? jsonLine(state) : jobLines(state);
  // The jobs of a week would fill a log with the same percentage.
  std::string percentage = text.substr(0, text.find('\n'));
  if (percentage == percentage_ && state.stage == Stage::rendering) return;
  percentage_ = std::move(percentage);
  // A failure stays with the stream, and is told at the end (runCommand).
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

}  // namespace pbrt
