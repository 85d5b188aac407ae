"""A robot written in Python explores a room by a mission of Outrider."""

import math

import numpy as np
import outrider


class Robot:
    """Wheels and a laser in a room of 3 x 2 m."""

    def __init__(self) -> None:
        self.time, self.x, self.y, self.heading = 0.0, 1.0, 1.0, 0.0

    def sense(self) -> outrider.Observation:
        bearings = self.heading + np.arange(180) * 2 * math.pi / 180
        c, s = np.cos(bearings) + 1e-12, np.sin(bearings) + 1e-12
        ranges = np.minimum(np.where(c > 0, 3 - self.x, -self.x) / c, np.where(s > 0, 2 - self.y, -self.y) / s)
        scan = outrider.LaserScan(ranges, first=0.0, step=2 * math.pi / 180, least=0.05, most=3.5, time=self.time)
        return outrider.Observation(time=self.time, odometry=(self.x - 1, self.y - 1, self.heading), scan=scan)

    def act(self, command: outrider.DriveTwist) -> None:
        seconds = command.until - self.time
        self.x += seconds * command.ahead * math.cos(self.heading)
        self.y += seconds * command.ahead * math.sin(self.heading)
        self.heading += seconds * command.turn
        self.time = command.until


mission = outrider.ExploreMission((1.0, 1.0, 0.0))
outrider.run_mission(mission, Robot())
grid = mission.map
print(f"{mission.stop_reason}, home: {mission.home}, {(grid.cells == 0).sum() * grid.resolution**2:.1f} m2 are free")


class Broken(Robot):
    def act(self, command: outrider.DriveTwist) -> None:
        raise OSError("no motor answers")


try:
    outrider.run_mission(outrider.ExploreMission((1.0, 1.0, 0.0)), Broken())
except outrider.RobotFailed as failure:
    print(failure)

# Prints:
# complete, home: True, 5.8 m2 are free
# Broken.act() failed: OSError: no motor answers
