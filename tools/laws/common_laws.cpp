// The laws of every plug-in, whatever its kind: what it says of its parameters is true.

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include "laws.h"
#include "making.h"

namespace pbrt::laws {
namespace {

std::string messageOf(const Error& error) {
  return error.diagnostics().empty() ? error.what() : error.diagnostics().front().message;
}

void isMade(const Subject& subject, Judge& judge) {
  Params reader(subject.plugin->name, {}, {&subject.params});
  make(*subject.plugin, reader);
  reader.refuseUnread();
  judge.expect(true, "");
}

void describesItself(const Subject& subject, Judge& judge) {
  judge.expect(!std::string_view(subject.plugin->summary).empty(),
               "its summary, the last word of PBRT_PLUGIN, is empty");
  std::vector<Declaration> found;
  Params reader = Params::describing(subject.plugin->name, found);
  try {
    make(*subject.plugin, reader);
  } catch (const Error& error) {
    judge.fail("with no values, as --describe makes it, it fails ({}): ask Params::describing()",
               messageOf(error));
  }
  std::set<std::string> names;
  for (const Declaration& d : found) {
    judge.expect(!d.name.empty() && d.name.find_first_of(" \t\"") == d.name.npos,
                 "a scene cannot give a parameter the name \"{}\"", d.name);
    judge.expect(names.insert(d.name).second, "\"{}\" is declared twice", d.name);
    judge.expect(!d.meaning.empty(), "\"{}\" has no meaning", d.name);
  }
}

// A list of the default of a declaration; empty, which most readers take for absent, if it has
// none.
Param defaultOf(const Declaration& d) {
  const std::string value = d.defaultValue == "-" ? "" : d.defaultValue;
  const auto is = [&](std::string_view type) { return d.type.starts_with(type); };
  Param p{ParamType::number, d.name, {}, {}, std::vector<float>()};
  if (is("string")) {
    p.type = ParamType::string;
    p.values = std::vector<std::string>();
    if (value.size() >= 2) p.values = std::vector{value.substr(1, value.size() - 2)};
    return p;
  }
  if (is("bool") || is("integer")) {
    p.type = is("bool") ? ParamType::boolean : ParamType::integer;
    p.values = std::vector<int>();
    if (!value.empty())
      p.values = std::vector{is("bool") ? int{value == "true"} : std::stoi(value)};
    return p;
  }
  for (const auto& [name, type] : {std::pair{"point3", ParamType::point3},
                                   {"vector3", ParamType::vector3},
                                   {"point2", ParamType::point2},
                                   {"normal", ParamType::normal},
                                   {"rgb", ParamType::rgb}})
    if (is(name)) p.type = type;
  std::istringstream in(value);
  std::vector<float> numbers;
  for (std::string word; in >> word;) numbers.push_back(std::strtof(word.c_str(), nullptr));
  // A colour that is told by one number is grey.
  if (p.type == ParamType::rgb && numbers.size() == 1) numbers.resize(3, numbers[0]);
  p.values = std::move(numbers);
  return p;
}

// What comes of making it with some parameters.
struct Attempt {
  std::string complaint;  // empty: it is made
  bool read = false;      // the last of them, by being made or complained of
};

Attempt attempt(const PluginInfo& plugin, const ParamList& params) {
  Attempt a;
  Params reader(plugin.name, {}, {&params});
  try {
    make(plugin, reader);
    a.read = params.empty() || std::ranges::count(reader.unread(), &params.back()) == 0;
  } catch (const Error& error) {
    a.complaint = messageOf(error);
    a.read =
        !params.empty() && a.complaint.find('"' + params.back().name + '"') != std::string::npos;
  }
  return a;
}

// Values of a switch on which it may depend what else is read: of a flag, or of a choice, whose
// meaning ends with the words that are allowed: "what it looks like (flat, round)".
std::vector<Param> settings(const Declaration& d) {
  if (d.type == "bool")
    return {{ParamType::boolean, d.name, {}, {}, std::vector{0}},
            {ParamType::boolean, d.name, {}, {}, std::vector{1}}};
  const std::size_t open = d.meaning.rfind('(');
  if (d.type != "string" || open == d.meaning.npos || !d.meaning.ends_with(')')) return {};
  std::istringstream in(d.meaning.substr(open + 1, d.meaning.size() - open - 2));
  std::vector<Param> values;
  for (std::string word; std::getline(in >> std::ws, word, ',');)
    values.push_back({ParamType::string, d.name, {}, {}, std::vector{word}});
  return values;
}

// Each declared parameter in turn is given its default, besides the others that are needed.
void readsWhatItDeclares(const Subject& subject, Judge& judge) {
  const PluginInfo& plugin = *subject.plugin;
  const bool bare = attempt(plugin, {}).complaint.empty();
  const ParamList others = bare ? ParamList() : subject.params;
  const std::vector<Declaration> declared = declarationsOf(plugin);
  for (const Declaration& d : declared) {
    if (std::ranges::any_of(others, [&](const Param& p) { return p.name == d.name; })) continue;
    ParamList with = others;
    with.push_back(defaultOf(d));
    const Attempt plain = attempt(plugin, with);
    const auto readBesides = [&](const Param& setting) {
      ParamList set = others;
      set.push_back(setting);
      set.push_back(with.back());
      return attempt(plugin, set).read;
    };
    const bool read = plain.read || std::ranges::any_of(declared, [&](const Declaration& other) {
                        return std::ranges::any_of(settings(other), readBesides);
                      });
    // Made without having asked for it; one that complains of something else may ask later.
    judge.expect(read || !plain.complaint.empty(),
                 "it declares \"{}\", but does not read it when it is made, whatever its flags and "
                 "choices are",
                 d.name);
    const bool hasDefault = !d.defaultValue.empty() && d.defaultValue != "-";
    judge.expect(plain.complaint.empty() || !bare || !hasDefault,
                 "\"{}\" is said to be {} by default, but with this value given it fails: {}",
                 d.name, d.defaultValue, plain.complaint);
  }
}

void namesWhatItNeeds(const Subject& subject, Judge& judge) {
  const std::string complaint = attempt(*subject.plugin, {}).complaint;
  const auto names = [&](const Declaration& d) {
    return complaint.find('"' + d.name + '"') != complaint.npos;
  };
  judge.expect(complaint.empty() || std::ranges::any_of(declarationsOf(*subject.plugin), names),
               "with no parameters it fails, and names none that it needs: {}", complaint);
}

constexpr Law kLaws[] = {
    {kMade, "It can be made with these parameters, and reads them all.", isMade},
    {"describes-itself", "It has a summary, and each parameter a name of its own and a meaning.",
     describesItself},
    {"reads-what-it-declares", "Each parameter that it declares is read, and takes its default.",
     readsWhatItDeclares},
    {"names-what-it-needs", "With no parameters it is made, or the error names one that it needs.",
     namesWhatItNeeds},
};

}  // namespace

std::span<const Law> commonLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
