#include <yaml-cpp/yaml.h>

#include <fstream>
#include <set>

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

const std::string docs = std::string(OUTRIDER_SOURCE_DIR) + "/docs/";

std::set<std::string> methods_in(const YAML::Node& item) {
  std::set<std::string> methods;
  for (const auto& entry : item) {
    const auto key = entry.first.as<std::string>();
    if (key != "parameters") methods.insert(key);
  }
  return methods;
}

/// Each $ref below the node leads to something, here or in the schemas.
void expect_references(const YAML::Node& node, const YAML::Node& document, const Json& schemas, int& seen) {
  for (const auto& entry : node) {
    if (!node.IsMap()) {
      expect_references(entry, document, schemas, seen);
    } else if (entry.first.as<std::string>() == "$ref") {
      ++seen;
      const auto target = entry.second.as<std::string>();
      const std::string in_schemas = "server.schema.json#/$defs/", here = "#/components/responses/";
      if (target.starts_with(in_schemas)) {
        EXPECT_TRUE(schemas["$defs"].contains(target.substr(in_schemas.size()))) << target;
      } else {
        ASSERT_TRUE(target.starts_with(here)) << target;
        EXPECT_TRUE(document["components"]["responses"][target.substr(here.size())]) << target;
      }
    } else {
      expect_references(entry.second, document, schemas, seen);
    }
  }
}

/// Each $ref within the schemas leads to one of them.
void expect_schema_references(const Json& node, const Json& schemas, int& seen) {
  const std::string prefix = "#/$defs/";
  for (const auto& [key, value] : node.items()) {
    if (key == "$ref") {
      ++seen;
      EXPECT_TRUE(schemas["$defs"].contains(value.get<std::string>().substr(prefix.size()))) << value;
    } else if (value.is_structured()) {
      expect_schema_references(value, schemas, seen);
    }
  }
}

TEST(OpenApi, HoldsEveryRouteAndNoOther) {
  const YAML::Node document = YAML::LoadFile(docs + "openapi.yaml");
  EXPECT_EQ(document["openapi"].as<std::string>(), "3.1.0");
  EXPECT_TRUE(document["info"]["title"] && document["info"]["version"]);
  std::set<std::string> described, routed;
  for (const auto& item : document["paths"]) {
    for (std::string method : methods_in(item.second)) {
      const auto path = item.first.as<std::string>();
      const YAML::Node operation = item.second[method];
      EXPECT_TRUE(operation["summary"] && operation["responses"]) << path;
      for (char& c : method) c = static_cast<char>(std::toupper(c));
      described.insert(method + " " + path);
    }
  }
  for (const Route& route : App::routes()) routed.insert(route.method + " " + route.pattern);
  EXPECT_EQ(described, routed);
}

TEST(OpenApi, NamesInPathsAreParameters) {
  const YAML::Node document = YAML::LoadFile(docs + "openapi.yaml");
  for (const auto& item : document["paths"]) {
    const auto path = item.first.as<std::string>();
    std::set<std::string> named, parameters;
    for (std::size_t at = path.find('{'); at != std::string::npos; at = path.find('{', at + 1)) {
      named.insert(path.substr(at + 1, path.find('}', at) - at - 1));
    }
    for (const auto& parameter : item.second["parameters"]) {
      EXPECT_EQ(parameter["in"].as<std::string>(), "path");
      EXPECT_TRUE(parameter["required"].as<bool>());
      parameters.insert(parameter["name"].as<std::string>());
    }
    EXPECT_EQ(named, parameters) << path;
  }
}

TEST(OpenApi, ReferencesLeadSomewhere) {
  const YAML::Node document = YAML::LoadFile(docs + "openapi.yaml");
  std::ifstream file(docs + "server.schema.json");
  const Json schemas = Json::parse(file);
  int seen = 0;
  expect_references(document, document, schemas, seen);
  EXPECT_GT(seen, 20);
  seen = 0;
  expect_schema_references(schemas, schemas, seen);
  EXPECT_GT(seen, 20);
}

}  // namespace
}  // namespace outrider::server
