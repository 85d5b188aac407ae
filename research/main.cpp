// outrider-research: the tool, with reference methods to compare with.
#include "research/research.hpp"
#include "tool.hpp"

int main(int argc, char** argv) {
  outrider::add_research();
  return outrider::cli::run_tool(outrider::research_jobs(), argc, argv);
}
