#include "tests/fuzz/dictionary.h"

#include <fmt/format.h>

#include <regex>

#include "core/base/named_spectra.h"
#include "core/parse/directive.h"
#include "core/scene/translation.h"
#include "tools/listing.h"

namespace pbrt::fuzz {
namespace {

const std::vector<std::string> kOthers{
    "[", "]", "\"\" ", "# v1\n", "# v2\n", "# v3\n", "# v4\n", "\n#file.pbrt\n", "\n#file.spd\n",
    "\n#file.ply\n", "\n#file.png\n", "\n#file.tga\n", "\n#file.hdr\n", "\n#file.exr\n",
    "\n#file.jpg\n", "\n#file.csv\n", "Include \"file.pbrt\" ", "StartTime ", "EndTime ", "All ",
    "true ", "false ", "\"true\" ", "0 ", "1 ", "-1 ", "0.5 ", "1e-30 ", "1e30 ", "3.4e38 ",
    "2147483647 ", "-2147483648 ",
    // What no plug-in declares: the film's, the options', those of all shapes.
    "\"image\" ", "\"rgb\" ", "\"gbuffer\" ", "\"shape\" ", "\"light\" ", "\"material\" ",
    "\"texture\" ", "\"srgb\" ", "\"rec2020\" ", "\"aces2065-1\" ", "\"sampler\" ", "\"color\" ",
    "\"spectrum\" ", "\"float\" ", "\"camera\" ", "\"world\" ", "\"integer xresolution\" ",
    "\"integer yresolution\" ", "\"float cropwindow\" ", "\"integer pixelbounds\" ",
    "\"string aov\" ", "\"variance\" ", "\"float iso\" ", "\"float scale\" ", "\"float alpha\" ",
    "\"texture alpha\" ", "\"texture shadowalpha\" ", "\"seed\" ", "\"string type\" ",
    "\"blackbody L\" ", "\"xyz I\" ", "\"color Kd\" "};

std::string inQuotes(std::string_view text) {
  return fmt::format("\"{}\" ", text);
}

}  // namespace

std::vector<std::string> dictionary() {
  std::vector<std::string> words = kOthers;
  for (const std::string& name : directiveNames()) words.push_back(name + ' ');
  for (const std::string& name : spectrumNames()) words.push_back(inQuotes(name));
  for (const Translation& t : translations()) words.push_back(inQuotes(t.name));

  PluginLoader loader(PluginLoader::searchPath(""));
  const std::string all = describeAll(loader);
  const std::regex pattern("\n### \\w+ (\\S+)|\n\\| ([a-z0-9, ]+) `(\\w+)`"), separator(", | or ");
  for (std::sregex_iterator i(all.begin(), all.end(), pattern), end; i != end; ++i) {
    const std::string plugin = (*i)[1], types = (*i)[2], name = (*i)[3];
    if (!plugin.empty()) words.push_back(inQuotes(plugin));
    if (!types.empty())
      for (std::sregex_token_iterator t(types.begin(), types.end(), separator, -1), last; t != last;
           ++t)
        words.push_back(inQuotes(fmt::format("{} {}", t->str(), name)));
  }
  std::ranges::sort(words);
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

}  // namespace pbrt::fuzz
