"""Files and flags with a few wrong bytes: the tool answers 0, 1 or 2 in a sentence, and never breaks."""
import os
import random
import unittest

from tool import COARSE, MAP, PAGE, TARGETS, YARD, ToolTest, costly_cases, main

RUNS = costly_cases(24)
SCENARIO = ("job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nseed: 3\nrobot:\n  radius: 0.26\n"
            "gun:\n  pitch_low: -30\nplan:\n  resolution: 0.4\n  iterations: 5\n")
PIECES = [b"0", b"-1", b"nan", b"inf", b"1e300", b"1e-300", b"99999999999", b"<", b">", b"/", b"=", b":", b"\n", b"\0",
          b"\xff", b"  ", b"&#x0;", b"-", b",", b"*a", b"[", b"{", b"1e5", b"0.001"]


def mutated(rng, text):
    """A few pieces cut out, doubled or put in."""
    content = bytearray(text.encode())
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(content) + 1)
        end = min(len(content), at + rng.randrange(1, 12))
        kind = rng.randrange(4)
        if kind == 0:
            del content[at:end]
        elif kind == 1:
            content[at:at] = content[at:end]
        elif kind == 2:
            content[at:at] = rng.choice(PIECES)
        else:
            content[at:end] = rng.choice(PIECES)
    return bytes(content)


class Fuzz(ToolTest):
    def check(self, result, content):
        self.assertIn(result.returncode, [0, 1, 2], (result.stderr[-500:], content))
        self.assertNotIn("this is a bug", result.stderr, content)
        if result.returncode == 2:
            self.assertEqual(self.json_of(result)["status"], "refused")
        else:
            self.json_of(result)

    def guard_with(self, flag, name, text, seed):
        rng = random.Random(seed)
        words = ["guard", "--json", "--world", "yard.sdf", "--targets", "targets.txt", "--start", "0,-2,90", *COARSE]
        words[words.index("0.2")] = "0.4"
        words += ["--plan-aim-step", "0.2", "--plan-pitch-step", "15", "--plan-memory-cap", "16"]
        for _ in range(RUNS):
            content = mutated(rng, text)
            self.write(name, content)
            words[words.index(flag) + 1] = name
            self.check(self.run_tool(*words), content)

    def test_worlds(self):
        self.guard_with("--world", "m.sdf", YARD, 1)

    def test_targets(self):
        self.guard_with("--targets", "m.txt", TARGETS, 2)

    def test_scenarios(self):
        rng = random.Random(3)
        for _ in range(RUNS):
            content = mutated(rng, SCENARIO)
            self.write("m.yaml", content)
            self.check(self.run_tool("run", "m.yaml", "--json", "--plan-memory-cap", "16", "--plan-aim-step", "0.2",
                                     "--plan-pitch-step", "15"), content)

    def test_maps(self):
        rng = random.Random(4)
        for _ in range(RUNS // 2):
            content = mutated(rng, MAP)
            self.write("m.map", content)
            self.check(self.run_tool("plan", "m.map", "--from", "0.5,0.5", "--to", "5.5,3.5", "--json"), content)

    def test_reports(self):
        self.run_tool(*self.guard("--out", "out"))
        rng = random.Random(5)
        text = (self.folder / "out/run.json").read_text()
        for _ in range(RUNS // 2):
            content = mutated(rng, text)
            self.write("m.json", content)
            self.check(self.run_tool("replay", "m.json", "--json", "--svg", "p.svg", *PAGE, *["p.html"][:len(PAGE)]), content)

    def test_flags(self):
        rng = random.Random(6)
        flags = ["--start", "--bounds", "--seed", "--tries", "--robot-radius", "--gun-muzzle-speed", "--plan-margin",
                 "--errors-gun", "--gun-pitch-low", "--plan-aim-step", "--plan-stops", "--robot-speed"]
        for _ in range(RUNS // 2):
            flag = rng.choice(flags)
            text = "0,-2,90" if flag == "--start" else "-3,-3,3,3" if flag == "--bounds" else "1"
            value = mutated(rng, text).replace(b"\0", b"0").decode(errors="replace")
            words = self.guard("--json", f"{flag}={value}", "--plan-memory-cap", "16")
            words[words.index("0.2")] = "0.4"
            if flag == "--start":
                at = words.index("--start")
                del words[at:at + 2]
            self.check(self.run_tool(*words), value)


if __name__ == "__main__":
    main()
