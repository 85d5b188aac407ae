#include "outrider/nodes/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/log/encoding/codecs.hpp"
#include "outrider/nodes/follower_node.hpp"

namespace outrider {
namespace {

using rcl_interfaces::bool_parameter;
using rcl_interfaces::double_parameter;
using rcl_interfaces::GetParametersRequest;
using rcl_interfaces::GetParametersResponse;
using rcl_interfaces::no_parameter;
using rcl_interfaces::ParameterValue;

class Parameters : public ::testing::Test {
 protected:
  FollowerNodeOptions options;
  NodeParameters parameters{describe(options)};
};

TEST_F(Parameters, ListsEveryOptionOnceByItsName) {
  const auto all = parameters.list({{}, 0}).result;
  std::size_t count = 0;
  for (const OptionGroup& group : describe(options)) {
    for (const Option& option : group.options) {
      ++count;
      const std::string name = group.name.empty() ? option.name : group.name + "." + option.name;
      EXPECT_EQ(std::ranges::count(all.names, name), 1) << name;
    }
  }
  EXPECT_EQ(all.names.size(), count);
  EXPECT_EQ(std::ranges::count(all.prefixes, "robot"), 1);
  const auto robot = parameters.list({{"robot"}, 0}).result.names;
  EXPECT_FALSE(robot.empty());
  EXPECT_TRUE(std::ranges::all_of(robot, [](const auto& name) { return name.starts_with("robot."); }));
  for (const std::string& name : parameters.list({{}, 1}).result.names)
    EXPECT_EQ(name.find('.'), std::string::npos) << name;
}

TEST_F(Parameters, ValuesAreInTheUnitOfTheirDescription) {
  options.plain_twist = true;
  options.turn_within_rad = 0.2;
  const NodeParameters changed{describe(options)};
  const auto values =
      changed.get({{"plain_twist", "robot.radius", "frame.map", "robot.max_slope", "nothing"}}).values;
  ASSERT_EQ(values.size(), 5U);
  EXPECT_EQ(values[0].type_id, bool_parameter);
  EXPECT_TRUE(values[0].bool_value);
  EXPECT_EQ(values[1].type_id, double_parameter);
  EXPECT_EQ(values[1].double_value, options.robot.radius_m);
  EXPECT_EQ(values[2].string_value, "map");
  if (values[3].type_id == double_parameter) {
    EXPECT_NEAR(values[3].double_value, 20.0, 1e-9);  // degrees
  }
  EXPECT_EQ(values[4].type_id, no_parameter);
  EXPECT_EQ(changed.types({{"robot.radius", "nothing"}}).types,
            (std::vector<std::uint8_t>{double_parameter, no_parameter}));
}

TEST_F(Parameters, DescriptorsHaveSentenceAndRange) {
  const auto found = parameters.describe({{"robot.radius", "nothing"}}).descriptors;
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].description.empty());
  EXPECT_TRUE(found[0].read_only);
  ASSERT_EQ(found[0].floating_point_range.size(), 1U);
  EXPECT_LT(found[0].floating_point_range[0].from_value, found[0].floating_point_range[0].to_value);
  EXPECT_EQ(found[1].name, "nothing");
  EXPECT_EQ(found[1].type_id, no_parameter);
}

TEST_F(Parameters, ChangesAreRefusedWithASentence) {
  ParameterValue same = parameters.get({{"robot.radius"}}).values.front();
  ParameterValue other = same;
  other.double_value += 0.1;
  const auto results =
      parameters.set({{{"robot.radius", same}, {"robot.radius", other}, {"robot.radios", other}}}).results;
  ASSERT_EQ(results.size(), 3U);
  EXPECT_TRUE(results[0].successful);
  EXPECT_FALSE(results[1].successful);
  EXPECT_EQ(results[1].reason,
            "'robot.radius' cannot change while the node runs; start it anew with another value");
  EXPECT_EQ(results[2].reason, "there is no parameter 'robot.radios'; did you mean 'robot.radius'?");
}

TEST_F(Parameters, ServicesAnswerEncodedRequestsAndRefuseOthers) {
  const auto services = parameters.services();
  ASSERT_EQ(services.size(), 6U);
  for (const NodeService& service : services) {
    EXPECT_FALSE(service.answer("")) << service.name;
    std::string lies("\0\1\0\0\xff\xff\xff\x7f", 8);  // two thousand million names
    EXPECT_FALSE(service.answer(lies)) << service.name;
  }
  const auto answer = services[1].answer(encode(MessageEncoding::cdr, GetParametersRequest{{"frame.odom"}}));
  ASSERT_TRUE(answer);
  const auto response = decode<GetParametersResponse>(MessageEncoding::cdr, *answer);
  ASSERT_TRUE(response);
  EXPECT_EQ(response->values.front().string_value, "odom");
}

TEST_F(Parameters, AreNotAskedForWithoutEnd) {
  using rcl_interfaces::GetParametersRequest;
  const auto get = parameters.services()[1];
  const auto asked = [&](std::size_t count) {
    return get.answer(
        encode(MessageEncoding::cdr, GetParametersRequest{std::vector<std::string>(count, "frame.odom")}));
  };
  EXPECT_TRUE(asked(most_parameters_asked));
  const auto refused = asked(most_parameters_asked + 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().sentence, "the request names 1001 parameters; ask for at most 1000 at once");
}

}  // namespace
}  // namespace outrider
