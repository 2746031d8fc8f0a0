#pragma once
// The command line of pbrt.

#include <CLI/CLI.hpp>

#include "core/scene/builder.h"
#include "passes.h"
#include "progress_state.h"
#include "reports.h"

namespace pbrt {

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> outputs;
  std::optional<std::string> frameList;
  std::vector<int> frames;     // of an animation; for each there are options of its own, with
  std::optional<int> frame;    // its number, which is in all names by then
  double framesPerSecond = 0;  // by which the scene's time goes on; 0: it stands still
  bool skipExisting = false;
  BuildOptions build;
  std::string dialect;
  std::vector<float> cropWindow;
  std::vector<int> pixelBounds;
  int samplesPerPixel = 0;
  std::string samples;
  std::vector<std::string> aovs;
  AovSet aovSet = 0;
  Goal goal;                    // see goalOf()
  std::string checkpoint;       // film file; empty: none
  double checkpointEvery = 60;  // seconds
  bool resume = false;
  bool quiet = false;
  ProgressStyle progress = ProgressStyle::automatic;  // finishOptions() decides
  bool stats = false;
  bool strict = false;
  std::string logLevel = "warning";
  bool check = false;
  bool format = false;
  bool permissive = false;
  std::shared_ptr<Reports> reports;  // where build.report goes
  std::string pluginPath;
  bool listPlugins = false;
  std::vector<std::string> describe;
};

// Defines the command line; what it reads lands in `o`.
void defineOptions(CLI::App& app, Options& o);

// The words of the command line, the last first as CLI11 wants them. pbrt-v4 writes a window as
// x0,x1,y0,y1, perhaps after an equals sign; it becomes the four words that pbrt-v3 has.
std::vector<std::string> words(int argc, char** argv);

// What the words mean once all are read. Throws Error, Failure::usage.
void finishOptions(Options& o);

// Reports of `o` begin anew: nothing has been told or counted.
void renewReports(Options& o);

// When the render ends. Where the command line names no samples, they are the scene's, or any
// number if time or error end it.
Goal goalOf(const Options& o, int samplesPerPixel);

}  // namespace pbrt
