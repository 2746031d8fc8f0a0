// Files of spectra: what is read, and the place of what is wrong.

#include "core/plugin/spectrum_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace pbrt {
namespace {

class SpectrumFile : public ::testing::Test {
 protected:
  ~SpectrumFile() override { std::filesystem::remove(path_); }

  SampledSpectrum read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return readSpectrumFile(path_, [this](const Diagnostic& d) { warnings_.push_back(d.message); });
  }
  // "line:column: message" of the error.
  std::string problem(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      const Diagnostic& d = error.diagnostics().at(0);
      EXPECT_EQ(d.file, path_.string());
      return fmt::format("{}:{}: {}", d.line, d.column, d.message);
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
  }

  std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) / fmt::format("spectrum-{}.spd", getpid());
  std::vector<std::string> warnings_;
};

TEST_F(SpectrumFile, IsPairsAndComments) {
  const SampledSpectrum::Samples expected{{400, 0.5}, {500, -1}, {600, 2e3}};
  EXPECT_EQ(read("400 .5\n500 -1\n600 2e3\n").samples(), expected);
  EXPECT_EQ(
      read("\xEF\xBB\xBF# of a lamp\r\n400\t0.5 # violet\r\n\r\n500 -1 600\r\n2000").samples(),
      expected);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(SpectrumFile, ErrorsHaveTheirPlace) {
  EXPECT_TRUE(problem("").starts_with("1:1: a spectrum needs pairs"));
  EXPECT_TRUE(problem("# nothing\n").starts_with("1:1: a spectrum needs pairs"));
  EXPECT_TRUE(problem("400 1\n500 1,5\n").starts_with("2:5: expected a number"));
  EXPECT_TRUE(problem("nm W\n400 1\n").starts_with("1:1: expected a number"));
  EXPECT_TRUE(problem("400 nan\n").starts_with("1:5: expected a number"));
  EXPECT_TRUE(problem("400 1e999\n").starts_with("1:5: expected a number"));
  EXPECT_TRUE(problem("400 1\n500").starts_with("2:1: a wavelength without a value"));
  EXPECT_TRUE(
      problem("400 1\n500 2\n 400 3").starts_with("3:2: the spectrum has two values at 400"));
  EXPECT_TRUE(problem("0 1").starts_with("1:1: a wavelength must be above 0 nm, not 0"));
}

TEST_F(SpectrumFile, UnsortedSamplesAreSortedWithAWarning) {
  const SampledSpectrum::Samples expected{{400, 1}, {500, 2}};
  EXPECT_EQ(read("500 2\n400 1\n").samples(), expected);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("do not ascend"), std::string::npos);
}

TEST_F(SpectrumFile, WavelengthsInOtherUnitsAreWarnedOf) {
  read("0.4 1\n0.7 2\n");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("says nothing of visible light"), std::string::npos);
  read("200 1\n900 2\n");
  read("555 1\n");
  EXPECT_EQ(warnings_.size(), 1U);
}

TEST_F(SpectrumFile, ThatCannotBeReadIsAnError) {
  EXPECT_THROW(readSpectrumFile(path_, {}), Error);
  std::ofstream(path_) << "400 1";
  std::filesystem::resize_file(path_, (16U << 20U) + 1);
  try {
    readSpectrumFile(path_, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::io);
    EXPECT_NE(std::string(error.what()).find("longer than 16 MiB"), std::string::npos);
  }
}

}  // namespace
}  // namespace pbrt
