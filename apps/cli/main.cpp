// outrider: a ground robot finds its way, and does a job.
#include "outrider/jobs/catalog.hpp"
#include "tool.hpp"

int main(int argc, char** argv) { return outrider::cli::run_tool(outrider::jobs(), argc, argv); }
