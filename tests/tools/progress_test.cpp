// What pbrt says while it renders: to a terminal, to a log, to programs.

#include "tools/progress.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "core/base/image.h"
#include "tests/command.h"
#include "tests/tools/stripes.h"

namespace pbrt::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool hasControlCharacters(const std::string& text) {
  return std::ranges::any_of(text, [](char c) { return c != '\n' && (c < ' ' || c == 0x7f); });
}

class ProgressCommand : public testing::Test {
 protected:
  void SetUp() override { folder.write("scene.pbrt", stripes(16)); }

  // All that the command shows on a terminal of so many columns.
  std::string onTerminal(const std::string& arguments, unsigned short columns = 100) const {
    winsize size{24, columns, 0, 0};
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
      const std::string line = fmt::format("cd '{}' && {}", folder.path().string(), arguments);
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    std::string shown;
    char buffer[4096];
    for (ssize_t n; (n = read(terminal, buffer, sizeof buffer)) > 0;)
      shown.append(buffer, static_cast<std::size_t>(n));
    waitpid(child, nullptr, 0);
    close(terminal);
    return shown;
  }
  // What a terminal shows in the end: \r goes to the start of the line, ESC [ K erases from there.
  static std::vector<std::string> screen(const std::string& shown) {
    std::vector<std::string> lines{""};
    std::size_t column = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      std::string& line = lines.back();
      if (shown.compare(i, 3, "\x1b[K") == 0) {
        line.resize(column);
        i += 2;
      } else if (shown[i] == '\r') {
        column = 0;
      } else if (shown[i] == '\n') {
        lines.emplace_back();
        column = 0;
      } else {
        line.resize(std::max(line.size(), column + 1), ' ');
        line[column++] = shown[i];
      }
    }
    return lines;
  }

  Folder folder;
  const std::string render = Folder::program() + " --time 700ms scene.pbrt";
};

TEST_F(ProgressCommand, ABarOnATerminalLeavesNothing) {
  const std::string shown = onTerminal("TERM=xterm COLUMNS= " + render);
  EXPECT_THAT(shown, AllOf(HasSubstr("[#"), HasSubstr(" % "), HasSubstr("Mrays/s")));
  EXPECT_EQ(screen(shown), (std::vector<std::string>{"stripes.exr", ""}));
  EXPECT_EQ(shown.find("\x1b["), shown.find("\x1b[K"));
}

// No colour is ever used, with and without NO_COLOR (no-color.org).
TEST_F(ProgressCommand, NoColour) {
  for (const char* variable : {"NO_COLOR=1", "NO_COLOR="}) {
    std::string shown = onTerminal(fmt::format("TERM=xterm {} {}", variable, render));
    for (std::size_t at; (at = shown.find("\x1b[K")) != shown.npos;) shown.erase(at, 3);
    EXPECT_EQ(shown.find('\x1b'), shown.npos) << shown;
  }
}

TEST_F(ProgressCommand, TheBarFitsTheTerminal) {
  const auto widest = [&](const std::string& shown) {
    std::size_t most = 0;
    for (std::size_t at = 0; (at = shown.find("\x1b[K", at)) != shown.npos;) {
      at += 3;
      most = std::max(most, shown.find_first_of("\r\n", at) - at);
    }
    return most;
  };
  for (const unsigned short columns : {20, 33, 80, 200}) {
    const std::string shown = onTerminal("TERM=xterm COLUMNS= " + render, columns);
    EXPECT_LT(widest(shown), columns) << shown;
    EXPECT_EQ(screen(shown), (std::vector<std::string>{"stripes.exr", ""}));
  }
  EXPECT_LT(widest(onTerminal("TERM=xterm COLUMNS=25 " + render)), 25U);
}

TEST_F(ProgressCommand, TerminalsThatCannotRedrawGetPlainLines) {
  for (const char* terminal : {"TERM=dumb", "TERM=", "env -u TERM"})
    EXPECT_EQ(onTerminal(fmt::format("{} {}", terminal, render)), "stripes.exr\r\n") << terminal;
}

TEST_F(ProgressCommand, AnErrorTakesTheBarAway) {
  const std::string shown =
      onTerminal("TERM=xterm " + Folder::program() +
                 " --time 700ms --write-every 300ms --outfile gone/a.exr scene.pbrt & sleep 0.1; "
                 "mkdir gone; wait");
  const std::vector<std::string> lines = screen(shown);
  EXPECT_EQ(lines.back(), "") << shown;
  for (const std::string& line : lines) EXPECT_THAT(line, Not(StartsWith("["))) << shown;
}

TEST_F(ProgressCommand, NoControlCharactersElsewhere) {
  for (const char* style : {"auto", "bar", "lines", "json", "none"}) {
    const Outcome outcome =
        folder.pbrt(fmt::format("--progress={} --time 300ms scene.pbrt", style));
    EXPECT_EQ(outcome.code, 0);
    EXPECT_FALSE(hasControlCharacters(outcome.out + outcome.err)) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("stripes.exr"));
  }
}

TEST_F(ProgressCommand, LinesAreThoseOfOpenJobDescription) {
  const Outcome outcome = folder.pbrt("--progress=lines --time 2500ms scene.pbrt");
  double last = -1;
  int count = 0;
  std::smatch m;
  for (const std::string& line : linesOf(outcome.out)) {
    if (std::regex_match(line, m, std::regex("openjd_progress: ([0-9.]+)"))) {
      EXPECT_GE(std::stod(m[1]), last);
      last = std::stod(m[1]);
      ++count;
    } else {
      EXPECT_THAT(line, StartsWith("openjd_status: "));
    }
  }
  EXPECT_EQ(last, 100);
  EXPECT_GE(count, 2);
  EXPECT_LE(count, 2 + 3) << "one a second, and the last";
  EXPECT_THAT(outcome.out, EndsWith("openjd_status: done\nopenjd_status: wrote stripes.exr\n"));
}

TEST_F(ProgressCommand, JsonIsAnObjectALine) {
  const Outcome outcome =
      folder.pbrt("--progress=json --target-error 1e-9 --time 1500ms scene.pbrt");
  std::vector<nlohmann::json> objects;
  for (const std::string& line : linesOf(outcome.out))
    objects.push_back(nlohmann::json::parse(line));
  ASSERT_GE(objects.size(), 3U);
  const nlohmann::json wrote = objects.back(), &end = objects[objects.size() - 2];
  EXPECT_EQ(wrote, (nlohmann::json{{"state", "wrote"}, {"file", "stripes.exr"}}));
  EXPECT_EQ(end.at("state"), "done");
  EXPECT_EQ(end.at("part"), 1);
  EXPECT_EQ(end.at("remaining"), 0);
  EXPECT_GE(end.at("samplesPerPixel"), 1);
  EXPECT_GT(end.at("raysPerSecond"), 0);
  EXPECT_GT(end.at("error"), 0);
  EXPECT_EQ(objects[0].at("state"), "rendering");
}

// Stripes: the variance of n tosses of a coin over the squared mean is 0.25 / n / 0.26.
TEST_F(ProgressCommand, TellsTheErrorIfAsked) {
  const std::string spp = " --spp 600 --outfile ";
  const Outcome outcome =
      folder.pbrt("--progress=json --progress-error" + spp + "told.exr scene.pbrt");
  const nlohmann::json end =
      nlohmann::json::parse(linesOf(outcome.out).at(linesOf(outcome.out).size() - 2));
  EXPECT_GT(end.at("error"), 0.02);
  EXPECT_LT(end.at("error"), 0.08) << "that of more than half of the samples";
  EXPECT_THAT(folder.pbrt("--progress=json" + spp + "plain.exr scene.pbrt").out,
              HasSubstr(R"("error":null)"));
  const Image told = readExr(folder.path() / "told.exr"),
              plain = readExr(folder.path() / "plain.exr");
  EXPECT_EQ(told.names, plain.names);
  EXPECT_EQ(told.channels, plain.channels);
}

// Nothing is left to be rendered: what the checkpoint held is told all the same.
TEST_F(ProgressCommand, CountsWhatACheckpointHeld) {
  const std::string line = "scene.pbrt --progress=json --checkpoint c.film --resume";
  ASSERT_EQ(folder.pbrt(line).code, 0);
  const nlohmann::json done = nlohmann::json::parse(linesOf(folder.pbrt(line).out).at(0));
  EXPECT_EQ(done.at("state"), "done");
  EXPECT_EQ(done.at("samplesPerPixel"), 16);
}

// A render of the samples 4 to 20 of 100 pixels, gone on from a checkpoint with 600 of them:
// interrupted before it began, and after 200 more.
TEST(Progress, TellsTheWholeOfAResumedRender) {
  for (const int taken : {0, 200}) {
    RenderControl control;
    testing::internal::CaptureStdout();
    {
      Progress progress(ProgressStyle::json, control, 100, 4, 600);
      progress.next({4 + 4, 4 + 12, 0.25, 0.75});
      if (taken > 0) {
        progress.begin();
        control.samplesDone = static_cast<std::uint64_t>(taken);
        progress.rest();
      }
      progress.end(Stage::interrupted);
    }
    const nlohmann::json told =
        nlohmann::json::parse(linesOf(testing::internal::GetCapturedStdout()).back());
    EXPECT_EQ(told.at("state"), "interrupted");
    EXPECT_DOUBLE_EQ(told.at("samplesPerPixel"), 6 + taken / 100);
    EXPECT_DOUBLE_EQ(told.at("part"), (6 + taken / 100) / 16.0);
  }
}

TEST_F(ProgressCommand, FailuresAreTold) {
  const Outcome lines = folder.pbrt("--progress=lines none.pbrt");
  EXPECT_EQ(lines.code, 4);
  EXPECT_THAT(lines.out, AllOf(StartsWith("openjd_fail: "), HasSubstr("none.pbrt")));
  EXPECT_THAT(lines.err, HasSubstr("none.pbrt"));
  const Outcome json = folder.pbrt("--progress=json none.pbrt");
  EXPECT_EQ(nlohmann::json::parse(json.out).at("state"), "failed");
  EXPECT_EQ(folder.pbrt("--progress=json --stats scene.pbrt").code, 2);
  EXPECT_EQ(folder.pbrt("--progress=fast scene.pbrt").code, 2);
}

TEST_F(ProgressCommand, QuietSaysOnlyWhatIsAskedFor) {
  EXPECT_EQ(folder.pbrt("--quiet scene.pbrt").out, "");
  EXPECT_THAT(folder.pbrt("--quiet --progress=lines scene.pbrt").out,
              EndsWith("openjd_progress: 100.0\nopenjd_status: done\n"));
}

}  // namespace
}  // namespace pbrt::test
