// The source files of the replay pages, as text; src/report/page/ holds them.
#pragma once

#include <string_view>

namespace outrider::page {

extern const std::string_view replay_html;
extern const std::string_view replay_css;
extern const std::string_view model_js;
extern const std::string_view camera_js;
extern const std::string_view plan_js;
extern const std::string_view side_js;
extern const std::string_view levels_js;
extern const std::string_view table_js;
extern const std::string_view transport_js;
extern const std::string_view replay_js;
extern const std::string_view chase_html;
extern const std::string_view chase_js;
extern const std::string_view discovery_js;
extern const std::string_view explore_html;
extern const std::string_view explore_js;

}  // namespace outrider::page
