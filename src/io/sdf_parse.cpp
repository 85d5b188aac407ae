#include "sdf_parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <mutex>
#include <sdf/sdf.hh>
#include <sstream>

#include "outrider/io/text.hpp"
#include "sdf_parts.hpp"

namespace outrider {
namespace {

/// Discards all output to std::cerr during its lifetime. There is one at a time: others wait.
class MutedErrors {
 public:
  MutedErrors() : lock_(mutex()), before_(std::cerr.rdbuf(sink_.rdbuf())) {}
  MutedErrors(const MutedErrors&) = delete;
  MutedErrors& operator=(const MutedErrors&) = delete;
  ~MutedErrors() { std::cerr.rdbuf(before_); }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }

  std::lock_guard<std::mutex> lock_;
  std::ostringstream sink_;
  std::streambuf* before_;
};

/// Returns the description of SDF 1.9 from sdformat, which is read once.
const sdf::Element& whole_schema() {
  static const sdf::SDFPtr schema = [] {
    auto read = std::make_shared<sdf::SDF>();
    sdf::init(read);
    return read;
  }();
  return *schema->Root();
}

/// Returns true for elements that repair_sdf() may leave in the text under this parent, and for those that
/// sdformat adds if they are missing.
bool is_described(const std::string& parent, const sdf::Element& child, const SdfCounts& counts) {
  if (one_of(child.GetRequired(), {"1", "+"})) return true;
  if (!sdf_matters(parent, child.GetName())) return false;
  // Conversions from older versions never create one of these.
  const bool as_written =
      parent == "geometry" || is_sdf_part(child.GetName()) || child.GetName() == "include";
  return !as_written || counts.by_kind.contains(child.GetName());
}

/// Copies a description, with only the children for which is_described() is true and `model_levels` levels of
/// nested models.
sdf::ElementPtr cut_down(const sdf::Element& whole, const SdfCounts& counts, int model_levels) {
  auto copy = std::make_shared<sdf::Element>();
  copy->SetName(whole.GetName());
  copy->SetRequired(whole.GetRequired());
  copy->SetCopyChildren(whole.GetCopyChildren());
  copy->SetReferenceSDF(whole.ReferenceSDF());
  for (unsigned int i = 0; i < whole.GetAttributeCount(); ++i) {
    const sdf::Param& attribute = *whole.GetAttribute(i);
    copy->AddAttribute(attribute.GetKey(), attribute.GetTypeName(), attribute.GetDefaultAsString(),
                       attribute.GetRequired());
  }
  if (const sdf::ParamPtr value = whole.GetValue()) {
    copy->AddValue(value->GetTypeName(), value->GetDefaultAsString(), value->GetRequired(),
                   value->GetMinValueAsString().value_or(""), value->GetMaxValueAsString().value_or(""));
  }
  for (unsigned int i = 0; i < whole.GetElementDescriptionCount(); ++i) {
    const sdf::Element& child = *whole.GetElementDescription(i);
    if (!is_described(whole.GetName(), child, counts)) continue;
    const bool nested = whole.GetName() == "model" && child.GetName() == "model" && model_levels > 1;
    // In the library, the description of a nested model is a reference to that of a model.
    copy->AddElementDescription(nested ? cut_down(whole, counts, model_levels - 1)
                                       : cut_down(child, counts, model_levels));
  }
  return copy;
}

sdf::Errors load(sdf::Root& root, const RepairedSdf& repaired) {
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::LOG);
  auto document = std::make_shared<sdf::SDF>();
  const int levels = std::min(repaired.counts.model_levels, described_model_levels);
  document->Root(cut_down(whole_schema(), repaired.counts, levels));
  sdf::Errors errors;
  if (!sdf::readString(repaired.text, config, document, errors)) {
    errors.emplace_back(sdf::ErrorCode::STRING_READ, "Unable to read SDF string.");
    return errors;
  }
  const sdf::Errors of_meaning = root.Load(document, config);
  errors.insert(errors.end(), of_meaning.begin(), of_meaning.end());
  return errors;
}

}  // namespace

Outcome<sdf::Root> parse_sdf(const RepairedSdf& repaired, const std::string& file) {
  const MutedErrors muted;
  try {
    sdf::Root root;
    const sdf::Errors errors = load(root, repaired);
    if (!errors.empty()) {
      const auto line = errors.front().LineNumber();
      return bad_input(fmt::format("sdformat refuses it: {}", excerpt(errors.front().Message(), 200)),
                       line ? fmt::format("{}:{}", file, *line) : file);
    }
    return root;
  } catch (const std::exception& error) {
    return bad_input(fmt::format("sdformat refuses it: {}", excerpt(error.what(), 200)), file);
  } catch (const sdf::Exception& error) {
    return bad_input(fmt::format("sdformat refuses it: {}", excerpt(error.GetErrorStr(), 200)), file);
  }
}

}  // namespace outrider
