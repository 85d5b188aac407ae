#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "outrider/report/run_json.hpp"

namespace outrider {
namespace {

using Json = nlohmann::ordered_json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Report sample() {
  Report report;
  report.status = "not_done";
  report.job = "guard";
  report.reason = "1 of 2 \"targets\" reached";
  report.world_name = "a yard";
  report.settings = {{"seed", "7"}, {"robot.radius", "0.26 m"}};
  report.warnings = {"a mesh is open", "another one is, too"};
  report.metrics = {{"mission_s", 12.345678901234567}, {"shots", 3.0}, {"gap", none}};
  const std::vector<Vec2> way = {{0.0, 0.5}, {1.0, 2.0}};
  const std::vector<TableArc> arcs = {{{0.0, 0.5}, {1.0, 2.0}, {}, 0.0},
                                      {{1.0, 2.0}, {2.0, 1.0}, {1.0, 1.0}, -0.5 * M_PI}};
  report.tables = {{"targets",
                    {"name", "done_s", "place"},
                    {{"cat", 3.25, Vec2{1.0, -2.0}}, {"dog", none, Vec2{0.1, 0.2}}}},
                   {"rows", {"query", "waypoints", "pieces"}, {{1.0, way, arcs}}}};
  return report;
}

/// As a run leaves it.
Json result_of(const Report& report) {
  Json object = run_json<Json>(report);
  object.erase("files");
  object["settings"] = Json::object();
  for (const auto& [key, value] : report.settings) object["settings"][key] = value;
  return object;
}

void expect_equal(const TableValue& a, const TableValue& b) {
  ASSERT_EQ(a.index(), b.index());
  const auto* number = std::get_if<double>(&a);
  if (number != nullptr && std::isnan(*number)) {
    EXPECT_TRUE(std::isnan(std::get<double>(b)));
  } else {
    EXPECT_TRUE(a == b);
  }
}

TEST(ReadRunJson, ReadsBackWhatWasWritten) {
  const Report before = sample();
  const std::string text = result_of(before).dump(1);
  const auto after = read_run_json(text, "run.json");
  ASSERT_TRUE(after) << to_string(after.error());
  EXPECT_EQ(after->status, before.status);
  EXPECT_EQ(after->job, before.job);
  EXPECT_EQ(after->reason, before.reason);
  EXPECT_EQ(after->world_name, before.world_name);
  EXPECT_EQ(after->settings, before.settings);
  EXPECT_EQ(after->warnings, before.warnings);
  ASSERT_EQ(after->metrics.size(), before.metrics.size());
  EXPECT_EQ(after->metrics[0], before.metrics[0]);
  EXPECT_EQ(after->metrics[1], before.metrics[1]);
  EXPECT_TRUE(std::isnan(metric(*after, "gap")));
  ASSERT_EQ(after->tables.size(), before.tables.size());
  for (std::size_t i = 0; i < before.tables.size(); ++i) {
    const Table &was = before.tables[i], &is = after->tables[i];
    EXPECT_EQ(is.name, was.name);
    EXPECT_EQ(is.columns, was.columns);
    ASSERT_EQ(is.rows.size(), was.rows.size());
    for (std::size_t row = 0; row < was.rows.size(); ++row) {
      ASSERT_EQ(is.rows[row].size(), was.rows[row].size());
      for (std::size_t k = 0; k < was.rows[row].size(); ++k) expect_equal(was.rows[row][k], is.rows[row][k]);
    }
  }
  EXPECT_EQ(result_of(*after).dump(1), text);
}

TEST(ReadRunJson, TablesWithoutRowsAndWithoutAColumnAreRead) {
  Json object = result_of(sample());
  object["refused"] = Json::array();
  object["targets"][1].erase("place");
  const auto report = read_run_json(object.dump(), "run.json");
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_TRUE(table_named(*report, "refused").rows.empty());
  const Table& targets = table_named(*report, "targets");
  EXPECT_TRUE(std::isnan(TableRow{targets, targets.rows[1]}.number("place")));
}

TEST(ReadRunJson, WarningsAreNoTable) {
  Report report = sample();
  report.warnings.clear();
  const auto read = read_run_json(result_of(report).dump(), "run.json");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->tables.size(), report.tables.size());
}

void expect_refused(const std::string& text, const std::string& says) {
  const auto read = read_run_json(text, "old/run.json");
  ASSERT_FALSE(read) << text;
  EXPECT_EQ(read.error().code, FaultCode::bad_input);
  EXPECT_EQ(read.error().where, "old/run.json");
  EXPECT_NE(read.error().sentence.find(says), std::string::npos) << read.error().sentence;
}

TEST(ReadRunJson, RefusesWhatIsNoJsonObject) {
  const std::string whole = result_of(sample()).dump();
  for (const std::string& text : {std::string(), std::string("[]"), std::string("7"), std::string("\xff{"),
                                  whole.substr(0, whole.size() / 2)}) {
    expect_refused(text, "not a JSON object");
  }
  expect_refused(std::string(100'000, '['), "nests more than 100 deep");
  const std::string deep =
      "\"settings\": {\"a\": " + std::string(300'000, '[') + std::string(300'000, ']') + "}, ";
  expect_refused(whole.substr(0, 1) + deep + whole.substr(1), "nests more than 100 deep");
}

TEST(ReadRunJson, RefusesAReportOfAnOlderVersion) {
  expect_refused(R"({"outrider_report": 1, "status": "done", "job": "guard", "metrics": {}})",
                 "older version");
}

TEST(ReadRunJson, RefusesAMissingKeyAndAWrongType) {
  const Json whole = result_of(sample());
  for (const char* key : {"status", "job", "world", "reason", "metrics", "settings", "warnings"}) {
    Json object = whole;
    object.erase(key);
    if (std::string(key) == "settings") {
      EXPECT_TRUE(read_run_json(object.dump(), "run.json")) << "what --json prints has none";
    } else {
      expect_refused(object.dump(), "a key is missing or has the wrong type");
    }
    object[key] = 7;
    if (std::string(key) == "metrics" || std::string(key) == "settings")
      object[key] = Json::array({Json::array()});
    expect_refused(object.dump(), "a key is missing or has the wrong type");
  }
}

}  // namespace
}  // namespace outrider
