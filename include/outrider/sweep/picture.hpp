// The picture of a sweep: how often it was done over what varies, and how its metrics are distributed.
#pragma once

#include <string>

#include "outrider/sweep/summary.hpp"

namespace outrider {

/// Returns one SVG without script: the rate of done with its interval over each key that varies, a heat map
/// of it over the first two keys (of a comparison with both sides together), and a histogram of each metric
/// that differs between runs, at most 12, for each side. Keys that vary at random as numbers are shown in
/// eight bins. Faults: those of ChunkReader.
Outcome<std::string> sweep_picture(ChunkReader& chunks, const SweepSummary& summary);

/// Returns a page of one file with the picture and the summary.
std::string sweep_page(const std::string& title, const std::string& picture, const std::string& text);

}  // namespace outrider
