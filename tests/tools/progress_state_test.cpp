#include "tools/progress_state.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace pbrt {
namespace {

using testing::HasSubstr;

ProgressState halfway() {
  ProgressState s;
  s.frame = 12;
  s.part = 0.4259;
  s.seconds = 75;
  s.remaining = 4000;
  s.samplesPerPixel = 27.25;
  s.raysPerSecond = 2.5e6;
  s.error = 0.0123;
  return s;
}

TEST(StatusText, SaysAllInOneLine) {
  EXPECT_EQ(statusText(halfway(), 200, false),
            "frame 12  42 %  1h 07m remaining  1m 15s elapsed  error about 0.012  2.50 Mrays/s");
  EXPECT_THAT(statusText({}, 200, false), HasSubstr("  0 %  -- remaining  0.0 s elapsed"));
}

TEST(StatusText, FitsAnyWidth) {
  for (const bool bar : {false, true})
    for (int width = 0; width < 200; ++width) {
      const std::string text = statusText(halfway(), width, bar);
      EXPECT_LE(text.size(), static_cast<std::size_t>(width));
      for (const char c : text) ASSERT_TRUE(c >= ' ' && c <= '~');
      if (width >= 15) {
        EXPECT_THAT(text, HasSubstr("42 %")) << width;
      }
    }
  EXPECT_THAT(statusText(halfway(), 120, true), HasSubstr("[########            ] frame 12  42 %"));
}

// Whole seconds, minutes and hours that round up to the next unit.
TEST(StatusText, RoundsTimesIntoTheNextUnit) {
  const auto elapsed = [](double seconds) {
    ProgressState s;
    s.seconds = seconds;
    const std::string text = statusText(s, 200, false);
    const std::size_t from = text.find("remaining  ") + 11;
    return text.substr(from, text.find(" elapsed") - from);
  };
  EXPECT_EQ(elapsed(0), "0.0 s");
  EXPECT_EQ(elapsed(59.94), "59.9 s");
  EXPECT_EQ(elapsed(59.96), "1m 00s");
  EXPECT_EQ(elapsed(119.6), "2m 00s");
  EXPECT_EQ(elapsed(3599.4), "59m 59s");
  EXPECT_EQ(elapsed(3599.6), "1h 00m");
  EXPECT_EQ(elapsed(86399), "1d 00h");
  EXPECT_EQ(elapsed(1e6), "11d 14h");
}

TEST(JobLines, AreMessagesOfOpenJobDescription) {
  EXPECT_EQ(jobLines(halfway()),
            "openjd_progress: 42.5\n"
            "openjd_status: frame 12: rendering, 1h 07m remaining, error about 0.012\n");
  ProgressState almost;
  almost.part = 0.99999;
  EXPECT_THAT(jobLines(almost), HasSubstr("progress: 99.9\n")) << "100 is the end only";
  almost.part = 1;
  almost.stage = Stage::done;
  EXPECT_EQ(jobLines(almost), "openjd_progress: 100.0\nopenjd_status: done\n");
  almost.stage = Stage::interrupted;
  EXPECT_THAT(jobLines(almost), HasSubstr("openjd_status: interrupted\n"));
  EXPECT_EQ(failureLine(ProgressStyle::lines, "no\nroom"), "openjd_fail: no room\n");
  EXPECT_EQ(pictureLine(ProgressStyle::lines, "a.exr"), "openjd_status: wrote a.exr\n");
}

// Names of files may be any bytes: they neither begin messages nor steer a terminal.
TEST(JobLines, HaveNoControlCharactersOfNames) {
  EXPECT_EQ(pictureLine(ProgressStyle::lines, "a\nopenjd_fail: \x1b[2J\x7f\xc3\xa9.exr"),
            "openjd_status: wrote a?openjd_fail: ?[2J?\xc3\xa9.exr\n");
  EXPECT_EQ(failureLine(ProgressStyle::lines, "a\tb\x1b.exr:\nno\rroom"),
            "openjd_fail: a?b?.exr: no?room\n");
}

TEST(JsonLine, HasTheDocumentedFields) {
  const std::string text = jsonLine(halfway());
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_EQ(nlohmann::json::parse(text), (nlohmann::json{{"state", "rendering"},
                                                         {"frame", 12},
                                                         {"part", 0.4259},
                                                         {"seconds", 75.0},
                                                         {"remaining", 4000.0},
                                                         {"samplesPerPixel", 27.25},
                                                         {"raysPerSecond", 2.5e6},
                                                         {"error", 0.0123}}));
  const auto unknown = nlohmann::json::parse(jsonLine({}));
  for (const char* field : {"frame", "remaining", "error"})
    EXPECT_TRUE(unknown.at(field).is_null()) << field;
}

TEST(JsonLine, TellsNamesOfAnyBytes) {
  using nlohmann::json;
  EXPECT_EQ(json::parse(pictureLine(ProgressStyle::json, "a \"b\"\n.exr")),
            (json{{"state", "wrote"}, {"file", "a \"b\"\n.exr"}}));
  EXPECT_EQ(json::parse(pictureLine(ProgressStyle::json, "\xff.exr"))["file"], "\xef\xbf\xbd.exr");
  EXPECT_EQ(json::parse(failureLine(ProgressStyle::json, "no\nroom")),
            (json{{"state", "failed"}, {"message", "no\nroom"}}));
}

TEST(StylesForPeople, NameThePictureAndLeaveFailuresToStandardError) {
  for (const ProgressStyle style :
       {ProgressStyle::automatic, ProgressStyle::bar, ProgressStyle::none}) {
    EXPECT_EQ(pictureLine(style, "a.exr"), "a.exr\n");
    EXPECT_EQ(failureLine(style, "no"), "");
  }
}

}  // namespace
}  // namespace pbrt
