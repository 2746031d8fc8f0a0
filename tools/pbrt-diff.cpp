// The command that compares two pictures.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "tools/command.h"
#include "tools/compare/colormap.h"
#include "tools/compare/difference.h"
#include "tools/compare/flip.h"
#include "tools/compare/metrics.h"
#include "tools/compare/ztest.h"

namespace pbrt {
namespace {

struct Options {
  std::string reference, test;
  std::optional<double> maxRmse, maxRelMse, maxMae, maxFlip, maxAbs;
  bool statistical = false;
  double alpha = 1e-3;
  bool hdrFlip = false;
  std::vector<std::string> ignoredChannels;
  bool ignoreMetadata = false, strictMetadata = false;
  std::string image;
  bool json = false, quiet = false;

  bool hasLimits() const { return maxRmse || maxRelMse || maxMae || maxFlip || maxAbs; }
};

// What was found; what could not be worked out is empty.
struct Comparison {
  Image reference, test;
  Findings findings;
  std::vector<ChannelDifference> channels;
  std::optional<Errors> errors;
  std::optional<FlipMap> flip;
  std::optional<ZTest> zTest;
};

void defineOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", "pbrt-diff " PBRT_VERSION);
  app.add_option("reference", o.reference, "The picture that is right (.exr)")->required();
  app.add_option("test", o.test, "The picture to judge (.exr)")->required();
  const char* const limits = "Limits (over R, G, B; what is at the limit is the same)";
  app.add_option("--max-rmse", o.maxRmse, "Root of the mean squared error")

      ->group(limits);
  app.add_option("--max-relmse", o.maxRelMse,
                 "Mean of (test - reference)^2 / (reference^2 + 0.01), less the largest 0.1 %")

      ->group(limits);
  app.add_option("--max-mae", o.maxMae, "Mean absolute error")->group(limits);
  app.add_option("--max-flip", o.maxFlip, "Mean FLIP error, from 0 to 1")

      ->group(limits);
  app.add_option("--max-abs", o.maxAbs, "Largest absolute error")->group(limits);
  app.add_flag("--statistical", o.statistical,
               "Different if noise does not explain it: needs the channels Variance.* in one "
               "picture at least");
  app.add_option("--alpha", o.alpha, "Chance of a false alarm of --statistical (default 0.001)");
  app.add_flag("--hdr-flip", o.hdrFlip, "FLIP over all exposures instead of exposure 0");
  app.add_option("--ignore-channels", o.ignoredChannels,
                 "Channels or layers to leave out: A,Variance,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  auto* ignore = app.add_flag("--ignore-metadata", o.ignoreMetadata, "Say nothing of metadata");
  app.add_flag("--strict-metadata", o.strictMetadata,
               "Unlike metadata is a difference (but for time, seed, scene's name, software, date)")
      ->excludes(ignore);
  app.add_option("--image", o.image,
                 "Where to write an error picture: .png, a map of FLIP; .exr, test - reference");
  app.add_flag("--json", o.json, "Print the result as JSON; null: not there, or not finite");
  app.add_flag("--quiet", o.quiet, "Say nothing but errors; the exit code tells");
  app.footer(
      "Without limits and --statistical, pictures are the same if all values of all channels are "
      "equal bit by bit. Values that are not finite, unlike sizes and missing channels always make "
      "pictures different; metadata is compared but counts only if --strict-metadata.\n"
      "Exit codes: 0 same, 1 different, 2 usage, 4 a file cannot be read or written.");
}

Comparison compare(const Options& o) {
  Comparison c;
  c.reference = withoutChannels(readExr(o.reference), o.ignoredChannels);
  c.test = withoutChannels(readExr(o.test), o.ignoredChannels);
  compareLayout(c.reference, c.test, o.statistical, c.findings);
  findNonFinite(c.reference, "reference", c.findings);
  findNonFinite(c.test, "test", c.findings);
  if (!o.ignoreMetadata) compareMetadata(c.reference, c.test, o.strictMetadata, c.findings);
  if (c.reference.window != c.test.window || c.reference.window.empty()) return c;
  c.channels = compareChannels(c.reference, c.test);
  c.zTest = zTest(c.reference, c.test, o.alpha);
  for (const char* name : {"R", "G", "B"})
    if (!c.reference.channel(name) || !c.test.channel(name)) return c;
  c.errors = measureErrors(c.reference, c.test);
  c.flip = o.hdrFlip ? flipHdr(c.reference, c.test) : flip(c.reference, c.test);
  return c;
}

std::string blockName(int size) {
  return size == 0 ? "whole picture" : size == 1 ? "pixels" : fmt::format("{0} x {0} pixels", size);
}

// Adds what the options call a difference.
void judge(const Options& o, Comparison& c) {
  std::vector<std::string>& failures = c.findings.failures;
  if (!failures.empty() && c.channels.empty()) return;  // nothing to compare
  if (o.hasLimits() && !c.errors)
    throw Error("limits need pictures with channels R, G and B", Failure::usage);
  const auto hold = [&](const char* what, double value, const std::optional<double>& limit) {
    if (limit && !(value <= *limit))
      failures.push_back(fmt::format("{} is {:.6g}, above {:.6g}", what, value, *limit));
  };
  if (o.hasLimits()) {
    hold("RMSE", c.errors->rmse, o.maxRmse);
    hold("relMSE", c.errors->relMse, o.maxRelMse);
    hold("MAE", c.errors->mae, o.maxMae);
    hold("the largest error", c.errors->largest, o.maxAbs);
    hold("the mean of FLIP", c.flip->mean, o.maxFlip);
  }
  if (o.statistical) {
    if (!c.zTest)
      throw Error(
          "neither picture states its variance: channels Variance.*, from 2 samples per pixel",
          Failure::usage);
    for (const ZScale& s : c.zTest->scales)
      if (!s.failures.empty())
        failures.push_back(
            fmt::format("noise does not explain the difference, {}: {} of {} fail, the worst z = "
                        "{:.3g} at ({}, {}) in {}",
                        blockName(s.size), s.failures.size(), s.n, s.worst.z, s.worst.corner.x,
                        s.worst.corner.y, c.zTest->channels[s.worst.channel]));
  }
  if (o.hasLimits() || o.statistical) return;
  for (const ChannelDifference& d : c.channels)
    if (d.differing)
      failures.push_back(fmt::format(
          "channel {}: {} of {} values differ, by {:.6g} at most; the first at pixel "
          "({}, {})",
          d.name, d.differing, c.reference.channels[0].size(), d.largest, d.first.x, d.first.y));
}

void writeErrorImage(const Options& o, const Comparison& c) {
  if (c.channels.empty()) return;  // said as a failure
  // checkWritable let no other suffixes pass than .exr and .png, in either case.
  const char suffix = std::filesystem::path(o.image).extension().string()[1];
  if (suffix == 'e' || suffix == 'E') {
    writeImage(o.image, signedDifference(c.reference, c.test));
  } else if (c.flip) {
    writeImage(o.image,
               heatMap(c.flip->values, c.reference.window.width(), c.reference.window.height()));
  } else {
    throw Error("a map of FLIP needs pictures with channels R, G and B", Failure::usage);
  }
}

void printPicture(const char* whose, const std::string& file, const Image& image) {
  fmt::print("{:<10} {}: {} x {} pixels; {}\n", whose, file, image.window.width(),
             image.window.height(), fmt::join(image.names, " "));
}

void printTable(const Options& o, const Comparison& c) {
  printPicture("reference", o.reference, c.reference);
  printPicture("test", o.test, c.test);
  if (const auto& e = c.errors) {
    fmt::print("\n{:<10} {:.6g}\n{:<10} {:.6g}\n{:<10} {:.6g}\n{:<10} {:.6g}\n", "MSE", e->mse,
               "RMSE", e->rmse, "relMSE", e->relMse, "MAE", e->mae);
    fmt::print("{:<10} {:.6g} at pixel ({}, {})\n", "largest", e->largest, e->largestPixel.x,
               e->largestPixel.y);
    fmt::print("{:<10} {:.6g} ({})\n", "FLIP", c.flip->mean, o.hdrFlip ? "HDR" : "LDR");
    fmt::print("{:<10} {:.6g} reference, {:.6g} test\n", "mean", e->meanReference, e->meanTest);
  }
  if (const auto& z = c.zTest) {
    fmt::print("\n{:<16} {:>8} {:>8} {:>10} {:>6}\n", "z-test", "tests", "|z| > 3", "worst z",
               "fail");
    for (const ZScale& s : z->scales)
      if (s.n)
        fmt::print("{:<16} {:>8} {:>7.2f}% {:>10.3g} {:>6}\n", blockName(s.size), s.n,
                   100 * s.beyond3, s.worst.z, s.failures.size());
    if (z->referenceIsExact)
      fmt::print("The reference states no variance: it is taken as exact.\n");
    if (z->testIsExact) fmt::print("The test states no variance: it is taken as exact.\n");
  }
  fmt::print("\n");
  for (const std::string& note : c.findings.notes) fmt::print("note: {}\n", note);
  for (const std::string& failure : c.findings.failures) fmt::print("different: {}\n", failure);
  if (c.findings.failures.empty()) fmt::print("same\n");
}

void printJson(const Options& o, const Comparison& c) {
  using Json = nlohmann::ordered_json;
  const auto pixel = [](Point2i p) { return Json::array({p.x, p.y}); };
  Json j{{"same", c.findings.failures.empty()},
         {"reference", o.reference},
         {"test", o.test},
         {"differences", c.findings.failures},
         {"notes", c.findings.notes},
         {"channels", Json::array()},
         {"errors", nullptr},
         {"zTest", nullptr}};
  for (const ChannelDifference& d : c.channels) {
    Json channel{{"name", d.name}, {"differing", d.differing}, {"largest", d.largest}};
    if (d.differing) channel["first"] = pixel(d.first);
    j["channels"].push_back(std::move(channel));
  }
  if (const auto& e = c.errors)
    j["errors"] = {{"mse", e->mse},
                   {"rmse", e->rmse},
                   {"relMse", e->relMse},
                   {"mae", e->mae},
                   {"largest", e->largest},
                   {"largestPixel", pixel(e->largestPixel)},
                   {o.hdrFlip ? "hdrFlip" : "flip", c.flip->mean},
                   {"meanReference", e->meanReference},
                   {"meanTest", e->meanTest}};
  if (const auto& z = c.zTest) {
    j["zTest"] = {{"alpha", o.alpha},
                  {"agree", z->agree()},
                  {"referenceIsExact", z->referenceIsExact},
                  {"testIsExact", z->testIsExact},
                  {"scales", Json::array()}};
    for (const ZScale& s : z->scales)
      j["zTest"]["scales"].push_back({{"size", s.size},
                                      {"tests", s.n},
                                      {"beyond3", s.beyond3},
                                      {"failures", s.failures.size()},
                                      {"worstZ", s.worst.z},
                                      {"worstCorner", pixel(s.worst.corner)},
                                      {"worstChannel", z->channels[s.worst.channel]}});
  }
  // A file's name need not be UTF-8.
  fmt::print("{}\n", j.dump(2, ' ', false, Json::error_handler_t::replace));
}

int run(const Options& o) {
  for (const auto& limit : {o.maxRmse, o.maxRelMse, o.maxMae, o.maxFlip, o.maxAbs})
    if (limit && !(*limit >= 0 && *limit < kInfinity))
      throw Error(fmt::format("a limit must be a number from 0, not {}", *limit), Failure::usage);
  if (!o.image.empty()) checkWritable(o.image);
  Comparison c = compare(o);
  judge(o, c);
  if (!o.image.empty()) writeErrorImage(o, c);
  if (o.json)
    printJson(o, c);
  else if (!o.quiet)
    printTable(o, c);
  return c.findings.failures.empty() ? 0 : 1;
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  constexpr int kUnreadable = 4;  // 1 would say that the pictures differ
  pbrt::Options options;
  CLI::App app("pbrt-diff compares a picture with a reference.", "pbrt-diff");
  pbrt::defineOptions(app, options);
  return pbrt::runCommand(
      app, pbrt::reversedWords(argc, argv), [&] { return pbrt::run(options); }, kUnreadable);
}
