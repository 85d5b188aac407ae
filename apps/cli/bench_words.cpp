#include "bench_words.hpp"

namespace outrider::cli {

void add_scenarios(Command& bench, std::vector<std::string>& paths, const std::string& sentence) {
  bench.option("--scenarios", &paths, sentence).separated_by(',').type("FILE,...");
}

void add_names(Command& bench, const std::string& flag, std::vector<std::string>& names,
               const std::string& sentence) {
  bench.option(flag, &names, sentence).separated_by(',').type("NAME,...");
}

void add_seeds(Command& bench, std::int64_t& seeds, const std::string& sentence) {
  bench.option("--seeds", &seeds, sentence).between(1, 10'000).type("N");
}

void add_json(Command& bench, bool& json) {
  bench.flag("--json", &json, "print one JSON object on standard output");
}

}  // namespace outrider::cli
