// outrider-research: the tool, with reference methods to compare with.
#include "outrider/jobs/catalog.hpp"
#include "research/research.hpp"
#include "tool.hpp"

int main(int argc, char** argv) {
  outrider::add_research();
  return outrider::cli::run_tool(outrider::jobs(), argc, argv);
}
