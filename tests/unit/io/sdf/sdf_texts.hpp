// Texts of small SDF worlds, and what loading them gives.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "outrider/io/sdf/sdf.hpp"
#include "sdf_solids.hpp"

namespace outrider {

/// A plane with a size.
inline const std::string ground =
    "<model name='ground'><static>1</static><link name='link'><collision name='c'><geometry><plane>"
    "<normal>0 0 1</normal><size>30 40</size></plane></geometry></collision></link></model>\n";

inline std::string world_of(const std::string& content, const std::string& version = "1.7") {
  return "<?xml version='1.0'?>\n<sdf version='" + version + "'><world name='w'>\n" + content +
         "</world></sdf>\n";
}

inline std::string model(const std::string& name, const std::string& pose, const std::string& geometry) {
  return "<model name='" + name + "'><pose>" + pose +
         "</pose><link name='link'><collision name='c'><geometry>" + geometry +
         "</geometry></collision></link></model>\n";
}

inline const std::string unit_box = "<box><size>1 1 1</size></box>";

inline LoadedWorld load(const std::string& text, const SdfOptions& options = {}) {
  auto loaded = sdf_from_text(text, "w.sdf", options);
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return loaded ? *loaded : LoadedWorld{};
}

inline std::string sdf_fault(const std::string& text) {
  const auto loaded = sdf_from_text(text, "w.sdf");
  return loaded ? "none" : to_string(loaded.error());
}

}  // namespace outrider
