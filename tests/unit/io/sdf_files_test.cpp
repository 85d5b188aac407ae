// Where the models that a world names are found.
#include <gtest/gtest.h>

#include <cstdlib>

#include "outrider/io/sdf.hpp"
#include "sdf_solids.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

const std::string boxed_model =
    "<sdf version='1.6'><model name='tree'><link name='trunk'><collision name='c'><geometry><box><size>1 1 "
    "1</size></box>"
    "</geometry></collision></link></model></sdf>";

/// A world that includes models, each of an address and under a name.
std::string including(const std::vector<std::pair<std::string, std::string>>& models) {
  std::string text = "<sdf version='1.7'><world name='w'>\n";
  for (const auto& [uri, name] : models)
    text += "<include><uri>" + uri + "</uri><name>" + name + "</name></include>\n";
  return text + "</world></sdf>\n";
}

TEST(SdfFiles, ModelsAreFoundWhereSimulatorsFindThem) {
  const test::Folder folder;
  folder.write("above/models/tree/model.sdf", boxed_model);
  folder.write("far/bush/model.sdf", boxed_model);
  folder.write("cache/oak/model.sdf", boxed_model);
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  const std::string path =
      folder.write("above/deep/worlds/w.sdf", including({{fuel + "Ground Plane", "plane"},
                                                         {fuel + "Sun", "sun"},
                                                         {"file://models/tree", "above"},
                                                         {"model://bush", "far"},
                                                         {"\n  " + fuel + "oak\n  ", "fuel"}}));
  ASSERT_EQ(setenv("GZ_SIM_RESOURCE_PATH", (folder.path / "cache").string().c_str(), 1), 0);
  const auto loaded = load_sdf(path, {(folder.path / "far").string()});
  unsetenv("GZ_SIM_RESOURCE_PATH");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings[0];
  for (const char* name : {"above", "far", "fuel"}) solid(loaded->world, name);
  EXPECT_EQ(loaded->world.solids.size(), 4U);
  EXPECT_EQ(loaded->world.floor_z_m, 0.0);
  const auto without = load_sdf(path);
  ASSERT_TRUE(without) << to_string(without.error());
  EXPECT_EQ(without->warnings.size(), 2U);
}

TEST(SdfFiles, ARefusalNamesTheModelThatIsMissing) {
  const test::Folder folder;
  folder.write("models/box/model.sdf", boxed_model);
  const std::string path =
      folder.write("w.sdf", including({{"model://asphalt", "asphalt"}, {"model://box", "box"}}));
  const auto refused = load_sdf(path);
  ASSERT_FALSE(refused);
  for (const char* word : {"no floor", "w.sdf:2: ", "'model://asphalt' was not found", "as model_path"})
    EXPECT_NE(refused.error().sentence.find(word), std::string::npos) << refused.error().sentence;
  const auto nowhere = load_sdf(path, {(folder.path / "nowhere").string()});
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().where, "model_path");
}

}  // namespace
}  // namespace outrider
