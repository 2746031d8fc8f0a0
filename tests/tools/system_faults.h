#pragma once
// What tests of the system's faults share.

#include <regex>

#include "tests/command.h"

namespace pbrt::test {

// Fills the picture.
inline const std::string kBall = "Shape \"sphere\" \"float radius\" 2.5";

// Statements under the light of a sphere; a noisy picture, which is long, of the ball.
inline std::string scene(const std::string& statements = kBall, int width = 64) {
  return "LookAt 0 0 3  0 0 0  0 1 0\nCamera \"perspective\"\n"
         "Film \"image\" \"integer xresolution\" " +
         std::to_string(width) + " \"integer yresolution\" " + std::to_string(width) +
         " \"string filename\" \"out.exr\"\n"
         "Sampler \"random\" \"integer pixelsamples\" 1\nIntegrator \"path\"\nWorldBegin\n"
         "AttributeBegin\nTranslate 0 3 5\nAreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\n"
         "Shape \"sphere\"\nAttributeEnd\n" +
         statements + "\nWorldEnd\n";
}

// One error, said in one line (its place in the scene may be shown below), for people.
inline void expectError(const Outcome& outcome, int code, const std::string& pattern) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  const std::regex line("^([^\\n]*:\\d+:\\d+: )?error: [^\\n]*(" + pattern + ")[^\\n]*\\n");
  EXPECT_TRUE(std::regex_search(outcome.err, line, std::regex_constants::match_continuous))
      << "not found: " << pattern << "\nin: " << outcome.err;
  EXPECT_EQ(outcome.err.find("bug"), std::string::npos) << outcome.err;
}

// A command with settings of the shell, such as limits and redirections.
inline Outcome shell(const Folder& folder, const std::string& before,
                     const std::string& arguments) {
  return folder.command("sh -c '" + before + Folder::program() + " " + arguments + "'");
}

}  // namespace pbrt::test
