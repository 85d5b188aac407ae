"""A program with a job of its own (examples/10_own_job.cpp): all that the tool gives a job comes from its one row."""
import json

from server_client import Server, WebSocket
from tool import SOURCE, ToolTest, main

ARENA = SOURCE / "scenarios/arena/arena.sdf"
POINTS = "2.5,0.5 2.5,2.5 2.5,0.5 0.5,0.5"
PATROL = f"job: patrol\nworld: {ARENA}\npoints: {POINTS}\nrounds: 2\n"


class OwnJob(ToolTest):
    def test_verb_scenario_and_log(self):
        self.write("patrol.yaml", PATROL)
        answers = []
        for words in (["patrol", "--world", ARENA, "--points", POINTS, "--rounds", "2"], ["run", "patrol.yaml"]):
            result = self.run_tool(*words, "--out", words[0], "--json")
            self.assertEqual(result.returncode, 0, result.stderr)
            answers.append(self.json_of(result))
        for answer in answers:
            self.assertEqual((answer["job"], answer["status"], answer["metrics"]["visits"]), ("patrol", "done", 8))
        poses = [self.log_of(name).of("/pose") for name in ("patrol", "run")]
        self.assertGreater(len(poses[0]), 8)
        self.assertEqual(*poses)
        picture = (self.folder / "run/run.svg").read_text()
        self.assertTrue(picture.startswith("<svg"))
        self.assertNotIn(">reached", picture, "it has no targets to count")
        replayed = self.run_tool("replay", "run", "--json")
        self.assertEqual(replayed.returncode, 0, replayed.stderr)

    def test_it_is_listed_described_and_in_the_schema(self):
        self.assertIn("patrol", self.run_tool("--help").stdout)
        self.assertIn("--rounds", self.run_tool("patrol", "--help").stdout)
        schema = self.run_tool("schema", "--job", "patrol").stdout
        self.assertIn('patrol', schema)
        self.assertIn('"rounds"', schema)

    def test_bad_input_gets_a_sentence(self):
        self.refused("patrol", "--world", ARENA, "--points", "2.5,0.5 x", says=["points", "'x'"])
        self.refused("patrol", "--world", ARENA, "--points", "2.5,2.5", says=["points", "cannot drive straight"])
        self.refused("patrol", "--world", "none.sdf", says=["none.sdf"])
        self.refused("patrol", "--rounds", "0", says=["--rounds", "from 1 to 1000"])
        self.write("wrong.yaml", PATROL + "round: 3\n")
        self.refused("run", "wrong.yaml", says=["round", "rounds"])

    def test_it_runs_live(self):
        self.write("patrol.yaml", PATROL.replace(str(ARENA), "arena.sdf"))
        self.write("arena.sdf", ARENA.read_bytes())
        with Server(self.folder) as server, WebSocket(server) as viewer:
            viewer.send({"type": "runs"})
            viewer.receive()
            run = server.json("POST", "/api/v1/runs", {"scenario": "patrol.yaml"}, status=202)["id"]
            viewer.send({"type": "watch", "run": run, "from": 0})
            viewer.until("end")
            result = server.json("GET", f"/api/v1/runs/{run}/result")
        self.assertEqual((result["status"], result["metrics"]["visits"]), ("done", 8))
        self.assertIn(b"geometry_msgs/msg/PoseStamped", viewer.log)


if __name__ == "__main__":
    main()
