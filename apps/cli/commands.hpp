// The commands of the tool. Each adds itself to the application and leaves its exit status in `status`
// when it was the one asked for.
#pragma once

#include <CLI/CLI.hpp>

namespace outrider::cli {

void add_run(CLI::App& app, int& status);
void add_guard(CLI::App& app, int& status);
void add_pursue(CLI::App& app, int& status);
void add_plan(CLI::App& app, int& status);
void add_replay(CLI::App& app, int& status);
void add_bench(CLI::App& app, int& status);
/// Add themselves to `bench`.
void add_bench_pursuit(CLI::App& bench, int& status);
void add_bench_guard(CLI::App& bench, int& status);
void add_list(CLI::App& app, int& status);
void add_schema(CLI::App& app, int& status);

}  // namespace outrider::cli
