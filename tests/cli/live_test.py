"""What missions tell while they run: the news of each line make the report, and telling changes nothing."""
import json
import os
import subprocess
import unittest

from explore_test import ROOM
from pursue_test import SMALL
from tool import FENCE, FLOOR, SOURCE, TOOL, ToolTest, main, world


class Live(ToolTest):
    def watched(self, *words):
        """Runs the tool with somebody who watches: status and the lines told."""
        ours, its = os.pipe()
        process = subprocess.Popen([TOOL, *map(str, words)], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, pass_fds=[its],
                                   env={**os.environ, "OUTRIDER_LIVE": str(its)})
        os.close(its)
        with open(ours, encoding="utf-8") as told:
            lines = [json.loads(line) for line in told]
        return process.wait(), lines

    def expect_the_same(self, job, *words):
        """With and without somebody who watches: the same files. The report and the lines."""
        status = self.run_tool(*words, "--out", "alone").returncode
        watched, lines = self.watched(*words, "--out", "seen")
        self.assertEqual(watched, status)
        for path in sorted((self.folder / "alone").iterdir()):
            with self.subTest(path.name):
                one, two = path.read_bytes(), (self.folder / "seen" / path.name).read_bytes()
                self.assertEqual(one, two)
        return json.loads((self.folder / f"seen/{job}.json").read_text()), lines

    def together(self, lines, *keys):
        """The list at that place of the report, put together from the lines."""
        def at(line):
            for key in keys:
                line = line.get(key, {})
            return line or []
        return [item for line in lines for item in at(line)]

    def check(self, job, *words):
        report, lines = self.expect_the_same(job, *words)
        self.assertEqual([line["job"] for line in lines if line["job"]], [job])
        self.assertEqual(lines[0]["job"], job)
        self.assertEqual({line["status"] for line in lines}, {"running"})
        self.assertEqual(lines[0]["world"], report["world"])
        for key in ("track", "shots", "events"):
            self.assertEqual(self.together(lines, key), report[key], key)
        return report, lines

    def test_whoever_watches_may_go(self):
        ours, its = os.pipe()
        os.close(ours)
        watched = {**os.environ, "OUTRIDER_LIVE": str(its), "OUTRIDER_PROGRESS": str(its)}
        process = subprocess.run([TOOL, *map(str, self.guard())], cwd=self.folder, capture_output=True, pass_fds=[its],
                                 env=watched, check=False)
        os.close(its)
        self.assertEqual(process.returncode, self.run_tool(*self.guard()).returncode)

    def test_guard(self):
        report, lines = self.check("guard", *self.guard())
        self.assertGreater(len(report["shots"]), 0)
        self.assertEqual([line["targets"] for line in lines if line["targets"]][-1], report["targets"])
        self.assertEqual({target["status"] for target in lines[0]["targets"]}, {"waiting"})

    def test_slam(self):
        """While a log is mapped, map and landmarks come as they are by then."""
        for name in ("office", "posts"):
            report, lines = self.expect_the_same("slam", "run", SOURCE / f"scenarios/slam/{name}.yaml")
            self.assertEqual(self.together(lines, "slam", "odometry"), report["slam"]["odometry"])
            told = self.together(lines, "slam", "beliefs")
            self.assertEqual([one["time_s"] for one in told], [one["time_s"] for one in report["slam"]["beliefs"]])
            self.assertGreater(len(self.together(lines, "slam", "scans")), 0)
            told = self.together(lines, "track")
            self.assertEqual([row[0] for row in told], [row[0] for row in report["track"]])
            last = lines[-1]["slam"]
            self.assertEqual([one["id"] for one in last["landmarks"]], [one["id"] for one in report["slam"]["landmarks"]])
            self.assertEqual(last["loops"], [] if name == "posts" else last["loops"])
            maps = [line["slam"]["map"] for line in lines if "map" in line["slam"]]
            self.assertEqual(len(maps) > 0, name == "office")
            self.assertTrue(all(one["columns"] * one["rows"] <= 40_000 for one in maps))

    def test_drive(self):
        report, lines = self.check("drive", "run", SOURCE / "scenarios/waypoints/open_loop.yaml")
        self.assertEqual(self.together(lines, "drive", "beliefs"), report["drive"]["beliefs"])
        self.assertEqual([line["drive"]["stops"] for line in lines if line["drive"]["stops"]][-1], report["drive"]["stops"])

    def test_explore(self):
        self.write("room.sdf", ROOM)
        report, lines = self.check("explore", "explore", "room.sdf", "--start=-0.8,-0.5,30")
        for key in ("beliefs", "decisions"):
            self.assertEqual(self.together(lines, "explore", key), report["explore"][key], key)
        maps = [line["explore"]["map"] for line in lines]
        known = [sum(one["state_runs"][1::2]) for one in maps if one["columns"]]
        self.assertEqual(maps[-1]["state_runs"], report["explore"]["map"]["state_runs"])
        self.assertEqual(known, sorted(known))

    def test_pursue(self):
        self.write("small.txt", SMALL)
        report, lines = self.check("pursue", "pursue", "small.txt")
        for key in ("target", "paid", "bounds"):
            self.assertEqual(self.together(lines, "pursuit", key), report["pursuit"][key], key)
        ways = [line["pursuit"]["robots"] for line in lines]
        self.assertEqual([place for way in ways for place in way[0]], report["pursuit"]["robots"][0])

    def test_a_world_that_is_too_large_to_be_told(self):
        """A net of 80,000 triangles high above the yard: whoever watches is told that the scene is left out, and why."""
        side = range(201)
        corners = [f"v {x * 0.01 - 1:.2f} {y * 0.01 - 1:.2f} {50 + (7 * x + 3 * y) % 5 * 0.01:.2f}" for y in side for x in side]
        faces = [f"f {a} {a + 1} {a + 202}\nf {a} {a + 202} {a + 201}" for y in side[:-1] for a in range(201 * y + 1, 201 * y + 201)]
        self.write("net.obj", "\n".join(corners + faces))
        net = '<model name="net"><static>true</static><link name="link"><collision name="net"><geometry><mesh><uri>net.obj</uri></mesh></geometry></collision></link></model>'
        self.write("covered.sdf", world(FLOOR, *FENCE, net))
        status, lines = self.watched(*self.guard("--world", "covered.sdf", "--out", "seen"))
        self.assertIn(status, (0, 1))
        self.assertEqual((lines[0]["omitted"], lines[0]["most_bytes"]), ("scene", 4 << 20))
        self.assertGreater(lines[0]["bytes"], 4 << 20)
        self.assertGreater(sum(len(line["track"]) for line in lines[1:]), 10)

    def test_a_watcher_that_is_not_there(self):
        for word in ("", "x", "2", "-1", "999"):
            result = subprocess.run([TOOL, *self.guard("--json")], cwd=self.folder, capture_output=True, text=True,
                                    env={**os.environ, "OUTRIDER_LIVE": word})
            self.assertIn(result.returncode, (0, 1), word)
            self.assertEqual(len(result.stdout.splitlines()), 1)


if __name__ == "__main__":
    main()
