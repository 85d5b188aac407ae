#include "files/yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <set>
#include <sstream>

#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

std::string where_of(const std::string& name, const YAML::Mark& mark) {
  return mark.is_null() ? name : fmt::format("{}:{}", name, mark.line + 1);
}

Status check_keys(const YAML::Node& map, const std::string& name) {
  std::set<std::string> seen;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) return bad_input("a key is no plain word", yaml_where(name, entry.first));
    if (!seen.insert(entry.first.Scalar()).second) {
      return bad_input(fmt::format("the key '{}' is given twice; leave one", excerpt(entry.first.Scalar())),
                       yaml_where(name, entry.first));
    }
    if (!entry.second.IsMap()) continue;
    if (entry.second.is(map)) return bad_input("a map holds itself", yaml_where(name, entry.first));
  }
  return {};
}

/// Ignores all events of a document.
struct Discard : YAML::EventHandler {
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
  }
  void OnMapEnd() override {}
};

/// Returns true if something follows the first document. (YAML::LoadAll never returns for some broken text.)
bool goes_on(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Discard discard;
  return parser.HandleNextDocument(discard) && parser.HandleNextDocument(discard);
}

Outcome<YAML::Node> parse(const std::string& text, const std::string& name) {
  try {
    if (goes_on(text)) return bad_input("something follows its first YAML document; leave one", name);
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    return bad_input(fmt::format("it is not well-formed YAML: {}", excerpt(error.msg)),
                     where_of(name, error.mark));
  }
}

}  // namespace

std::string yaml_where(const std::string& name, const YAML::Node& node) {
  return where_of(name, node.Mark());
}

Outcome<YAML::Node> yaml_map(std::string_view text, const std::string& name) {
  constexpr std::size_t most_bytes = std::size_t{1} << 20;
  if (text.size() > most_bytes) return bad_input("it is longer than 1 MiB, the most that is read", name);
  auto root = parse(std::string(text), name);
  if (!root || root->IsNull()) return root;
  if (!root->IsMap()) return bad_input("it is no list of 'key: value' lines", yaml_where(name, *root));
  if (auto keys = check_keys(*root, name); !keys) return pass_on(keys);
  for (const auto& entry : *root) {
    if (!entry.second.IsMap()) continue;
    if (auto keys = check_keys(entry.second, name); !keys) return pass_on(keys);
  }
  return root;
}

std::optional<std::string> yaml_text(const YAML::Node& node) {
  return node.IsDefined() && node.IsScalar() ? std::optional(node.Scalar()) : std::nullopt;
}

std::optional<double> yaml_number(const YAML::Node& node) {
  const auto text = yaml_text(node);
  return text ? number<double>(*text) : std::nullopt;
}

std::optional<std::vector<double>> yaml_numbers(const YAML::Node& list) {
  if (!list.IsDefined() || !list.IsSequence()) return std::nullopt;
  std::vector<double> numbers;
  for (const auto& entry : list) {
    const auto value = yaml_number(entry);
    if (!value) return std::nullopt;
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace outrider
