#include "flags.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace outrider::cli {

std::string flag_of(const std::string& group, const std::string& option) {
  std::string flag = group.empty() ? option : group + "-" + option;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return "--" + flag;
}

void add_flags(CLI::App& app, const std::vector<OptionGroup>& groups, GivenFlags& given) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string flag = flag_of(group.name, option.name);
      const std::string value = value_text(option);
      const std::string help = fmt::format("{}{}", option.sentence, value.empty() ? "" : " [" + value + "]");
      const std::string heading = group.name.empty() ? "Mission" : group.sentence;
      if (std::holds_alternative<bool*>(option.value)) {
        const auto set = [&given, flag](std::int64_t) { given[flag] = "true"; };
        app.add_flag_function(flag, set, help)->group(heading);
      } else {
        const auto set = [&given, flag](const std::string& text) { given[flag] = text; };
        app.add_option_function<std::string>(flag, set, help)
            ->type_name(option.unit.empty() ? std::string(type_name(option)) : option.unit)
            ->group(heading);
      }
    }
  }
}

Status apply_flags(const GivenFlags& given, const std::vector<OptionGroup>& groups) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string flag = flag_of(group.name, option.name);
      const auto found = given.find(flag);
      if (found == given.end()) continue;
      if (auto ok = assign(option, found->second); !ok) {
        ok.error().where = flag;
        return ok;
      }
    }
  }
  return {};
}

}  // namespace outrider::cli
