#include "outrider/report/json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "sample_report.hpp"

namespace outrider {
namespace {

const std::vector<std::string> top_keys = {"outrider_report", "status",  "job",      "reason",   "seed",
                                           "metrics",         "targets", "settings", "warnings", "world",
                                           "robot",           "paths",   "shots",    "events",   "track"};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_refused(const std::string& text, const std::string& where, const std::string& word) {
  const auto report = report_from_json(text);
  ASSERT_FALSE(report) << where;
  EXPECT_EQ(report.error().code, FaultCode::bad_input);
  EXPECT_EQ(report.error().where, where);
  EXPECT_NE(report.error().sentence.find(word), std::string::npos) << report.error().sentence;
}

TEST(ReportJson, ReadsBackByteEqual) {
  const std::string text = to_json(test::sample_report());
  const auto report = report_from_json(text);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(to_json(*report), text);
}

TEST(ReportJson, KeepsShotsAndTargetsExactly) {
  const PageReport before = test::sample_report();
  const auto after = report_from_json(to_json(before));
  ASSERT_TRUE(after);
  EXPECT_EQ(after->seed, before.seed);
  EXPECT_EQ(after->metrics, before.metrics);
  EXPECT_EQ(after->settings, before.settings);
  EXPECT_EQ(after->warnings, before.warnings);
  EXPECT_EQ(after->start, before.start);
  ASSERT_EQ(after->shots.size(), before.shots.size());
  for (std::size_t i = 0; i < before.shots.size(); ++i) {
    EXPECT_EQ(after->shots[i].time_s, before.shots[i].time_s);
    EXPECT_EQ(after->shots[i].muzzle, before.shots[i].muzzle);
    EXPECT_EQ(after->shots[i].velocity_mps, before.shots[i].velocity_mps);
    EXPECT_EQ(after->shots[i].contact_point, before.shots[i].contact_point);
    EXPECT_EQ(after->shots[i].contact, before.shots[i].contact);
    EXPECT_EQ(after->shots[i].profile.size(), before.shots[i].profile.size());
  }
  ASSERT_EQ(after->targets.size(), before.targets.size());
  for (std::size_t i = 0; i < before.targets.size(); ++i) {
    EXPECT_EQ(after->targets[i].pose, before.targets[i].pose);
    EXPECT_EQ(after->targets[i].shot_yaw_rad, before.targets[i].shot_yaw_rad);
    EXPECT_EQ(after->targets[i].yaw_rad, before.targets[i].yaw_rad);
    EXPECT_EQ(after->targets[i].clearance_m, before.targets[i].clearance_m);
  }
  ASSERT_EQ(after->track.size(), before.track.size());
  for (std::size_t i = 0; i < before.track.size(); ++i) {
    EXPECT_NEAR(after->track[i].time_s, before.track[i].time_s, 0.6e-6);
    EXPECT_NEAR(distance(after->track[i].pose.position, before.track[i].pose.position), 0.0, 1e-6);
    EXPECT_NEAR(after->track[i].gun_pitch_rad, before.track[i].gun_pitch_rad, 0.6e-6);
  }
}

TEST(ReportJson, ReadsBackTheEmptyReport) {
  const auto report = report_from_json(to_json(PageReport{}));
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_TRUE(report->bounds.empty());
  EXPECT_EQ(to_json(*report), to_json(PageReport{}));
}

TEST(ReportJson, HasItsKeysInOrderEachOnALine) {
  const std::string text = to_json(test::sample_report());
  std::size_t before = 0;
  for (const std::string& key : top_keys) {
    const std::size_t at = text.find("\n  \"" + key + "\": ");
    ASSERT_NE(at, std::string::npos) << key;
    EXPECT_TRUE(before < at || before == 0) << key;
    before = at;
  }
}

TEST(ReportJson, WritesNumbersThatAreNoneAsNull) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  constexpr double endless = std::numeric_limits<double>::infinity();
  PageReport report = test::sample_report();
  report.metrics.emplace_back("ratio", none);
  report.targets[0].clearance_m = endless;
  report.targets[1].pose = {{none, none}, none};
  report.shots[0].contact_point = {none, -endless, 1.0};
  report.solids[0].low_z_m = -endless;
  const std::string text = to_json(report);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
  const auto back = report_from_json(text);
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_TRUE(std::isnan(back->metrics.back().second));
  EXPECT_TRUE(std::isnan(back->targets[0].clearance_m));
  EXPECT_TRUE(std::isnan(back->targets[1].pose.heading_rad));
  EXPECT_EQ(to_json(*back), text);

  report.track[3].pose.position.x = none;
  expect_refused(to_json(report), "track[3][1]", "null");
}

TEST(ReportJson, RefusesEveryMissingTopKey) {
  const std::string text = to_json(test::sample_report());
  for (const std::string& key : top_keys) {
    const std::string without = replaced(text, "\n  \"" + key + "\"", "\n  \"no_" + key + "\"");
    expect_refused(without, key == "outrider_report" ? "" : key,
                   key == "outrider_report" ? "not a report" : "missing");
  }
}

TEST(ReportJson, RefusesWithThePathOfTheKey) {
  const std::string text = to_json(test::sample_report());
  expect_refused(replaced(text, "\"outrider_report\": 1", "\"outrider_report\": 2"), "outrider_report",
                 "version 2");
  expect_refused(replaced(text, "\"seed\": 18446744073709551557", "\"seed\": -1"), "seed", "whole number");
  expect_refused(replaced(text, "\"seed\": 18446744073709551557", "\"seed\": \"1\""), "seed", "string");
  expect_refused(replaced(text, "\"failed\": 1.0", "\"failed\": true"), "metrics.failed", "boolean");
  expect_refused(replaced(text, "\"gravity_mps2\": 9.8", "\"gravity_mps2\": []"), "world.gravity_mps2",
                 "array");
  expect_refused(replaced(text, "\"name\":\"cat_crate\"", "\"name\":7"), "targets[1].name", "number");
  expect_refused(replaced(text, "\"name\":\"cat_crate\",", ""), "targets[1].name", "missing");
  expect_refused(replaced(text, "\"attempt\":1,", "\"attempt\":1.5,"), "shots[0].attempt", "whole");
  expect_refused(replaced(text, "\"attempt\":1,", "\"attempt\":5000000000,"), "shots[0].attempt", "1e9");
  expect_refused(replaced(text, "\"pose\":[", "\"pose\":[1,"), "targets[0].pose", "3 numbers");
  expect_refused(replaced(text, "\"core\":[[", "\"core\":[[null,"), "world.solids[1].footprint[0].core[0]",
                 "2 numbers");
}

TEST(ReportJson, IgnoresKeysThatOthersAdd) {
  const std::string text = to_json(test::sample_report());
  const auto report = report_from_json(replaced(text, "\"seed\"", "\"note\": {\"by\": [1]}, \"seed\""));
  ASSERT_TRUE(report);
  EXPECT_EQ(to_json(*report), text);
}

TEST(ReportJson, RefusesWhatIsNoReport) {
  for (const std::string text : {"", "null", "[]", "{}", "7", "{\"status\": 1}", "\xff\xfe", "{\"a\": 1e999}",
                                 "{\"outrider_report\": [1]}"}) {
    EXPECT_FALSE(report_from_json(text)) << text;
  }
  EXPECT_FALSE(report_from_json(std::string(100000, '[')));
  const std::string text = to_json(test::sample_report());
  for (std::size_t cut = 0; cut + 2 < text.size(); cut += 997) {
    EXPECT_FALSE(report_from_json(text.substr(0, cut))) << cut;
  }
}

TEST(ReportJson, MendsNamesThatAreNoUtf8) {
  PageReport report = test::sample_report();
  report.targets[0].name = "cat \xff\xfe";
  report.world_name = "a \"quoted\"\n\x01 yard";
  const std::string text = to_json(report);
  const auto back = report_from_json(text);
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(back->world_name, report.world_name);
  EXPECT_EQ(back->targets[0].name, "cat \xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(to_json(*back), text);
}

TEST(ReportJson, IsDescribedInTheDocs) {
  const auto docs = std::filesystem::path(__FILE__).parent_path() / "../../../docs/report.md";
  std::ifstream file(docs);
  std::stringstream manual;
  manual << file.rdbuf();
  ASSERT_FALSE(manual.str().empty()) << docs;
  for (const std::string& key : top_keys) {
    EXPECT_NE(manual.str().find("`" + key + "`"), std::string::npos) << key << " is not in docs/report.md";
  }
  // and every key of the objects inside
  const std::string text = to_json(test::sample_report());
  for (std::size_t at = text.find("\n  \"targets\""); (at = text.find("\":", at)) != std::string::npos;
       ++at) {
    const std::size_t quote = text.rfind('"', at - 1);
    const std::string key = text.substr(quote + 1, at - quote - 1);
    const std::size_t settings = text.find("\n  \"settings\"");
    const std::size_t warnings = text.find("\n  \"warnings\"");
    if (at > settings && at < warnings) continue;  // names of options
    EXPECT_NE(manual.str().find(key), std::string::npos) << key << " is not in docs/report.md";
  }
}

}  // namespace
}  // namespace outrider
