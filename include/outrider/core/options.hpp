// Option: the description of one option. Flags, scenario keys, schemas, documentation and bindings are all
// derived from such descriptions.
//
// An options struct is a plain struct with defaults. Next to it there is one function
//     std::vector<Option> describe(MyOptions& options);
// that lists each member with its name, unit, range and sentence, and with a pointer to the member of the
// given instance.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// One member of an options struct. Angles are stored in radians; their unit is "deg", and every text form
/// (flag, key, schema, docs) is in degrees.
struct Option {
  std::string name;      ///< snake_case, e.g. "muzzle_speed"; the flag is --gun-muzzle-speed
  std::string unit;      ///< "m", "s", "m/s", "deg", ... or empty
  double low = 0.0;      ///< smallest allowed value in `unit`; numbers only
  double high = 0.0;     ///< largest allowed value in `unit`; numbers only
  std::string sentence;  ///< what the option means, without the unit and the default
  std::variant<double*, std::int64_t*, bool*, std::string*> value;  ///< points to the member
  bool names_file =
      false;  ///< the value is the path of a file; in a scenario it is relative to the scenario file
  std::vector<std::string> choices = {};  ///< names of which the text is one; empty if it may be any
};

/// Makes an option whose value is the path of a file to read.
Option file_option(std::string name, std::string sentence, std::string* path);

/// Makes an option whose value is one of these names.
Option choice_option(std::string name, std::string sentence, std::string* value,
                     std::vector<std::string> choices);

/// A named set of options: a section of a scenario file and the prefix of its flags.
struct OptionGroup {
  std::string name;
  std::string sentence;
  std::vector<Option> options;
};

/// Parses `text` into the member. Fault: bad_input, which names the option, the value, the unit and the
/// range; the member then keeps its value. Refuses NaN and infinities.
Status assign(const Option& option, std::string_view text);

/// Returns the present value as text, in the shortest form that parses to the same value (degrees for "deg").
std::string value_text(const Option& option);

/// Checks that the present values could be assigned; the options are those of a copy, as degrees are rounded.
/// Fault: that of assign(), with `section` before the name unless it is empty.
Status check_ranges(const std::vector<Option>& options, const std::string& section = "");

/// Returns the JSON schema type: "number", "integer", "boolean" or "string".
std::string_view type_name(const Option& option);

/// Returns the known name nearest to `unknown` by edit distance, or an empty string if none is close. It is
/// used for the suggestion "did you mean" in faults.
std::string nearest_name(std::string_view unknown, const std::vector<std::string>& known);

/// Makes the fault for a name that is not in a catalogue: "there is no planner 'x'; did you mean ...". `kind`
/// is the noun for an entry, `where` the key of the option with the name.
tl::unexpected<Fault> no_such_row(std::string_view kind, std::string_view unknown,
                                  const std::vector<std::string>& known, std::string where);

/// Returns the names of the entries of a catalogue, in its order.
template <class Row>
std::vector<std::string> names_of(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row.name);
  return names;
}

/// Returns the entry of a catalogue with that name. Fault: bad_input if there is none.
template <class Row>
Outcome<Row> find_row(const std::vector<Row>& rows, std::string_view kind, std::string_view name,
                      std::string where) {
  for (const Row& row : rows) {
    if (row.name == name) return row;
  }
  return no_such_row(kind, name, names_of(rows), std::move(where));
}

}  // namespace outrider
