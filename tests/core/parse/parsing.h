#pragma once
// What the tests of the parser share.

#include <gtest/gtest.h>

#include "core/parse/parse.h"

namespace pbrt::test {

// A parsed text; the parser keeps the text for the locations.
struct Parsed {
  explicit Parsed(const std::string& text) { parser.text("t", text); }

  std::vector<Directive> directives;
  Parser parser{[this](Directive&& d) { directives.push_back(std::move(d)); }};
};

// The first line of the error that a text gives: "line:column: message", or "" if it parses.
inline std::string errorOf(const std::string& text) {
  try {
    Parsed parsed(text);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::scene);
    EXPECT_EQ(error.diagnostics().size(), 1U);
    const Diagnostic& d = error.diagnostics()[0];
    EXPECT_EQ(d.file, "t");
    return std::to_string(d.line) + ":" + std::to_string(d.column) + ": " + d.message;
  }
}

inline std::string textAt(const Location& where) {
  return where.source->text.substr(where.begin, where.length);
}

}  // namespace pbrt::test
