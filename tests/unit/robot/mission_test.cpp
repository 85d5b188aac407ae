#include "outrider/robot/mission.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace outrider {
namespace {

/// Writes down who was called, as letters.
struct LoggingRobot final : Robot {
  explicit LoggingRobot(std::string& calls) : log(calls) {}
  Observation sense() override {
    log += 's';
    return {.time_s = time_s, .odometry = {}};
  }
  void act(const Command& command) override {
    log += 'a';
    time_s = std::get<Wait>(command).until_s;
  }
  std::string& log;
  double time_s = 0.0;
};

/// Waits for so many seconds, one after another.
struct WaitingMission {
  std::optional<Command> step(const Observation& seen) {
    log += 'm';
    if (seen.time_s >= fails_s) throw std::runtime_error("failed");
    if (seen.time_s >= ends_s) return std::nullopt;
    return Wait{seen.time_s + 1.0};
  }
  std::string& log;
  double ends_s = 2.0;
  double fails_s = 1e9;
};

TEST(RunMission, SensesStepsNotesAndActsInThatOrderUntilThereIsNoCommand) {
  std::string log;
  LoggingRobot robot(log);
  WaitingMission mission{log};
  double noted_s = -1.0;
  EXPECT_TRUE(run_mission(mission, robot, {}, [&](const Observation& seen, const Command* command) {
    log += command != nullptr ? 'n' : 'e';
    noted_s = seen.time_s;
  }));
  EXPECT_EQ(log,
            "smna"
            "smna"
            "sme");
  EXPECT_EQ(noted_s, 2.0) << "the last observation is noted as well";
}

TEST(RunMission, AStopIsHeededAfterTheNoteAndBeforeTheCommand) {
  std::string log;
  LoggingRobot robot(log);
  WaitingMission mission{log};
  std::stop_source source;
  const auto note = [&](const Observation& seen, const Command*) {
    log += 'n';
    if (seen.time_s == 1.0) source.request_stop();
  };
  EXPECT_FALSE(run_mission(mission, robot, source.get_token(), note));
  EXPECT_EQ(log,
            "smna"
            "smn");
}

TEST(RunMission, AMissionThatIsOverWasNotStopped) {
  std::string log;
  LoggingRobot robot(log);
  WaitingMission mission{log, 0.0};
  std::stop_source source;
  source.request_stop();
  EXPECT_TRUE(run_mission(mission, robot, source.get_token(), [](const Observation&, const Command*) {}));
  EXPECT_EQ(log, "sm");
}

TEST(RunMission, AnExceptionOfTheMissionReachesTheCallerAndNothingActsOnIt) {
  std::string log;
  LoggingRobot robot(log);
  WaitingMission mission{log, 9.0, 1.0};
  EXPECT_THROW(run_mission(mission, robot, {}, [&](const Observation&, const Command*) { log += 'n'; }),
               std::runtime_error);
  EXPECT_EQ(log,
            "smna"
            "sm");
}

}  // namespace
}  // namespace outrider
