#pragma once
// What there is to say about a render that goes on, in the words of each style.

#include <optional>
#include <string>

namespace pbrt {

enum class ProgressStyle {
  automatic,  // bar, or none if the command is to be quiet
  bar,        // on a terminal a line that is redrawn, elsewhere a line now and then
  lines,      // the messages of Open Job Description, for render farms
  json,       // a JSON object a line
  none,
};

enum class Stage { rendering, done, interrupted };

struct ProgressState {
  Stage stage = Stage::rendering;
  std::optional<int> frame;         // of an animation
  double part = 0;                  // of the whole render, from 0 to 1
  double seconds = 0;               // since the rendering began
  std::optional<double> remaining;  // seconds; empty: not known yet
  double samplesPerPixel = 0;       // so far, on average
  double raysPerSecond = 0;
  std::optional<double> error;  // estimated, relative; empty: not known
};

// For people, in one line of at most `width` characters without control characters: as much as
// has room, the most important first. With `bar`, what is left of the line is a bar.
std::string statusText(const ProgressState& state, int width, bool bar);

// The message "openjd_progress: 42.5", and one for people, each a whole line. (Open Job Description
// "How Jobs Are Run", 2023.)
std::string jobLines(const ProgressState& state);

// A whole line. Its fields are stable: docs/long-renders.md describes them.
std::string jsonLine(const ProgressState& state);

// For standard output, a whole line: a picture was written.
std::string pictureLine(ProgressStyle style, const std::string& file);

// For standard output, a whole line: the command fails. Empty for styles that are for people.
std::string failureLine(ProgressStyle style, std::string message);

}  // namespace pbrt
