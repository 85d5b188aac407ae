// Options describe themselves once; flags, scenario keys, schema, docs and bindings are derived.
//
// An options aggregate is a plain struct with defaults. Beside it stands one function
//     std::vector<Option> describe(MyOptions& options);
// that lists each member with its name, unit, range and sentence, and points at the member of the
// given instance. Whoever needs names, defaults, parsing or documentation walks that list.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// One member of an options aggregate. Angles are stored in radians; their unit is "deg" and every
/// text form (flag, key, schema, docs) is in degrees.
struct Option {
  std::string name;      ///< snake_case, e.g. "muzzle_speed"; the flag is --gun-muzzle-speed
  std::string unit;      ///< "m", "s", "m/s", "deg", ... or empty
  double low = 0.0;      ///< least allowed value in `unit`; numbers only
  double high = 0.0;     ///< largest allowed value in `unit`; numbers only
  std::string sentence;  ///< what it is, without the unit and the default
  std::variant<double*, std::int64_t*, bool*, std::string*> value;
  bool names_file = false;  ///< the text is the path of a file; in a scenario it is relative to that
};

/// An option whose text is the path of a file to read.
Option file_option(std::string name, std::string sentence, std::string* path);

/// A named set of options: a section of a scenario file and the prefix of its flags.
struct OptionGroup {
  std::string name;
  std::string sentence;
  std::vector<Option> options;
};

/// Reads `text` into the member. The fault names the option, the value, the unit and the range; the
/// member is untouched then. NaN and infinities are refused.
Status assign(const Option& option, std::string_view text);

/// The member's present value as text, shortest form that reads back the same (degrees for "deg").
std::string value_text(const Option& option);

/// "number", "integer", "boolean" or "string": the JSON schema type.
std::string_view type_name(const Option& option);

/// The known name nearest to `unknown` by edit distance, or empty when none is close: the "did you
/// mean" of every bad key, flag or planner name.
std::string nearest_name(std::string_view unknown, const std::vector<std::string>& known);

/// The refusal of a name that a catalogue does not have: "there is no planner 'x'; did you mean ...".
/// `kind` is the word for a row, `where` the key that took the name.
tl::unexpected<Fault> no_such_row(std::string_view kind, std::string_view unknown,
                                  const std::vector<std::string>& known, std::string where);

/// The row of a catalogue with that `name`; bad_input when there is none.
template <class Row>
Outcome<Row> find_row(const std::vector<Row>& rows, std::string_view kind, std::string_view name,
                      std::string where) {
  std::vector<std::string> known;
  for (const Row& row : rows) {
    if (row.name == name) return row;
    known.emplace_back(row.name);
  }
  return no_such_row(kind, name, known, std::move(where));
}

}  // namespace outrider
