"""`outrider serve` opens nothing outside its folder, whatever files of strangers name."""
import base64
import os
import pathlib
import tempfile

from serve_case import COURT, Serve
from server_client import Server
from tool import FLOOR, main, wall, world
from witness import Witness

OUTSIDE = "outside the folder"
SECRET = "type=1 name=secret x=-1 y=1\n"


def include(uri):
    return f"<include>{uri}</include>"


class Confinement(Serve):
    def setUp(self):
        super().setUp()
        outside = tempfile.TemporaryDirectory(prefix="outrider-outside-")
        self.addCleanup(outside.cleanup)
        self.outside = pathlib.Path(outside.name)
        self.write_outside("model.sdf", world(FLOOR, wall("secret", 0, 0, 1, 1)))
        self.write_outside("targets.txt", SECRET)
        self.write_outside("small.map", "type octile\nheight 1\nwidth 2\nmap\n..\n")
        self.write_outside("map.pgm", "P2 2 2 255\n0 0 0 0\n")
        self.witness = Witness(self.outside)
        self.addCleanup(self.witness.close)
        self.up = os.path.relpath(self.outside, self.folder)  # ../outrider-outside-...

    def write_outside(self, name, text):
        (self.outside / name).write_text(text)

    def unseen(self, what):
        self.assertEqual(self.witness.opened(), set(), what)

    def map_refused(self, server, name):
        """A map or a world of the folder is refused, or read without what lies outside."""
        status, _, body = server.request("POST", "/api/v1/maps", {"path": name})
        self.unseen(name)
        self.assertNotIn(b"secret", body)
        return status, body.decode()

    def test_the_witness_sees(self):
        (self.outside / "targets.txt").read_text()
        self.assertEqual(self.witness.opened(), {"targets.txt"})

    def test_includes_that_a_second_parser_would_miss(self):
        uris = {"plain": f"<uri>{self.up}/model.sdf</uri>",
                "greater in an attribute": f"<uri a='>'>{self.up}/model.sdf</uri>",
                "end tag in an attribute": f"<uri a='</uri'>{self.up}/model.sdf</uri>",
                "absolute": f"<uri>file://{self.outside}/model.sdf</uri>",
                "of a model": f"<uri>model://{self.up}</uri>",
                "escaped": f"<uri>&#46;{self.up[1:]}/model.sdf</uri>",
                "character data": f"<uri><![CDATA[{self.up}/model.sdf]]></uri>"}
        with Server(self.folder) as server:
            for name, uri in uris.items():
                self.write("attack.sdf", world(FLOOR, *include(uri).splitlines()))
                status, body = self.map_refused(server, "attack.sdf")
                self.assertTrue(status == 400 and OUTSIDE in body or name == "of a model", (name, status, body))

    def test_chains_of_includes(self):
        for i in range(6):
            uri = f"chain{i + 1}.sdf" if i < 5 else f"{self.up}/model.sdf"
            self.write(f"chain{i}.sdf", f"<sdf version='1.6'><model name='m'>{include(f'<uri>{uri}</uri>')}</model></sdf>")
        self.write("attack.sdf", world(FLOOR, include("<uri>chain0.sdf</uri>")))
        with Server(self.folder) as server:
            status, body = self.map_refused(server, "attack.sdf")
            self.assertEqual(status, 400)
            self.assertIn(OUTSIDE, body)

    def test_model_config_that_was_sent(self):
        files = {"world.sdf": world(FLOOR, include("<uri>file://.</uri>")),
                 "model.config": f"<model><sdf>{self.outside}/model.sdf</sdf></model>"}
        sent = [{"name": name, "base64": base64.b64encode(text.encode()).decode()} for name, text in files.items()]
        with Server(self.folder) as server:
            status, _, body = server.request("POST", "/api/v1/maps", {"files": sent})
            self.unseen("model.config")
            self.assertEqual(status, 400)
            self.assertNotIn(b"secret", body)

    def test_names_in_scenarios_and_maps(self):
        self.write("attack.yaml", world(FLOOR, include(f"<uri>{self.up}/model.sdf</uri>")))  # SDF by another name
        self.write("map.yaml", f"image: {self.up}/map.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
                               "occupied_thresh: 0.6\nfree_thresh: 0.2\n")
        self.write("plan.yaml", f"job: plan\nmap: {self.up}/small.map\nfrom: 0.5,0.5\nto: 1.5,0.5\n")
        scenarios = {"world.yaml": COURT.replace("yard.sdf", "attack.yaml"),
                     "targets.yaml": COURT.replace("targets.txt", f"{self.outside}/targets.txt"),
                     "up.yaml": COURT.replace("targets.txt", f"{self.up}/targets.txt"),
                     "link.yaml": COURT.replace("targets.txt", "link.txt"),
                     "plan.yaml": None}
        (self.folder / "link.txt").symlink_to(self.outside / "targets.txt")
        with Server(self.folder) as server:
            status, body = self.map_refused(server, "map.yaml")
            self.assertEqual(status, 400)
            self.assertIn(OUTSIDE, body)
            for name, text in scenarios.items():
                if text is not None:
                    self.write(name, text)
                for request in ({"scenario": name}, {"text": (self.folder / name).read_text()}):
                    run = server.wait(server.json("POST", "/api/v1/runs", request, status=202)["id"])
                    self.assertEqual(run["state"], "refused", (name, run))
                    self.assertIn(OUTSIDE, run["error"])
                    self.assertNotIn(str(self.folder), run["error"] + run["where"])
                shown = server.json("GET", f"/api/v1/scenarios/{name}", status=400)
                self.assertIn(OUTSIDE, self.fault(shown, "bad_input"))
                self.unseen(name)
            changed = {"guard": {"scenario": "up.yaml", "start": [0, -2], "targets": [{"name": "a", "position": [1, 1]}]}}
            self.assertIn(OUTSIDE, server.json("PUT", "/api/v1/scenarios/new.yaml", changed, status=400)["error"])
            self.unseen("save")

    def test_text_put_over_a_scenario_after_it_was_checked(self):
        with Server(self.folder, "--jobs", "1") as server:
            long = self.started(server, {"scenario": "long.yaml"})
            waits = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
            self.assertEqual(server.json("GET", f"/api/v1/runs/{waits}")["state"], "queued", "the premise")
            server.json("PUT", "/api/v1/files/court.yaml", COURT.replace("targets.txt", f"{self.up}/targets.txt").encode(),
                        status=200)
            server.json("DELETE", f"/api/v1/runs/{long}")
            self.assertIn(server.wait(waits)["state"], ("done", "not_done"), "it ran as it was when it was asked for")
            self.unseen("the text that came later")

    def test_pipes_block_nobody(self):
        os.mkfifo(self.folder / "pipe.sdf")
        os.mkfifo(self.folder / "pipe.yaml")
        self.write("attack.sdf", world(FLOOR, include("<uri>pipe.sdf</uri>")))
        with Server(self.folder) as server:
            for name in ("pipe.sdf", "attack.sdf"):
                answer = server.json("POST", "/api/v1/maps", {"path": name}, status=400)
                self.assertIn("regular file", answer["error"])
            server.json("POST", "/api/v1/runs", {"scenario": "pipe.yaml"}, status=404)
            self.write("court_map.sdf", world(FLOOR, wall("a", 0, 0, 1, 1)))
            server.json("POST", "/api/v1/maps", {"path": "court_map.sdf"})

    def test_nothing_is_left_behind_by_a_killed_server(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        left = lambda: [path.name for path in pathlib.Path(temporary.name).iterdir()]
        self.write(".outrider", "a file, so that its runs are kept in a temporary folder")
        before = sorted(path.name for path in self.folder.iterdir())
        server = Server(self.folder, TMPDIR=temporary.name)
        run = self.started(server, {"text": COURT})
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before, "no file for a text")
        self.still_running(server, run)
        server.end(kill=True)
        self.assertEqual(len(left()), 1, "its temporary folder is still there: the premise")
        with Server(self.folder, TMPDIR=temporary.name):
            self.assertEqual(left(), [], "the next one sweeps")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)

    def test_the_token_stays_out_of_the_list_of_processes(self):
        token = "0123456789abcdef-secret"
        token_file = self.outside / "token"
        token_file.write_text(token + "\n")
        token_file.chmod(0o600)
        for words, variables in ((("--token-file", token_file), {}), ((), {"OUTRIDER_TOKEN": token})):
            with Server(self.folder, *map(str, words), **variables) as server:
                line = pathlib.Path(f"/proc/{server.process.pid}/cmdline").read_bytes()
                self.assertNotIn(token.encode(), line)
                server.json("GET", "/api/v1/version", status=401)
                server.json("GET", "/api/v1/version", Authorization="Bearer " + token)
        self.refused("serve", ".", "--token", token, "--token-file", token_file, says=["--token", "more than one"])
        self.refused("serve", ".", "--token-file", "absent", says=["--token-file", "no such file"])
        for mode in (0o640, 0o604, 0o622):
            token_file.chmod(mode)
            self.refused("serve", ".", "--token-file", token_file, says=["--token-file", "others", "chmod 600"])
        token_file.write_text("\n")
        token_file.chmod(0o600)
        self.refused("serve", ".", "--token-file", token_file, says=["--token-file", "empty"])
        for name in ("token", ".token"):
            self.write(name, token + "\n")
            (self.folder / name).chmod(0o600)
            self.refused("serve", ".", "--token-file", name, says=["--token-file", "folder that is served"])
        (self.outside / "link").symlink_to(self.folder / "token")
        self.refused("serve", ".", "--token-file", self.outside / "link", says=["--token-file", "folder that is served"])


if __name__ == "__main__":
    main()
