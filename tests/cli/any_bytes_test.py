"""Names of files, names in files and values of any bytes: no sentence commands the terminal, and JSON stays JSON."""
import json
import os
import random
import re
import subprocess
import unittest

from tool import COARSE, MAP, SOURCE, TARGETS, TOOL, YARD, ToolTest, costly_cases, in_soak, main

EVIL = b"\xff\x1b[31mX\nY"
FIELD = b'{"type": "Polygon", "coordinates": [[[0,0],[4,0],[4,4],[0,4],[0,0]]]}'
SLICES = b"0,0,3,0\n3,0,3,2\n3,2,0,2\n0,2,0,0\n"


def forms(count):
    """As text or as JSON, in an order that no other order of the calls repeats; under `make soak` both each time."""
    return ([], ["--json"]) if in_soak() else (["--json"],) if count.bit_count() % 2 else ([],)


class AnyBytes(ToolTest):
    calls = 0

    def setUp(self):
        super().setUp()
        self.commands = []
        for name, content in [(b".sdf", YARD.encode()), (b".txt", TARGETS.encode()), (b".map", MAP.encode()),
                              (b".geojson", FIELD), (b".csv", SLICES),
                              (b".yaml", b"job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: " + EVIL[:6] + b"\n")]:
            self.put(EVIL + name, content)
        self.put(b"named.txt", b"name=" + EVIL[:6] + b" size=0.3,0.3,0.3 x=1.8 y=1.9\n")
        self.put(b"named.sdf", YARD.encode().replace(b'name="crate"', b'name="' + EVIL[:6] + b'"'))
        for folder, name in [("slam", "yard.g2o"), ("slam", "posts.dat")]:
            self.put(EVIL + name.encode(), (SOURCE / "scenarios" / folder / name).read_bytes())

    def put(self, name, content):
        with open(os.path.join(os.fsencode(self.folder), name), "wb") as file:
            file.write(content)

    def harmless(self, *words):
        self.calls += 1
        for more in forms(self.calls):
            command = [os.fsencode(TOOL), *(word if isinstance(word, bytes) else word.encode() for word in (*words, *more))]
            with self.subTest(command=command):
                result = subprocess.run(command, cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True)
                self.assertIn(result.returncode, (0, 1, 2), result.stderr)
                for stream in (result.stdout, result.stderr):
                    text = stream.decode("utf-8")  # fails on other bytes
                    self.assertNotIn("this is a bug", text)
                    self.assertFalse([c for c in text if not c.isprintable() and c not in "\n\t"], text)
                lines = result.stderr.decode().splitlines()
                self.assertTrue(all(line.startswith("outrider: ") for line in lines), lines)
                if more and result.stdout:
                    json.loads(result.stdout)

    def test_words(self):
        for verb in [b"run", b"guard", b"plan", b"cover", b"explore", b"fleet", b"slam", b"drive", b"pursue", b"detect", b"calibrate",
                     b"replay", b"list", b"schema", b"bench", b"serve"]:
            self.harmless(verb, b"no/" + EVIL)
            self.harmless(verb, b"--" + EVIL)
        self.harmless(EVIL)
        for flag in ["--planner", "--start", "--seed", "--validate", "--targets"]:
            self.harmless("guard", "--world", "yard.sdf", flag, EVIL)
        for flag in ["--planner", "--from", "--block", "--query", "--to"]:
            self.harmless("plan", "small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", flag, EVIL[:6])
        self.harmless("schema", "--as", EVIL)
        self.harmless("bench", "path", "--data", EVIL)
        self.harmless("serve", "--port", EVIL)

    def test_names_of_files_and_folders(self):
        guard = ["--start", "0,-2,90", *COARSE, "--out", b"guard" + EVIL]
        self.harmless("guard", "--world", EVIL + b".sdf", "--targets", EVIL + b".txt", *guard)
        self.harmless("replay", b"guard" + EVIL + b"/run.mcap", "--svg", EVIL + b".svg")
        self.harmless("guard", "--world", "yard.sdf", "--targets", "targets.txt", "--start", "0,-2,90", *COARSE, "--plan-planner", EVIL)
        self.harmless("run", EVIL + b".yaml")
        self.harmless("plan", EVIL + b".map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--out", b"paths" + EVIL)
        self.harmless("plan", EVIL + b".sdf", "--from", "0,0", "--to", "1,-1")
        self.harmless("cover", EVIL + b".geojson", "--out", b"cover" + EVIL)
        self.harmless("explore", EVIL + b".csv", "--start", "1,1,0", "--out", b"explore" + EVIL)
        for name in [b"yard.g2o", b"posts.dat"]:
            self.harmless("slam", EVIL + name, "--out", b"slam" + EVIL + name)

    def test_plans_that_are_written(self):
        """With the name of the map in them."""
        data = os.environ.get("OUTRIDER_DATA") or SOURCE.parent / "shared" / "data"
        published = os.path.join(data, "polygons", "map_1.txt")
        if os.path.exists(published):
            self.put(EVIL + b"map_1.txt", open(published, "rb").read())
            self.harmless("plan", EVIL + b"map_1.txt", "--query", "1", "--out", "polygons")
            plan = json.loads((self.folder / "polygons/run.json").read_text(encoding="utf-8"))
            self.assertIn("\ufffd", json.dumps(plan, ensure_ascii=False))
        folder = b"in" + EVIL[:6]
        os.mkdir(os.path.join(os.fsencode(self.folder), folder))
        self.put(folder + b"/small.map", MAP.encode())
        self.put(folder + b"/plan.yaml", b'job: plan\nmap: small.map\nfrom: "0.5,3.5"\nto: "5.5,3.5"\nplanner: a_star\nradius: 0\n')
        self.harmless("run", folder + b"/plan.yaml", "--out", "grid")
        json.loads((self.folder / "grid/run.json").read_text(encoding="utf-8"))

    def test_names_in_files(self):
        guard = ["--start", "0,-2,90", *COARSE]
        self.harmless("guard", "--world", "named.sdf", "--targets", "named.txt", *guard)
        self.harmless("guard", "--world", "named.sdf", "--targets", "targets.txt", *guard, "--out", "named")

    def test_a_report_with_names_of_more_lines(self):
        run = self.run_tool("guard", "--world", "yard.sdf", "--targets", "targets.txt", "--start", "0,-2,90", *COARSE,
                            "--out", "told")
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads((self.folder / "told/run.json").read_text())
        report["world"] = "yard\x1b[2J\nforged: all well"
        report["targets"][0]["name"] = "cat\nforged"
        self.write("forged.json", json.dumps(report))
        self.harmless("replay", "forged.json")
        lines = self.run_tool("replay", "forged.json").stdout.splitlines()
        self.assertFalse([line for line in lines if line.startswith("forged")], lines)


class Echo(ToolTest):
    """Messages repeat little of an input, and turn no text, whatever its length."""
    LONG = "9" * 100_000
    TURNED = "a\u202eb\u2066c\u200fd\u061ce"
    calls = 0

    def short(self, *words):
        self.calls += 1
        for more in forms(self.calls):
            result = self.run_tool(*words, *more)
            said = result.stderr + result.stdout
            with self.subTest(words=[str(word)[:40] for word in words]):
                self.assertIn(result.returncode, (0, 1, 2), said[:300])
                self.assertNotIn("this is a bug", said)
                for line in result.stderr.splitlines():
                    self.assertLess(len(line), 500, line[:700])
                self.assertFalse([c for c in said if not c.isprintable() and c not in "\n\t"], said[:700])
                if result.returncode == 2:
                    self.assertLess(len(said), 1000, said[:1200])
                    self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr[:700])

    def options(self):
        """Each option of each job, as a flag and as a key."""
        for job in ("plan", "drive", "pursue", "guard", "explore", "cover", "slam", "fleet"):
            schema = json.loads(self.run_tool("schema", "--job", job).stdout)
            for name, value in schema["properties"].items():
                for inner in value.get("properties", {None: None}):
                    yield job, name, inner

    def test_options(self):
        options = [option for option in self.options() if option[1] != "job"]
        self.assertGreater(len(options), 400)
        for job, name, inner in random.Random(9).sample(options, min(len(options), costly_cases(10))):
            for value in (self.LONG, self.TURNED + " " + "b" * 100_000):
                flag = "--" + "-".join(word.replace("_", "-") for word in (name, inner) if word)
                self.short(job, flag + "=" + value)
                self.write("long.yaml", f'job: {job}\n' + (f'{name}:\n  {inner}: "{value}"\n' if inner else f'{name}: "{value}"\n'))
                self.short("run", "long.yaml")

    def test_words_and_keys(self):
        verbs = ["run", "plan", "guard", "sweep", "replay", "convert", "detect", "calibrate", "list", "schema", "completion", "manual",
                 "bench", "ros"]
        for number, word in enumerate((self.LONG, "-" + self.LONG, "--" + self.LONG, self.TURNED + "b" * 100_000)):
            self.short(word)
            for verb in verbs if in_soak() else verbs[number % 2::2]:
                self.short(verb, word)
            for text in (f"job: {word}\n", f'"{word}": 1\n', f'job: plan\n"{word}": 1\n', f'job: plan\nrobot:\n  "{word}": 1\n',
                         f"job: plan\nmap: {word}.map\n", f'job: plan\nmap: ["{word}"]\n'):
                self.write("key.yaml", text)
                self.short("run", "key.yaml")
        for flag in ("--vary", "--compare", "--chunks", "--seed", "--runs", "--out"):
            self.write("plan.yaml", "job: plan\nmap: small.map\nfrom: 0.5,0.5\nto: 5.5,0.5\n")
            for value in (self.LONG, "radius=" + self.LONG, self.LONG + "=1", f"radius=uniform({self.LONG},1)", self.TURNED):
                self.short("sweep", "plan.yaml", flag, value, *([] if flag == "--out" else ["--out", "swept"]))

    def test_files(self):
        scenarios = SOURCE / "scenarios"
        files = {"small.map": MAP, "yard.sdf": YARD, "targets.txt": TARGETS, "field.geojson": FIELD.decode(), "slices.csv": SLICES.decode(),
                 "graph.g2o": "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n",
                 "posts.dat": "\n".join((scenarios / "slam/posts.dat").read_text().splitlines()[:30]) + "\n",
                 "room.txt": (scenarios / "cover/room.txt").read_text(), "hill.asc": (scenarios / "hill/hill.asc").read_text(),
                 "runs.csv": (scenarios / "waypoints/runs.csv").read_text(), "park.txt": (scenarios / "pursuit/park.txt").read_text(),
                 "warehouse.scen": (scenarios / "fleet/warehouse.scen").read_text()}
        guard = ["guard", "--world", "yard.sdf", "--targets", "targets.txt", "--start", "0,-2,90", *COARSE]
        readers = {"small.map": ["plan", "small.map", "--from", "0.5,0.5", "--to", "5.5,0.5"], "yard.sdf": guard, "targets.txt": guard,
                   "field.geojson": ["cover", "field.geojson"], "slices.csv": ["explore", "slices.csv", "--start", "1,1,0"],
                   "graph.g2o": ["slam", "graph.g2o"], "posts.dat": ["slam", "posts.dat"], "room.txt": ["cover", "room.txt"],
                   "hill.asc": [*guard, "--terrain", "hill.asc"], "runs.csv": ["calibrate", "runs.csv"],
                   "park.txt": ["pursue", "park.txt"],
                   "warehouse.scen": ["fleet", scenarios / "fleet/warehouse.map", "--agents", "warehouse.scen", "--robots", "4"]}
        rng = random.Random(10)
        for name, text in files.items():
            tokens = list(re.finditer(r"[\w.+-]+", text))
            for token in rng.sample(tokens, min(len(tokens), costly_cases(2))):
                for value in (self.LONG, self.TURNED + "b" * 100_000):
                    self.write(name, text[:token.start()] + value + text[token.end():])
                    self.short(*readers[name])
            self.write(name, text)


if __name__ == "__main__":
    main()
