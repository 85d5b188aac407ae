// The commands of the tool. Each adds itself to the tool, or to a command of it.
#pragma once

#include "command.hpp"

namespace outrider::cli {

void add_run(Command& tool);
void add_guard(Command& tool);
void add_pursue(Command& tool);
void add_cover(Command& tool);
void add_explore(Command& tool);
void add_plan(Command& tool);
void add_slam(Command& tool);
void add_detect(Command& tool);
void add_drive(Command& tool);
void add_calibrate(Command& tool);
void add_replay(Command& tool);
void add_bench(Command& tool);
/// Add themselves to `bench`.
void add_bench_pursuit(Command& bench);
void add_bench_guard(Command& bench);
void add_bench_slam(Command& bench);
void add_bench_explore(Command& bench);
void add_list(Command& tool);
void add_schema(Command& tool);
void add_serve(Command& tool);

}  // namespace outrider::cli
