// What pbrt-converge leaves behind: numbers that programs read back, a page that browsers show.

#include "tools/converge/report.h"

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/tools/measured.h"

namespace pbrt {
namespace {

using namespace test;
using Json = nlohmann::ordered_json;

// Labels as somebody could give them.
const std::vector<std::string> kLabels = {
    "plain", "</script><script>document.title = 'no'</script><!-- <script>",
    "\"quoted\", 'so', /*SCRIPT*/ /*REPORT*/null", "Ünïcödé → ∞ \\ \u2028\tand a tab"};

// Four variants of two seeds: measured once for all tests.
class ReportTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    variants_ = new std::vector<Variant>;
    report_ = new Report;
    for (const std::string& label : kLabels) {
      variants_->push_back(variantOfText(stripes(16), "SurfaceIntegrator \"whitted\""));
      variants_->back().label = label;
      report_->referenceOf.push_back(0);
    }
    report_->references.push_back(renderReference((*variants_)[0], 512, 0));
    report_->command = "pbrt-converge '</script>' & <b>";
    report_->threads = 2;
    report_->notes = {"a <i>note</i>"};
    report_->variants = variants_;
    const Plan plan{.samples = {1, 2, 4, 8}, .seeds = 2};
    report_->curves = measureAll(*variants_, report_->references[0], plan);
    report_->curves[3].slope.reset();
  }
  static void TearDownTestSuite() {
    delete report_;
    delete variants_;
  }

  static inline std::vector<Variant>* variants_ = nullptr;
  static inline Report* report_ = nullptr;
};

// The keys of an object, in its order.
std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) names.push_back(key);
  return names;
}

TEST_F(ReportTest, JsonHasEverythingThatThePageReads) {
  using Names = std::vector<std::string>;
  const Json json = toJson(*report_);
  EXPECT_EQ(keys(json), (Names{"title", "command", "date", "software", "threads", "machine",
                               "interleaved", "notes", "references", "variants"}));
  EXPECT_EQ(keys(json["references"][0]),
            (Names{"scene", "description", "samples", "rmse", "width", "height", "picture"}));
  const Json& v = json["variants"][0];
  EXPECT_EQ(keys(v), (Names{"label", "scene", "reference", "statements", "parseSeconds",
                            "buildSeconds", "slope", "snapshots", "picture", "errorMap"}));
  EXPECT_EQ(keys(v["slope"]), (Names{"value", "error", "against", "points"}));
  EXPECT_EQ(keys(v["snapshots"][0]),
            (Names{"samples", "seeds", "seconds", "secondsError", "cpuSeconds", "rays", "rmse",
                   "rmseError", "relMse", "relMseError", "mae", "maeError", "flip", "flipError",
                   "biasShare", "biasZ", "efficiency", "runs", "thumbnail"}));
  EXPECT_EQ(keys(v["snapshots"][0]["runs"][0]),
            (Names{"samples", "seconds", "cpuSeconds", "rays", "mse", "relMse", "mae", "flip"}));
}

TEST_F(ReportTest, JsonSaysWhatWasMeasured) {
  const Json json = Json::parse(toText(toJson(*report_), 1));
  EXPECT_TRUE(std::regex_match(json["date"].get<std::string>(),
                               std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
  EXPECT_EQ(json["references"][0]["samples"], 512);
  EXPECT_EQ(json["references"][0]["rmse"], std::sqrt(*report_->references[0].mse));
  ASSERT_EQ(json["variants"].size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const Json& v = json["variants"][i];
    EXPECT_EQ(v["label"], kLabels[i]);
    ASSERT_EQ(v["snapshots"].size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      const Json& s = v["snapshots"][k];
      const std::vector<pbrt::Run>& runs = report_->curves[i].snapshots[k].runs;
      EXPECT_EQ(s["samples"], 1 << k);
      EXPECT_DOUBLE_EQ(s["rmse"].get<double>(), (runs[0].errors.rmse + runs[1].errors.rmse) / 2);
      // Of two values, half their distance.
      EXPECT_NEAR(s["rmseError"].get<double>(),
                  std::abs(runs[0].errors.rmse - runs[1].errors.rmse) / 2, 1e-15);
      const double cpu = (runs[0].cpuSeconds + runs[1].cpuSeconds) / 2;
      const double mse = (runs[0].errors.mse + runs[1].errors.mse) / 2;
      EXPECT_EQ(s["cpuSeconds"], cpu);
      if (cpu > 0) {
        EXPECT_NEAR(s["efficiency"].get<double>() * mse * cpu, 1, 1e-12);
      } else {
        EXPECT_TRUE(s["efficiency"].is_null());
      }
      EXPECT_EQ(s["biasZ"].is_null(), k == 0);
      for (std::size_t r = 0; r < 2; ++r) EXPECT_EQ(s["runs"][r]["mse"], runs[r].errors.mse);
    }
  }
  EXPECT_TRUE(json["variants"][3]["slope"].is_null());
}

TEST_F(ReportTest, JsonReplacesBytesThatAreNoText) {
  Report report = *report_;
  report.command = "pbrt-converge caf\xe9.pbrt";
  const Json json = Json::parse(toText(toJson(report), 1));
  EXPECT_EQ(json["command"], "pbrt-converge caf\uFFFD.pbrt");
  EXPECT_NE(toHtml(toJson(report)).find("caf\uFFFD.pbrt"), std::string::npos);
}

// RFC 4180, with line feeds alone.
std::vector<std::vector<std::string>> parseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& field = rows.back().back();
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      field += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (quoted || (c != ',' && c != '\n'))
      field += c;
    else if (c == ',')
      rows.back().emplace_back();
    else
      rows.emplace_back(1);
  }
  rows.pop_back();  // what follows the last line feed
  return rows;
}

TEST_F(ReportTest, CsvReadsBackAsTheSameNumbers) {
  const Json json = toJson(*report_);
  const auto rows = parseCsv(toCsv(json));
  ASSERT_EQ(rows.size(), 1 + 4 * 4U);
  const std::vector<std::string>& head = rows[0];
  EXPECT_EQ(head[0], "scene");
  for (std::size_t row = 1; row < rows.size(); ++row) {
    ASSERT_EQ(rows[row].size(), head.size());
    const Json& v = json["variants"][(row - 1) / 4];
    const Json& s = v["snapshots"][(row - 1) % 4];
    for (std::size_t column = 0; column < head.size(); ++column) {
      const std::string &name = head[column], &field = rows[row][column];
      const Json& expected =
          name == "variant" ? v["label"]
          : name.starts_with("slope")
              ? (v["slope"].is_null() ? v["slope"]
                                      : v["slope"][name == "slope" ? "value" : "error"])
          : v.contains(name) ? v[name]
                             : s.at(name);
      if (expected.is_null())
        EXPECT_EQ(field, "") << name;
      else if (expected.is_string())
        EXPECT_EQ(field, expected.get<std::string>());
      else
        EXPECT_EQ(std::stod(field), expected.get<double>()) << name;
    }
  }
}

TEST_F(ReportTest, TheTableIsAligned) {
  Json json = toJson(*report_);
  json["variants"][0]["label"] = std::string(70, 'x');
  json["variants"].erase(3);  // bytes are not columns there
  const std::string table = toTable(json);
  std::size_t lines = 0, length = table.find('\n');
  for (std::size_t at = 0, end; (end = table.find('\n', at)) != std::string::npos; at = end + 1) {
    EXPECT_EQ(end - at, length) << table;
    ++lines;
  }
  EXPECT_EQ(lines, 4U);
  EXPECT_NE(table.find("RMSE"), std::string::npos);
  EXPECT_NE(table.find(" +- "), std::string::npos);
}

TEST_F(ReportTest, ThePageIsSelfContained) {
  const std::string page = toHtml(toJson(*report_));
  std::smatch match;
  // What a browser would fetch; namespaces of XML are names only.
  const std::regex loaded(R"(<link|<iframe|<script[^>]+src|<img|@import|url\(|fetch\(|import )");
  EXPECT_FALSE(std::regex_search(page, match, loaded)) << match.str();
  const std::regex reference(R"re((href|src)="([^"]*)")re");
  for (std::sregex_iterator it(page.begin(), page.end(), reference), end; it != end; ++it)
    EXPECT_TRUE((*it)[2] == "report.csv" || (*it)[2] == "report.json") << it->str();
  const std::regex address(R"(https?://[^'"\s]*)");
  for (std::sregex_iterator it(page.begin(), page.end(), address), end; it != end; ++it)
    EXPECT_EQ(it->str(), "http://www.w3.org/2000/svg");
  for (const char* placeholder : {"/*STYLE*/", "= /*REPORT*/null"})
    EXPECT_EQ(page.find(placeholder), std::string::npos);
  // Two scripts begin and end, whatever labels say.
  const auto count = [&](const std::string& text) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = page.find(text, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  EXPECT_EQ(count("<script>"), 2U);
  EXPECT_EQ(count("</script>"), 2U);
  EXPECT_EQ(count("<!--"), 0U);
}

TEST_F(ReportTest, ABrowserShowsThePage) {
  const Folder folder;
  if (folder.command("which chromium").code != 0) GTEST_SKIP() << "there is no chromium";
  folder.write("page.html", toHtml(toJson(*report_)) + "<script>\n" +
                                contents(PBRT_SOURCE_DIR "/tests/tools/report/check.js") +
                                "</script>\n");
  const Outcome outcome = folder.command(
      "timeout 60 chromium --headless --no-sandbox --disable-gpu --user-data-dir=profile "
      "--dump-dom page.html");
  std::smatch result;
  ASSERT_TRUE(
      std::regex_search(outcome.out, result, std::regex(R"(<pre id="check">([^<]*)</pre>)")))
      << outcome.code << outcome.err;
  EXPECT_EQ(result[1], "PASS");
  EXPECT_NE(outcome.out.find("<title>PASS</title>"), std::string::npos);
}

}  // namespace
}  // namespace pbrt
