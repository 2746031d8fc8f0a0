// pbrt-diff as a user runs it: verdicts, exit codes, what it prints and writes.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/image.h"
#include "core/base/rng.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A render of 16 samples per pixel with noise of 0.1 in each pixel's value.
Image render(std::uint64_t seed, double bias = 1) {
  Image image{.window = {{0, 0}, {16, 16}},
              .resolution = {16, 16},
              .names = {"R", "G", "B", "A", "Variance.R", "Variance.G", "Variance.B", "Z"}};
  for (const std::string& name : image.names)
    image.channels.emplace_back(256, name.starts_with("Variance") ? 0.01F : 1.F);
  Rng rng(seed);
  for (int c = 0; c < 3; ++c)
    for (float& v : image.channels[c]) {
      const float noise = std::sqrt(12.F) * (rng.uniform() - 0.5F);
      v = static_cast<float>(bias * (1 + 0.1 * noise));
    }
  image.attributes["samplesPerPixel"] = 16;
  image.attributes["seed"] = std::to_string(seed);
  image.attributes["camera"] = glm::dmat4(1);
  return image;
}

class Diff : public testing::Test {
 protected:
  void write(const std::string& name, const Image& image) const {
    writeImage(folder.path() / name, image);
  }
  Outcome diff(const std::string& arguments) const {
    return folder.command(PBRT_BUILD_DIR "/bin/pbrt-diff " + arguments);
  }
  // Of two pictures.
  Outcome diff(const Image& a, const Image& b, const std::string& options = "") const {
    write("a.exr", a);
    write("b.exr", b);
    return diff("a.exr b.exr " + options);
  }
  static bool says(const Outcome& outcome, const std::string& text) {
    return outcome.out.find(text) != std::string::npos;
  }

  Folder folder;
};

TEST_F(Diff, EqualPicturesAreTheSame) {
  for (const char* options : {"", "--statistical", "--strict-metadata", "--max-rmse 0 --max-abs 0",
                              "--max-flip 0 --max-mae 0 --max-relmse 0 --hdr-flip"}) {
    const Outcome outcome = diff(render(1), render(1), options);
    EXPECT_EQ(outcome.code, 0) << options << outcome.out;
    EXPECT_TRUE(outcome.out.ends_with("\nsame\n")) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(Diff, TheLastBitOfAnyChannelIsADifference) {
  for (std::size_t c = 0; c < render(1).names.size(); ++c) {
    Image other = render(1);
    float& value = other.channels[c][37];
    value = std::nextafter(value, 2.F);
    const Outcome outcome = diff(render(1), other);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(says(outcome, "channel " + other.names[c] + ": 1 of 256 values differ"));
    EXPECT_TRUE(says(outcome, "pixel (5, 2)")) << outcome.out;
  }
}

TEST_F(Diff, LimitsAloneDecide) {
  Image reference = render(1), test = reference;
  for (int c = 0; c < 3; ++c) {
    reference.channels[c].assign(256, 1);
    test.channels[c].assign(256, 1.5F);
  }
  test.channels[3][0] = 0.5F;  // another alpha: no limit is about it
  const double relative = 0.25 / 1.01;
  for (const auto& [option, value] : {std::pair{"--max-rmse", 0.5},
                                      {"--max-mae", 0.5},
                                      {"--max-abs", 0.5},
                                      {"--max-relmse", relative}}) {
    EXPECT_EQ(diff(reference, test, fmt::format("{} {:.17g}", option, value * 1.0001)).code, 0);
    EXPECT_EQ(diff(reference, test, fmt::format("{} {:.17g}", option, value * 0.9999)).code, 1);
    const Outcome both =
        diff(reference, test, fmt::format("--max-flip 1 {} {:.17g}", option, value * 0.9999));
    EXPECT_EQ(both.code, 1) << option << ": all limits must hold";
    EXPECT_TRUE(says(both, ", above 0.")) << both.out;
  }
  EXPECT_EQ(diff(reference, test, "--max-abs 0.5").code, 0) << "at the limit";
  EXPECT_EQ(diff(reference, test, "--max-flip 1").code, 0);
  EXPECT_EQ(diff(reference, render(2), "--max-flip 0.0001").code, 1);
}

TEST_F(Diff, OtherSeedsAgreeAndABiasDoesNot) {
  for (std::uint64_t seed = 2; seed < 12; ++seed) {
    EXPECT_EQ(diff(render(1), render(seed)).code, 1) << "they are not equal";
    EXPECT_EQ(diff(render(1), render(seed), "--statistical").code, 0);
  }
  // 10 %: noise of 0.1 in 256 pixels is 0.6 %.
  const Outcome biased = diff(render(1), render(2, 1.1), "--statistical");
  EXPECT_EQ(biased.code, 1);
  EXPECT_TRUE(says(biased, "noise does not explain the difference, whole picture: 3 of 3"))
      << biased.out;
  EXPECT_EQ(diff(render(1), render(2), "--statistical --max-abs 0.001").code, 1)
      << "limits hold beside the z-test";
}

TEST_F(Diff, AReferenceWithoutVarianceIsExact) {
  Image reference = render(1);
  for (int c = 0; c < 3; ++c) reference.channels[c].assign(256, 1);
  reference.names.resize(4);
  reference.channels.resize(4);
  Image test = render(2);
  test.names.pop_back();
  test.channels.pop_back();
  const Outcome outcome = diff(reference, test, "--statistical");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_TRUE(says(outcome, "The reference states no variance: it is taken as exact"));
  EXPECT_EQ(diff(reference, render(2, 1.1), "--statistical --ignore-channels Z").code, 1);
  EXPECT_EQ(diff(reference, test, "--max-abs 1").code, 1) << "channels are missing";
  EXPECT_EQ(diff(reference, test, "--max-abs 1 --ignore-channels Variance").code, 0);
}

// A planted NaN in every channel, at every path.
TEST_F(Diff, WhatIsNotFiniteIsADifferenceAlways) {
  const Image good = render(1);
  for (std::size_t c = 0; c < good.names.size(); ++c)
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
      Image broken = good;
      broken.channels[c][20] = broken.channels[c][200] = bad;
      write("good.exr", good);
      write("broken.exr", broken);
      std::vector<std::string> paths{"", "--statistical"};
      if (std::isnan(bad))
        paths.insert(paths.end(), {"--max-rmse 1e30", "--max-flip 1 --max-abs 1e30", "--quiet",
                                   "--image error.exr", "--image error.png", "--json"});
      for (const std::string& options : paths)
        for (const char* files : {"good.exr broken.exr ", "broken.exr good.exr "}) {
          const Outcome outcome = diff(files + options);
          EXPECT_EQ(outcome.code, 1) << files << options << good.names[c];
          if (options == "--quiet") continue;
          EXPECT_TRUE(says(outcome, "channel " + good.names[c] +
                                        " has 2 values that are not finite; the first, "))
              << outcome.out;
          EXPECT_TRUE(says(outcome, "at pixel (4, 1)")) << outcome.out;
        }
      EXPECT_EQ(diff("broken.exr broken.exr").code, 1);
      EXPECT_EQ(diff("broken.exr good.exr --ignore-channels " + good.names[c]).code, 0);
    }
}

TEST_F(Diff, MissingPixelsAndChannelsAreADifferenceAlways) {
  const Image whole = render(1);
  Image half = whole;
  half.window.hi.y = 8;
  for (auto& channel : half.channels) channel.resize(128);
  Image moved = whole;
  moved.window = {{1, 0}, {17, 16}};
  Image larger = whole;
  larger.resolution = {17, 16};
  Image less = whole;
  less.names.pop_back();
  less.channels.pop_back();
  Image grey = whole;
  grey.names[1] = "Y";
  for (const Image& other : {half, moved, larger, less, grey})
    for (const char* options : {"", "--statistical", "--image error.exr", "--json"}) {
      EXPECT_EQ(diff(whole, other, options).code, 1) << options;
      EXPECT_EQ(diff(other, whole, options).code, 1) << options;
    }
  EXPECT_EQ(diff(whole, half, "--max-abs 1e30").code, 1);
  EXPECT_TRUE(says(diff(whole, half),
                   "unlike pixels (data window): [0, 16) x [0, 16) in the "
                   "reference, [0, 16) x [0, 8) in the test"));
  EXPECT_TRUE(says(diff(whole, larger), "unlike size of the whole picture"));
  EXPECT_TRUE(says(diff(whole, less), "the test has no channel Z"));
  EXPECT_TRUE(says(diff(less, whole), "the reference has no channel Z"));
  EXPECT_EQ(diff(whole, less, "--ignore-channels Z").code, 0);
}

TEST_F(Diff, MetadataIsToldAndCountsIfStrict) {
  Image other = render(1);
  other.attributes["seed"] = std::string("77");
  other.attributes["renderTimeSeconds"] = 3.5;
  const Outcome run = diff(render(1), other, "--strict-metadata");
  EXPECT_EQ(run.code, 0) << run.out;
  EXPECT_TRUE(says(run, "note: unlike metadata seed: \"1\" in the reference, \"77\" in the test"));
  EXPECT_TRUE(says(run, "note: unlike metadata renderTimeSeconds: none in the reference, 3.5"));
  EXPECT_FALSE(says(diff(render(1), other, "--ignore-metadata"), "metadata"));

  other.attributes["camera"] = glm::dmat4(2);
  EXPECT_TRUE(says(diff(render(1), other), "note: unlike metadata camera: [ 1 0 0 0 0 1"));
  EXPECT_EQ(diff(render(1), other).code, 0);
  EXPECT_EQ(diff(render(1), other, "--strict-metadata").code, 1);
  EXPECT_EQ(diff(other, render(1), "--strict-metadata --max-abs 1").code, 1);
}

TEST_F(Diff, WritesTheSignedErrorAndTheMap) {
  Image test = render(1);
  test.channels[1][17] += 0.25F;
  ASSERT_EQ(diff(render(1), test, "--image error.exr").code, 1);
  const Image error = readExr(folder.path() / "error.exr");
  for (const std::string& name : test.names)
    for (std::size_t i = 0; i < 256; ++i)
      EXPECT_NEAR((*error.channel(name))[i], name == "G" && i == 17 ? 0.25F : 0, 1e-6F);
  ASSERT_EQ(diff("a.exr b.exr --image error.PNG").code, 1);
  EXPECT_TRUE(contents(folder.path() / "error.PNG").starts_with("\x89PNG"));
}

TEST_F(Diff, PrintsJson) {
  Image test = render(1);
  test.channels[0].assign(256, kNan);
  const auto good = nlohmann::json::parse(diff(render(1), render(2, 1.1), "--json").out);
  EXPECT_EQ(good["same"], false);
  EXPECT_EQ(good["differences"].size(), 3U);
  EXPECT_EQ(good["channels"].size(), 8U);
  EXPECT_NEAR(good["errors"]["meanTest"].get<double>(), 1.1, 0.01);
  EXPECT_EQ(good["zTest"]["agree"], false);
  EXPECT_EQ(good["zTest"]["scales"][3]["tests"], 3);
  const auto broken = nlohmann::json::parse(diff(render(1), test, "--json").out);
  EXPECT_TRUE(broken["errors"]["rmse"].is_null());
  EXPECT_EQ(nlohmann::json::parse(diff(render(1), render(1), "--json --quiet").out)["same"], true);
  std::filesystem::rename(folder.path() / "a.exr", folder.path() / "\xff.exr");
  EXPECT_TRUE(nlohmann::json::accept(diff("\xff.exr b.exr --json").out)) << "no UTF-8";
}

TEST_F(Diff, QuietSaysNothing) {
  for (const Image& other : {render(1), render(2)}) {
    const Outcome outcome = diff(render(1), other, "--quiet");
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
}

TEST_F(Diff, WhatCannotBeReadOrWrittenIs4) {
  const Image good = render(1);
  write("good.exr", good);
  const std::string bytes = contents(folder.path() / "good.exr");
  folder.write("empty.exr", "");
  folder.write("text.exr", "a picture is worth a thousand words");
  folder.write("cut.exr", bytes.substr(0, bytes.size() / 2));
  folder.write("header.exr", bytes.substr(0, 100));
  std::string damaged = bytes;
  for (std::size_t i = bytes.size() / 2; i < bytes.size(); i += 3) damaged[i] ^= 0x5a;
  folder.write("damaged.exr", damaged);
  std::filesystem::create_directory(folder.path() / "folder.exr");
  for (const char* bad : {"empty", "text", "cut", "header", "damaged", "folder", "nowhere"})
    for (const std::string& files :
         {fmt::format("good.exr {}.exr", bad), fmt::format("{}.exr good.exr", bad)}) {
      const Outcome outcome = diff(files + " --json");
      EXPECT_EQ(outcome.code, 4) << files;
      EXPECT_EQ(outcome.out, "");
      EXPECT_NE(outcome.err.find(bad), std::string::npos) << outcome.err;
    }
  for (const char* image : {"nowhere/error.png", "folder.exr", "error.gif", "/proc/error.exr"})
    EXPECT_EQ(diff(std::string("good.exr good.exr --image ") + image).code, 4) << image;
}

TEST_F(Diff, WrongUseIs2) {
  write("a.exr", render(1));
  Image grey = render(1);
  grey.names = {"Y", "G", "B", "A", "V", "W", "X", "Z"};
  write("grey.exr", grey);
  for (const char* arguments :
       {"", "a.exr", "a.exr a.exr a.exr", "a.exr a.exr --max-rmse", "a.exr a.exr --max-rmse -1",
        "a.exr a.exr --max-rmse nan", "a.exr a.exr --max-rmse x", "a.exr a.exr --max-flip inf",
        "a.exr a.exr --max-rms 1", "a.exr a.exr --alpha 0 --statistical", "a.exr a.exr --alpha nan",
        "a.exr a.exr --strict-metadata --ignore-metadata", "grey.exr grey.exr --max-rmse 1",
        "grey.exr grey.exr --statistical", "grey.exr grey.exr --image error.png"}) {
    const Outcome outcome = diff(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
  EXPECT_EQ(diff("grey.exr grey.exr").code, 0) << "no colours are needed for equality";
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "error.png"));
  EXPECT_EQ(diff("--help").code, 0);
  EXPECT_TRUE(diff("--version").out.starts_with("pbrt-diff "));
}

}  // namespace
}  // namespace pbrt::test
