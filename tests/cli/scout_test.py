"""Guarding a yard that is not known: explored first, one log of both."""
import base64
import json

from tool import PAGE, SOURCE, ToolTest, main

YARD = str(SOURCE / "scenarios/explore/unknown_yard.yaml")


class Scout(ToolTest):
    def test_unknown_yard(self):
        result = self.run_tool("run", YARD, "--json", "--out", self.folder, *PAGE)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        summary = json.loads(result.stdout)
        metrics = summary["metrics"]
        self.assertEqual(metrics["seen"], metrics["targets"])
        self.assertEqual(metrics["reached"], metrics["targets"])
        self.assertEqual(metrics["contacts"], 0)
        self.assertGreater(metrics["explored_fraction"], 0.98)
        log = self.log_of(".")
        self.assertGreater(log.read("/shots")[0][0], metrics["explore_s"])
        found = log.latest("/map")
        self.assertEqual(len(found.data), found.info.width * found.info.height)
        if PAGE:
            with open(f"{self.folder}/guard.html", encoding="utf-8") as file:
                log = (self.folder / "run.mcap").read_bytes()
                self.assertIn(base64.b64encode(log).decode(), file.read())

    def test_what_does_not_go_together(self):
        for words in [["--targets-block"], ["--wander-speed", "0.5"]]:
            result = self.run_tool("run", YARD, *words)
            self.assertEqual(result.returncode, 2, words)
            self.assertIn("an unknown yard", result.stderr)


if __name__ == "__main__":
    main()
