#include "frames.h"

#include <fmt/format.h>

#include <charconv>
#include <unordered_set>

#include "command.h"
#include "core/base/file.h"
#include "core/base/numbered_name.h"
#include "core/plugin/culprit.h"
#include "rendering.h"
#include "signals.h"
#include "status_line.h"

namespace pbrt {

namespace {

// The first number of `text`, which is moved on behind it. Empty if there is none.
std::optional<int> takeNumber(std::string_view& text) {
  int number = 0;
  if (text.empty() || text[0] < '0' || text[0] > '9') return {};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

struct Steps {
  int first = 0, last = 0, step = 1;
};

// "7", "1-240" or "1-240:10".
std::optional<Steps> readSteps(std::string_view text) {
  const auto first = takeNumber(text);
  if (!first) return {};
  Steps steps{*first, *first};
  const auto take = [&](char mark, int& value) {
    if (!text.starts_with(mark)) return true;
    text.remove_prefix(1);
    const auto number = takeNumber(text);
    value = number.value_or(0);
    return number.has_value();
  };
  const bool range = text.starts_with('-');
  if (!take('-', steps.last) || (range && !take(':', steps.step))) return {};
  const bool fine = text.empty() && steps.first <= steps.last && steps.step > 0;
  return fine ? std::optional(steps) : std::nullopt;
}

void setNumber(std::vector<std::string>& names, int number) {
  for (std::string& name : names) name = numbered(name, number);
}

Options optionsOf(const Options& all, int frame) {
  Options o = all;
  o.frame = frame;
  if (o.framesPerSecond > 0) o.build.time = frame / o.framesPerSecond;
  setNumber(o.files, frame);
  setNumber(o.outputs, frame);
  o.checkpoint = numbered(o.checkpoint, frame);
  o.build.folder = numbered(o.build.folder.string(), frame);
  renewReports(o);
  return o;
}

bool allThere(const std::vector<std::string>& files) {
  return std::ranges::all_of(files, [](const std::string& file) {
    std::error_code none;
    return std::filesystem::exists(file, none);
  });
}

// Whether two names with # can be those of one file.
bool mayBeSame(const std::string& a, const std::string& b) {
  const auto name = [](const std::string& pattern) {  // however long its runs of # are
    return std::filesystem::absolute(numbered(pattern, std::numeric_limits<int>::max()))
        .lexically_normal();
  };
  return name(a) == name(b);
}

// Whether the files that failed are those of the frame's scene, not its pictures.
bool sceneIsUnreadable(const Options& o) {
  try {
    for (const std::string& file : o.files) readFile(file);
    return false;
  } catch (const Error&) {
    return true;
  }
}

// The exit code of a frame, and whether those that follow would end the same way.
struct Outcome {
  int code = 0;
  bool last = false;
};

Outcome carryOut(const Options& o, const Command& command) {
  const auto fail = [&](const Error& error) {
    fmt::print("{}", failureLine(o.progress, error.what()));
    return tell(error);
  };
  try {
    try {
      PluginLoader loader(PluginLoader::searchPath(o.pluginPath));
      const int code = command(o, loader);
      return {code, code == kInterrupted};
    } catch (...) {
      std::rethrow_exception(asError());
    }
  } catch (const Error& error) {
    return {fail(error), error.failure() == Failure::io && !sceneIsUnreadable(o)};
  } catch (const std::bad_alloc&) {
    return {fail(Error("out of memory"))};
  }
}

}  // namespace

std::vector<int> readFrames(const std::string& text) {
  constexpr std::size_t kMost = 1000000;
  const auto refuse = [&](const std::string& reason) {
    throw Error(fmt::format("--frames {}: {}", shown(text), reason), Failure::usage);
  };
  std::vector<int> frames;
  std::unordered_set<int> seen;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const auto steps = readSteps(std::string_view(text).substr(begin, comma - begin));
    if (!steps) refuse("frames are written like 7, 1-240, 1-240:10 or 1-10,20, the first is 0");
    if (static_cast<std::size_t>((steps->last - steps->first) / steps->step) >=
        kMost - frames.size())
      refuse(fmt::format("these are more than {} frames", kMost));
    for (std::int64_t i = steps->first; i <= steps->last; i += steps->step)
      if (seen.insert(static_cast<int>(i)).second) frames.push_back(static_cast<int>(i));
    begin = comma + 1;
  }
  return frames;
}

void checkFrames(const Options& o) {
  const auto refuse = [](const std::string& message) { throw Error(message, Failure::usage); };
  if (o.frames.size() > 1 && std::ranges::find(o.files, "-") != o.files.end())
    refuse("standard input can be read for one frame only: --frames needs scene files");
  if (o.check || o.format) return;
  if (o.outputs.empty()) refuse("--frames needs --outfile with ####, such as out/####.exr");
  for (const std::string& output : o.outputs)
    if (numberRuns(output) == 0)
      refuse(fmt::format("--outfile {}: pictures of frames need a name with #, such as ####.exr",
                         shown(output)));
  if (!o.checkpoint.empty() && numberRuns(o.checkpoint) == 0)
    refuse(fmt::format("--checkpoint {}: each frame needs one of its own, such as ####.film",
                       shown(o.checkpoint)));
  // What has the name of a frame is whole, so that --skip-existing may trust it.
  for (const std::string& output : o.outputs)
    if (o.skipExisting && !o.checkpoint.empty() && mayBeSame(output, o.checkpoint))
      refuse(
          fmt::format("--skip-existing: {} may be there before its frame is whole, since it is "
                      "the checkpoint, too",
                      shown(output)));
  if (o.goal.interval)
    refuse("--write-every writes pictures that are not whole: not with --frames");
}

int forFrames(const Options& o, const Command& command) {
  int first = 0;
  std::size_t there = 0;
  std::vector<int> failed;
  for (const int number : o.frames) {
    const Options frame = optionsOf(o, number);
    if (o.skipExisting && !o.check && !o.format && allThere(frame.outputs)) {
      ++there;
      continue;
    }
    const auto [code, last] = carryOut(frame, command);
    if (code == kInterrupted) return code;
    // A signal that came while this frame was written, say, asks the run to end.
    if (Signals::interrupted() && number != o.frames.back()) {
      printError(fmt::format("interrupted after frame {}", number));
      return kInterrupted;
    }
    if (code != 0) failed.push_back(number);
    if (first == 0) first = code;
    if (last) break;
  }
  if (there > 0 && !o.quiet)
    printError(fmt::format("{} of {} frames were there already", there, o.frames.size()));
  if (!failed.empty() && o.frames.size() > 1)
    printError(fmt::format("{} of {} frames failed: {}", failed.size(), o.frames.size(),
                           fmt::join(failed, ", ")));
  return first;
}

}  // namespace pbrt
