"""The tool describes itself: help, version, catalogue, schema, and the generated pages of the manual."""
import json
import re
import unittest

from tool import SOURCE, ToolTest, main

COMMANDS = ["run", "guard", "pursue", "drive", "cover", "plan", "slam", "detect", "calibrate", "replay", "serve",
            "list", "schema"]
JOBS = ["cover", "drive", "explore", "fleet", "guard", "plan", "pursue", "slam"]


def refusals(schema, value, where=""):
    """Returns where a value differs from a schema, for the few words of JSON schema that ours uses."""
    known = {"$schema", "title", "type", "description", "properties", "additionalProperties", "minimum", "maximum",
             "default", "enum"}
    assert set(schema) <= known, set(schema) - known
    types = {"object": dict, "string": str, "boolean": bool, "integer": int, "number": (int, float)}
    if not isinstance(value, types[schema["type"]]) or (schema["type"] != "boolean" and isinstance(value, bool)):
        return [f"{where}: not of type {schema['type']}"]
    found = []
    if not schema.get("minimum", value) <= value <= schema.get("maximum", value) if isinstance(value, (int, float)) else 0:
        found.append(f"{where}: out of range")
    if value not in schema.get("enum", [value]):
        found.append(f"{where}: not one of {schema['enum']}")
    for key, inner in value.items() if isinstance(value, dict) else ():
        if key in schema["properties"]:
            found += refusals(schema["properties"][key], inner, f"{where}.{key}")
        else:
            assert schema["additionalProperties"] is False
            found.append(f"{where}.{key}: unknown")
    return found


def simple_yaml(text):
    """Keys and scalars, sections one deep: all that a scenario holds."""
    result, section = {}, None
    for line in text.splitlines():
        line = re.sub(r"(^|\s)#.*", "", line) if '"' not in line else line
        if not line.strip():
            continue
        key, _, value = line.strip().partition(":")
        value = value.strip()
        if not line.startswith(" "):
            section = result
        if value == "" and not line.startswith(" "):
            section = result[key] = {}
            continue
        try:
            section[key] = json.loads(value)
        except json.JSONDecodeError:
            section[key] = value
    return result


class Manual(ToolTest):
    def text(self, *args):
        result = self.run_tool(*args)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_help(self):
        overview = self.text("--help")
        for command in COMMANDS:
            self.assertIn(f"\n  {command} ", overview)
            help_text = self.text(command, "--help")
            self.assertIn(f"Usage: outrider {command}", help_text)
            self.assertEqual(help_text, self.text(command, "-h"))
            lines = help_text.splitlines()
            for line, below in zip(lines, lines[1:] + [""]):
                self.assertLessEqual(len(line), 160, line)
                if line.startswith("  -"):  # the sentence of a long flag stands below it
                    self.assertTrue(re.match(r".{35} \S", line) or re.match(r" {36}\S", below), line)
        self.assertIn("Exit status: 0", overview)

    def test_version(self):
        version = re.search(r"project\(outrider VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)
        self.assertEqual(self.text("--version").strip(), version)

    def test_every_file_that_names_the_version_names_this_one(self):
        version = self.run_tool("--version").stdout.strip()
        for file, line in (("CITATION.cff", f"version: {version}\n"), ("package.xml", f"<version>{version}</version>"),
                           ("web/package.json", f'"version": "{version}"'), ("CHANGELOG.md", f"\n## [{version}] - ")):
            self.assertIn(line, (SOURCE / file).read_text(), file)

    def test_list(self):
        catalogue = json.loads(self.text("list", "--json"))
        self.assertEqual([job["name"] for job in catalogue["jobs"]], JOBS)
        text = self.text("list")
        for planner in catalogue["path_planners"]:
            self.assertLessEqual({"name", "sentence", "paper", "guarantee", "complete", "models"}, set(planner))
            self.assertIn(planner["name"], text)
            self.assertIn(planner["paper"], text)
            if "cells" not in planner["models"]:
                continue
            answer = self.run_tool("plan", "small.map", "--from", "0.5,0.5", "--to", "5.5,3.5", "--planner", planner["name"])
            self.assertEqual(answer.returncode, 0, answer.stderr)

    def test_schema_accepts_what_the_tool_accepts(self):
        schema = json.loads(self.text("schema"))
        bundled = simple_yaml((SOURCE / "scenarios/yard/yard.yaml").read_text())
        self.assertEqual(refusals(schema, bundled), [])
        complete = simple_yaml(self.text("schema", "--as", "scenario"))
        self.assertEqual(refusals(schema, complete), [])
        self.assertEqual(set(complete), set(schema["properties"]))
        for key, section in schema["properties"].items():
            for inner, option in section.get("properties", {}).items():
                self.assertEqual(complete[key][inner], option["default"])
        self.assertNotEqual(refusals(schema, {"sed": 1}), [])
        self.assertNotEqual(refusals(schema, {"robot": {"radius": -1}}), [])
        self.assertNotEqual(refusals(schema, {"seed": "1"}), [])
        self.assertNotEqual(refusals(schema, {"plan": {"planner": "nothing"}}), [])
        for job in ("cover", "drive", "explore", "fleet", "plan", "pursue", "slam"):
            defaults = simple_yaml(self.text("schema", "--job", job, "--as", "scenario"))
            self.assertEqual(refusals(json.loads(self.text("schema", "--job", job)), defaults), [], job)

    def test_scenario_round_trip(self):
        scenario = self.text("schema", "--as", "scenario")
        self.write("all.yaml", scenario)
        flags = ["--world", "yard.sdf", "--targets", "targets.txt", "--start", "0,-2,90", "--plan-resolution", "0.2",
                 "--plan-iterations", "50", "--plan-refinements", "0"]
        self.assertEqual(self.run_tool("run", "all.yaml", *flags, "--out", "a").returncode, 0)
        self.assertEqual(self.run_tool("guard", *flags, "--out", "b").returncode, 0)
        self.same_run("a", "b")

    def test_every_flag_of_the_schema_is_in_the_help(self):
        schema = json.loads(self.text("schema"))
        help_text = self.text("guard", "--help")
        for key, option in schema["properties"].items():
            names = [f"{key}-{inner}" for inner in option["properties"]] if "properties" in option else [key]
            for name in names if key != "job" else []:  # the verb is the job
                self.assertIn(f"  --{name.replace('_', '-')} ", help_text)

    def test_pages_of_options_name_every_key(self):
        for job in JOBS:
            page = self.text("schema", "--job", job, "--as", "markdown")
            self.assertTrue(page.startswith("# "), page[:80])
            for key, option in json.loads(self.text("schema", "--job", job))["properties"].items():
                for name in option.get("properties", [key]):
                    self.assertIn(f"| `{name}` |", page, job)

    def test_commands_in_the_manual_exist(self):
        """Every line of the manual that calls the tool uses flags that it has."""
        for page in ["README.md", "docs/cli.md"]:
            for words in re.findall(r"^(?:build/)?outrider (.*)$", (SOURCE / page).read_text(), re.MULTILINE):
                command, *rest = words.split()
                if command not in COMMANDS:
                    continue
                help_text = self.text(command, "--help")
                for flag in (word for word in rest if word.startswith("--")):
                    self.assertRegex(help_text, rf"(?m)(^  |,){flag}\b", f"{page}: {words}")

    def test_links_of_the_manual_lead_somewhere(self):
        pages = [page for page in SOURCE.rglob("*.md") if not page.relative_to(SOURCE).parts[0].startswith((".", "build"))
                 and not {"node_modules", ".site"} & set(page.parts)]
        self.assertGreater(len(pages), 20)
        for page in pages:
            for target in re.findall(r"\]\(([^)\s#:]+)(?:#[^)]*)?\)", page.read_text()):
                written = re.fullmatch(r"(?:[.][.]/)*(?:options-(\w+)[.]md|(\w+)[.]schema[.]json)", target)
                if written and (written[1] or written[2]) in JOBS:
                    continue  # a page that the tool writes
                self.assertTrue((page.parent / target).exists(), f"{page.relative_to(SOURCE)}: {target}")


if __name__ == "__main__":
    main()
