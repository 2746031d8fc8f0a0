#include "progress_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace pbrt {

namespace {

using Json = nlohmann::ordered_json;

std::string line(const Json& json) {
  // A file's name may be any bytes, JSON is UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

const char* name(Stage stage) {
  switch (stage) {
    case Stage::rendering:
      return "rendering";
    case Stage::done:
      return "done";
    case Stage::interrupted:
      return "interrupted";
  }
  return "";
}

// 12.3 s, 3m 05s, 2h 05m, 40d 02h
std::string duration(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  if (seconds < 3599.5) {
    const auto whole = static_cast<int>(seconds + 0.5);
    return fmt::format("{}m {:02}s", whole / 60, whole % 60);
  }
  const double minutes = std::floor(seconds / 60 + 0.5);
  if (minutes < 60 * 24)
    return fmt::format("{:.0f}h {:02.0f}m", std::floor(minutes / 60), std::fmod(minutes, 60));
  const double hours = std::floor(seconds / 3600 + 0.5);
  return fmt::format("{:.0f}d {:02.0f}h", std::floor(hours / 24), std::fmod(hours, 24));
}

// In one line of a log, and nothing that a terminal obeys.
std::string withoutControls(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; }, '?');
  return text;
}

}  // namespace

std::string statusText(const ProgressState& s, int width, bool bar) {
  std::string text = fmt::format("{:3.0f} %", std::floor(100 * s.part));
  if (s.frame) text = fmt::format("frame {} {}", *s.frame, text);
  const auto room = static_cast<std::size_t>(std::max(width, 0));
  const auto add = [&](const std::string& more) {
    if (text.size() + 2 + more.size() <= room) text += "  " + more;
  };
  add(fmt::format("{} remaining", s.remaining ? duration(*s.remaining) : "--"));
  add(fmt::format("{} elapsed", duration(s.seconds)));
  if (s.error) add(fmt::format("error about {:.2g}", *s.error));
  add(fmt::format("{:.2f} Mrays/s", s.raysPerSecond / 1e6));
  text.resize(std::min(text.size(), room));
  constexpr std::size_t kLeast = 10, kMost = 20;  // characters of a bar
  if (!bar || room < text.size() + kLeast + 3) return text;
  const std::size_t length = std::min(room - text.size() - 3, kMost);
  const auto filled = static_cast<std::size_t>(static_cast<double>(length) * s.part);
  return fmt::format("[{:#<{}}{:<{}}] {}", "", filled, "", length - filled, text);
}

std::string jobLines(const ProgressState& s) {
  const std::string frame = s.frame ? fmt::format("frame {}: ", *s.frame) : "";
  std::string status = name(s.stage);
  if (s.stage == Stage::rendering && s.remaining)
    status += fmt::format(", {} remaining", duration(*s.remaining));
  if (s.error) status += fmt::format(", error about {:.2g}", *s.error);
  return fmt::format("openjd_progress: {:.1f}\nopenjd_status: {}{}\n",
                     std::floor(1000 * s.part) / 10, frame, status);
}

std::string jsonLine(const ProgressState& s) {
  return line(Json{{"state", name(s.stage)},
                   {"frame", orNull(s.frame)},
                   {"part", s.part},
                   {"seconds", s.seconds},
                   {"remaining", orNull(s.remaining)},
                   {"samplesPerPixel", s.samplesPerPixel},
                   {"raysPerSecond", s.raysPerSecond},
                   {"error", orNull(s.error)}});
}

std::string pictureLine(ProgressStyle style, const std::string& file) {
  switch (style) {
    case ProgressStyle::lines:
      return fmt::format("openjd_status: wrote {}\n", withoutControls(file));
    case ProgressStyle::json:
      return line(Json{{"state", "wrote"}, {"file", file}});
    default:
      return file + '\n';
  }
}

std::string failureLine(ProgressStyle style, std::string message) {
  if (style == ProgressStyle::json) return line(Json{{"state", "failed"}, {"message", message}});
  if (style != ProgressStyle::lines) return "";
  std::ranges::replace(message, '\n', ' ');
  return fmt::format("openjd_fail: {}\n", withoutControls(std::move(message)));
}

}  // namespace pbrt
