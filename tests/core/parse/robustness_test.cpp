// Whatever the bytes: directives or an error with a place, and never anything else.

#include "core/base/rng.h"
#include "tests/core/parse/parsing.h"

namespace pbrt {
namespace {

void expectOrderly(const std::string& text) {
  try {
    test::Parsed parsed(text);
  } catch (const Error& error) {
    const Diagnostic& d = error.diagnostics().at(0);
    EXPECT_FALSE(d.message.empty());
    EXPECT_GT(d.line, 0U) << text;
    EXPECT_LE(d.column, text.size() + 1);
    EXPECT_LE(d.quoteColumn, d.quote.size());
    for (const char* jargon : {"syntax error", "token", "STRING", "$end", "YY"})
      EXPECT_EQ(d.message.find(jargon), std::string::npos) << d.message;
  }
}

const std::string kScene =
    "LookAt 0 1 2  0 0 0  0 1 0 # from\nCamera \"perspective\" \"float fov\" [30.5]\r\n"
    "ActiveTransform EndTime Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]\nWorldBegin\n"
    "Texture \"t\" \"color\" \"scale\" \"texture tex1\" \"u\" \"rgb tex2\" [.5 1e-3 -2]\n"
    "Shape \"mesh\" \"integer indices\" [0 1 2 # three\n 2 1 0] \"bool b\" \"true\" \"bool c\" "
    "false\n"
    "\"spectrum s\" [\"a\\\\b.spd\"] \"string n\" [\"x\" \"y\"] \"point P\" [1 2 3 4 5 "
    "6]\nWorldEnd\n";

TEST(Robustness, TheSceneItselfParses) {
  EXPECT_EQ(test::errorOf(kScene), "");
}

TEST(Robustness, EveryPrefixAndEverySuffix) {
  for (std::size_t i = 0; i <= kScene.size(); ++i) {
    expectOrderly(kScene.substr(0, i));
    expectOrderly(kScene.substr(i));
  }
}

TEST(Robustness, RandomBytes) {
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    std::string text(rng.uniform(200U), '\0');
    for (char& c : text) c = static_cast<char>(rng.bits());
    expectOrderly(text);
  }
}

TEST(Robustness, RandomChanges) {
  const std::vector<std::string> pieces{
      "\"",           "[",    "]",     "#",       "\n",      std::string(1, '\0'), "\\",
      "1e99",         "-",    "Shape", " \"",     "Include", "\"float x\"",        "true",
      "\xEF\xBB\xBF", "\xFF", "9",     "WorldEnd"};
  Rng rng(2);
  for (int i = 0; i < 10000; ++i) {
    std::string text = kScene;
    for (std::uint32_t k = 1 + rng.uniform(4U); k > 0; --k) {
      const std::size_t at = rng.uniform(static_cast<std::uint32_t>(text.size()));
      if (rng.uniform(2U) == 0)
        text.insert(at, pieces[rng.uniform(static_cast<std::uint32_t>(pieces.size()))]);
      else
        text.erase(at, 1 + rng.uniform(10U));
    }
    expectOrderly(text);
  }
}

// Sizes at which anything of more than linear time would not end.
TEST(Robustness, LargeRepetitions) {
  constexpr std::size_t kSize = 2000000;
  const std::string nuls(kSize, '\0');
  for (const std::string& text :
       {nuls, "#" + nuls, "\"" + nuls, "Shape \"a\" \"float x\" [" + nuls, std::string(kSize, '['),
        std::string(kSize, ']'), std::string(kSize, '"'), "#" + std::string(kSize, '#'),
        "\"" + std::string(kSize, 'x'), "Shape \"" + std::string(kSize, 'x') + "\"",
        "\"" + std::string(kSize, '\\'), std::string(kSize, 'x'), std::string(kSize, '9'),
        "Translate " + std::string(kSize, '9'),
        "Shape \"a\" \"float x\" [" + std::string(kSize, '9') + "]"})
    expectOrderly(text);
  std::string brackets;
  for (std::size_t i = 0; i < kSize / 30; ++i) brackets += "Shape \"a\" \"float x\" [1 # [\n] ";
  EXPECT_EQ(test::errorOf(brackets), "");
  std::string statements;
  for (std::size_t i = 0; i < kSize / 10; ++i) statements += "Identity\n";
  EXPECT_EQ(test::errorOf(statements), "");
  std::string items = "Shape \"a\" \"integer x\" [ # one by one\n";
  for (std::size_t i = 0; i < kSize / 4; ++i) items += "123 ";
  EXPECT_EQ(test::errorOf(items + "]"), "");
}

}  // namespace
}  // namespace pbrt
