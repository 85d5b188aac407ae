#include "outrider/report/json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "json_cover.hpp"
#include "json_drive.hpp"
#include "json_explore.hpp"
#include "json_slam.hpp"
#include "json_terrain.hpp"
#include "json_yard.hpp"
#include "runs.hpp"

namespace outrider {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;

// The keys of every object, each named once: `io` writes or reads the member that it is given.
// io.drawn() is for what is only looked at: it is rounded to 1e-6. io.runs() is for the cells of a map.

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, PageReport>
void members(Io& io, T& report) {
  io("status", report.status);
  io("job", report.job);
  io("reason", report.reason);
  io.optional("sim", report.sim);
  io("seed", report.seed);
  io("metrics", report.metrics);
  io("targets", report.targets);
  io("settings", report.settings);
  io("warnings", report.warnings);
  io.object("world", [&](auto& world) {
    world("name", report.world_name);
    world("bounds", report.bounds);
    world("gravity_mps2", report.gravity_mps2);
    world("solids", report.solids);
    world.optional("terrain", report.terrain);
  });
  io.object("robot", [&](auto& robot) {
    robot("radius_m", report.robot_radius_m);
    robot("gun_length_m", report.gun_length_m);
    robot("ball_radius_m", report.ball_radius_m);
    robot("margin_m", report.margin_m);
    robot("start", report.start);
  });
  io("paths", report.paths);
  io("shots", report.shots);
  io("events", report.events);
  io("track", report.track);
  io.optional("supplies", report.supplies);
  io.optional("pursuit", report.pursuit);
  io.optional("drive", report.drive);
  io.optional("explore", report.explore);
  io.optional("cover", report.cover);
  io.optional("slam", report.slam);
}

class Writer {
 public:
  template <class T>
  void operator()(const char* key, const T& value) {
    json_[key] = written(value, false);
  }
  template <class T>
  void drawn(const char* key, const T& value) {
    json_[key] = written(value, true);
  }
  template <class T>
  void runs(const char* key, const std::vector<T>& value, int, int) {
    json_[key] = written(value, false);
  }
  template <class T>
  void optional(const char* key, const std::optional<T>& value) {
    if (value) json_[key] = written(*value, false);
  }
  template <class Fill>
  void object(const char* key, Fill fill) {
    Writer inner;
    fill(inner);
    json_[key] = std::move(inner.json_);
  }
  Json& json() { return json_; }

 private:
  static Json written(double value, bool round) {
    if (!std::isfinite(value)) return nullptr;
    const bool small = std::abs(value) < 1e9;
    const double kept = round && small ? std::round(value * 1e6) / 1e6 + 0.0 : value;
    return kept;
  }
  template <std::integral T>
  static Json written(T value, bool) {
    return value;
  }
  static Json written(const std::string& text, bool) { return text; }
  static Json written(Vec2 v, bool round) { return Json::array({written(v.x, round), written(v.y, round)}); }
  static Json written(Vec3 v, bool round) {
    return Json::array({written(v.x, round), written(v.y, round), written(v.z, round)});
  }
  static Json written(const Pose2& p, bool round) {
    return Json::array(
        {written(p.position.x, round), written(p.position.y, round), written(p.heading_rad, round)});
  }
  static Json written(const Box2& box, bool round) {
    return box.empty() ? Json(nullptr) : Json::array({written(box.low, round), written(box.high, round)});
  }
  static Json written(const TrackSample& s, bool) {
    Json row = Json::array();
    for (const double value : {s.time_s, s.pose.position.x, s.pose.position.y, s.pose.heading_rad,
                               s.gun_yaw_rad, s.gun_pitch_rad}) {
      row.push_back(written(value, true));
    }
    return row;
  }
  static Json written(const ReportLevel& l, bool) {
    return Json::array({written(l.time_s, true), written(l.water, true), written(l.charge_j, true)});
  }
  static Json written(const ReportCovered& c, bool) {
    return Json::array({written(c.time_s, true), written(c.covered_m2, true), written(c.overlap_m2, true)});
  }
  static Json written(const ReportBound& b, bool) {
    return Json::array({written(b.time_s, false), written(b.expansions, false), written(b.cost, false),
                        written(b.lower_bound, false)});
  }
  template <class T>
  static Json written(const std::vector<std::pair<std::string, T>>& entries, bool round) {
    Json table = Json::object();
    for (const auto& [name, value] : entries) table[name] = written(value, round);
    return table;
  }
  template <class T>
  static Json written(const std::vector<T>& items, bool round) {
    Json list = Json::array();
    for (const T& item : items) list.push_back(written(item, round));
    return list;
  }
  template <class T>
    requires requires(Writer& writer, const T& value) { members(writer, value); }
  static Json written(const T& value, bool) {
    Writer inner;
    members(inner, value);
    return std::move(inner.json_);
  }

  Json json_ = Json::object();
};

Json json_of(const PageReport& report) {
  Writer writer;
  writer("outrider_report", version);
  members(writer, report);
  return std::move(writer.json());
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// One line for each thing a person looks for, so that two reports compare line by line: the members
// of the first two levels of objects, and the elements of their arrays of things.
void lay_out(const Json& json, std::size_t depth, std::string& text) {
  const bool things = json.is_array() && !json.empty() && (json[0].is_structured() || json[0].is_string());
  if (json.empty() || !(things || json.is_object()) || depth > (things ? 2U : 1U)) {
    text += text_of(json);
    return;
  }
  std::string indent(2 * (depth + 1) + 1, ' ');
  indent.front() = '\n';
  text += things ? '[' : '{';
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    if (!first) text += ',';
    text += indent;
    if (!things) text += text_of(key) + ": ";
    lay_out(value, things ? 3 : depth + 1, text);
    first = false;
  }
  text += indent.substr(0, indent.size() - 2) + (things ? ']' : '}');
}

// A value in the text and the way to it, for faults: targets[3].pose[1].
struct Place {
  const Json& json;
  std::optional<Fault>& refusal;  // the first one found
  const Place* parent = nullptr;
  std::string key;  // empty for an element of an array
  std::size_t index = 0;

  [[nodiscard]] std::string path() const {
    if (parent == nullptr) return key;
    const std::string before = parent->path();
    if (key.empty()) return fmt::format("{}[{}]", before, index);
    return before.empty() ? key : before + "." + key;
  }
  void refuse(std::string sentence) const {
    if (!refusal) refusal = Fault{FaultCode::bad_input, std::move(sentence), path()};
  }
  [[nodiscard]] Place at(std::size_t i) const { return {json[i], refusal, this, {}, i}; }
};

bool expect(const Place& place, bool right, std::string_view wanted) {
  if (!right) place.refuse(fmt::format("this is {}, but it must be {}", place.json.type_name(), wanted));
  return right;
}

class Reader {
 public:
  explicit Reader(const Place& place) : place_(place) {}

  template <class T>
  void operator()(const char* key, T& value) {
    visit(key, [&](const Place& at) { read(at, value, false); });
  }
  template <class T>
  void drawn(const char* key, T& value) {
    visit(key, [&](const Place& at) { read(at, value, true); });
  }
  template <class T>
  void runs(const char* key, std::vector<T>& value, int columns, int rows) {
    visit(key, [&](const Place& at) {
      read(at, value, true);
      if (at.refusal) return;
      if (auto fault = fault_of_runs(value, columns, rows)) at.refuse(std::move(*fault));
    });
  }
  template <class T>
  void optional(const char* key, std::optional<T>& value) {
    if (place_.json.contains(key)) visit(key, [&](const Place& at) { read(at, value.emplace(), true); });
  }
  template <class Fill>
  void object(const char* key, Fill fill) {
    visit(key, [&](const Place& at) {
      if (!expect(at, at.json.is_object(), "an object")) return;
      Reader inner(at);
      fill(inner);
    });
  }

  template <class T>
    requires requires(Reader& reader, T& value) { members(reader, value); }
  static void read(const Place& place, T& value, bool) {
    if (!expect(place, place.json.is_object(), "an object")) return;
    Reader inner(place);
    members(inner, value);
  }

 private:
  template <class Use>
  void visit(const char* key, Use use) {
    if (place_.refusal) return;
    const auto found = place_.json.find(key);
    const bool missing = found == place_.json.end();
    static const Json nothing;
    const Place at{missing ? nothing : *found, place_.refusal, &place_, key};
    if (missing) {
      at.refuse("this key is missing; the file was cut or written by something else");
    } else {
      use(at);
    }
  }

  // null stands for a number that is not known, except in what is drawn
  static void read(const Place& place, double& value, bool drawn) {
    if (!drawn && place.json.is_null()) {
      value = std::numeric_limits<double>::quiet_NaN();
    } else if (expect(place, place.json.is_number(), drawn ? "a number" : "a number or null")) {
      value = place.json.get<double>();
    }
  }
  static void read(const Place& place, bool& value, bool) {
    if (expect(place, place.json.is_boolean(), "true or false")) value = place.json.get<bool>();
  }
  static void read(const Place& place, std::string& value, bool) {
    if (expect(place, place.json.is_string(), "a string")) value = place.json.get<std::string>();
  }
  static void read(const Place& place, std::uint64_t& value, bool) {
    if (expect(place, place.json.is_number_unsigned(), "a whole number from 0 to 2^64 - 1")) {
      value = place.json.get<std::uint64_t>();
    }
  }
  static void read(const Place& place, std::int64_t& value, bool) {
    if (expect(place, place.json.is_number_integer(), "a whole number")) {
      value = place.json.get<std::int64_t>();
    }
  }
  static void read(const Place& place, int& value, bool) {
    constexpr std::uint64_t most = 1'000'000'000;
    const bool right = place.json.is_number_unsigned() && place.json.get<std::uint64_t>() <= most;
    if (expect(place, right, "a whole number from 0 to 1e9")) value = place.json.get<int>();
  }
  template <std::size_t N>
  static void read(const Place& place, const std::array<double*, N>& values, bool drawn) {
    const bool right = place.json.is_array() && place.json.size() == N;
    if (!expect(place, right, fmt::format("an array of {} numbers", N))) return;
    for (std::size_t i = 0; i < N; ++i) read(place.at(i), *values[i], drawn);
  }
  static void read(const Place& place, Vec2& v, bool) { read(place, std::array{&v.x, &v.y}, true); }
  static void read(const Place& place, Vec3& v, bool drawn) {
    read(place, std::array{&v.x, &v.y, &v.z}, drawn);
  }
  static void read(const Place& place, Pose2& p, bool drawn) {
    read(place, std::array{&p.position.x, &p.position.y, &p.heading_rad}, drawn);
  }
  static void read(const Place& place, Box2& box, bool) {
    if (place.json.is_null()) {
      box = Box2{};
    } else if (expect(place, place.json.is_array() && place.json.size() == 2, "null or two corners")) {
      read(place.at(0), box.low, true);
      read(place.at(1), box.high, true);
    }
  }
  static void read(const Place& place, TrackSample& s, bool) {
    read(place,
         std::array{&s.time_s, &s.pose.position.x, &s.pose.position.y, &s.pose.heading_rad, &s.gun_yaw_rad,
                    &s.gun_pitch_rad},
         true);
  }
  static void read(const Place& place, ReportLevel& l, bool) {
    read(place, std::array{&l.time_s, &l.water, &l.charge_j}, false);
  }
  static void read(const Place& place, ReportCovered& c, bool) {
    read(place, std::array{&c.time_s, &c.covered_m2, &c.overlap_m2}, true);
  }
  static void read(const Place& place, ReportBound& b, bool) {
    read(place, std::array{&b.time_s, &b.expansions, &b.cost, &b.lower_bound}, false);
  }
  template <class T>
  static void read(const Place& place, std::vector<std::pair<std::string, T>>& entries, bool drawn) {
    if (!expect(place, place.json.is_object(), "an object")) return;
    entries.clear();
    for (const auto& [key, value] : place.json.items()) {
      entries.emplace_back(key, T{});
      read(Place{value, place.refusal, &place, key}, entries.back().second, drawn);
    }
  }
  template <class T>
  static void read(const Place& place, std::vector<T>& items, bool drawn) {
    if (!expect(place, place.json.is_array(), "an array")) return;
    items.assign(place.json.size(), T{});
    for (std::size_t i = 0; i < items.size() && !place.refusal; ++i) read(place.at(i), items[i], drawn);
  }

  const Place& place_;
};

Status check_version(const Json& json) {
  const auto found = json.is_object() ? json.find("outrider_report") : json.end();
  if (found == json.end()) {
    return bad_input("this is not a report: it is no JSON object with the key 'outrider_report'");
  }
  if (*found != version) {
    return bad_input(fmt::format("report version {} is not known; this program reads version {}",
                                 text_of(*found).substr(0, 20), version),
                     "outrider_report");
  }
  return {};
}

}  // namespace

std::string to_json(const PageReport& report) {
  std::string text;
  lay_out(json_of(report), 0, text);
  return text + "\n";
}

Outcome<PageReport> report_from_json(std::string_view text) {
  Json json;
  try {  // the library reports syntax by exception
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    return bad_input(
        fmt::format("the report is no valid JSON: {}", std::string(error.what()).substr(0, 200)));
  }
  if (auto status = check_version(json); !status) return pass_on(status);
  std::optional<Fault> refusal;
  PageReport report;
  Reader::read(Place{json, refusal, nullptr, {}}, report, false);
  if (refusal) return tl::unexpected<Fault>(std::move(*refusal));
  return report;
}

}  // namespace outrider
