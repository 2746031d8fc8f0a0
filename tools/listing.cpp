#include "listing.h"

#include <fmt/format.h>

#include <cctype>
#include <iterator>
#include <sstream>

#include "core/scene/translation.h"
#include "tools/kind_by_name.h"
#include "tools/laws/making.h"

namespace pbrt {

namespace {

// The words of a text.
std::vector<std::string> split(std::string_view text) {
  std::istringstream in{std::string(text)};
  return {std::istream_iterator<std::string>(in), {}};
}

std::string renames(const Translation& t) {
  std::string text;
  const std::vector<std::string> words = split(t.parameters);
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    std::string to = words[i + 1];
    if (to.ends_with(',')) to.pop_back();
    if (words[i] == to) continue;
    const std::string from = words[i] == "*" ? "all others" : fmt::format("`{}`", words[i]);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", from,
                        to == "-" ? "without effect" : fmt::format("is `{}`", to));
  }
  return text;
}

// What stands for the name of another generation, in words.
std::string meaning(const Translation& t) {
  if (t.target.empty()) return "not here yet";
  std::string text = fmt::format("\"{}\"", t.target);
  if (!t.differs.empty()) text += fmt::format("; {}", t.differs);
  return text;
}

// Names that only differ in their parameters are no other names.
bool isOtherName(const PluginLoader& loader, const Translation& t) {
  return t.name != t.target && !loader.has(t.kind, std::string(t.name));
}

std::string inMarkdown(std::string text) {
  for (std::size_t at = 0; (at = text.find_first_of("|<", at)) != text.npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

// A plug-in in Markdown: its picture, its sentence, its parameters. Kind and name make a heading
// that links can name, as several kinds have a "mix".
std::string chapter(const PluginInfo& plugin, PluginKind kind) {
  const std::string place = fmt::format("shelf/{}/{}", kindFolder(kind), plugin.name);
  std::string text = fmt::format("\n### {0} {1}\n\n[![{0} \"{1}\"]({2}.png)]({2}.pbrt)\n\n{3}\n",
                                 kindName(kind), plugin.name, place, inMarkdown(plugin.summary));
  const auto parameters = laws::declarationsOf(plugin);
  if (parameters.empty()) return text;
  text += "\n| parameter | default | meaning |\n| --- | --- | --- |\n";
  for (const Declaration& d : parameters)
    text += fmt::format("| {} `{}` | {} | {}{} |\n", d.type, d.name,
                        d.defaultValue == "-" ? "" : inMarkdown(d.defaultValue),
                        inMarkdown(d.meaning), d.unit.empty() ? "" : fmt::format(" [{}]", d.unit));
  return text;
}

}  // namespace

std::string listPlugins(PluginLoader& loader) {
  std::string text;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i) {
    const auto kind = static_cast<PluginKind>(i);
    text += fmt::format("{}\n", kindFolder(kind));
    for (const std::string& name : loader.available(kind)) {
      try {
        text += fmt::format("  {:<16} {}\n", name, loader.open(kind, name).summary);
      } catch (const Error& error) {
        text += fmt::format("  {:<16} cannot be used: {}\n", name, error.what());
      }
    }
    for (const Translation& t : translations())
      if (t.kind == kind && isOtherName(loader, t))
        text += fmt::format("  {:<16} of pbrt-{}: {}\n", t.name, fmt::join(split(t.of), ", "),
                            meaning(t));
  }
  return text;
}

std::string describePlugin(PluginLoader& loader, const std::string& kindText,
                           const std::string& name) {
  const PluginKind kind = kindByName(kindText);
  const PluginInfo& plugin = loader.open(kind, name);
  std::string text = fmt::format("{} \"{}\": {}\n", kindName(kind), plugin.name, plugin.summary);
  for (const Declaration& d : laws::declarationsOf(plugin)) {
    const std::string fallback =
        d.defaultValue == "-" ? "" : fmt::format(" (default {})", d.defaultValue);
    const std::string unit = d.unit.empty() ? "" : fmt::format(" [{}]", d.unit);
    text += fmt::format("  {:<17} {:<17} {}{}{}\n", d.type, d.name, d.meaning, unit, fallback);
  }
  return text;
}

std::string describeAll(PluginLoader& loader) {
  std::string text =
      "# Plug-ins and their parameters\n\nMade by `./dev docs`; do not edit. What the types mean: "
      "[scene-format.md](scene-format.md). Every picture leads to the scene that it shows, a few "
      "lines to copy."
      "\n\n![All of them](shelf.png)\n\n| kind | plug-ins |\n| --- | --- |\n";
  std::string chapters;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i) {
    const auto kind = static_cast<PluginKind>(i);
    const std::string_view folder = kindFolder(kind);
    std::string title(folder);
    title[0] = static_cast<char>(std::toupper(title[0]));
    std::vector<std::string> links;
    chapters += fmt::format("\n## {}\n", title);
    for (const std::string& name : loader.available(kind)) {
      links.push_back(fmt::format("[{}](#{}-{})", name, kindName(kind), name));
      chapters += chapter(loader.open(kind, name), kind);
    }
    text += fmt::format("| [{}](#{}) | {} |\n", title, folder, fmt::join(links, ", "));
  }
  text += chapters;
  text +=
      "\n## Names of other generations\n\n| kind | name | of pbrt- | here | renamed parameters |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const Translation& t : translations())
    if (!t.parameters.empty() || isOtherName(loader, t))
      text += fmt::format("| {} | {} | {} | {} | {} |\n", kindName(t.kind), t.name,
                          fmt::join(split(t.of), ", "), meaning(t), inMarkdown(renames(t)));
  return text;
}

}  // namespace pbrt
