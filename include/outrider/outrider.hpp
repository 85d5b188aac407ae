// The easy door: load a map, plan a path on it; load a scenario, run it. examples/ shows how.
//
// Paths: load_path_problem(), plan_path(), check(); path_planners() is the catalogue. Missions:
// load_scenario(), load_problem() and run_guard(). The headers behind are the same that everything else
// is made of, and may be included one by one.
#pragma once

#include "outrider/io/map/path_problem.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
