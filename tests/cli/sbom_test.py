"""The list of what the tool is made of names every library that it links and every package of the page."""
import json
import re
import subprocess
import unittest

from tool import SOURCE, TOOL, main


class Sbom(unittest.TestCase):
    def test_nothing_is_missing(self):
        written = [subprocess.run([SOURCE / "scripts/sbom", TOOL], capture_output=True, text=True, check=True).stdout
                   for _ in range(2)]
        self.assertEqual(*written, "the same bytes each time")
        document = json.loads(written[0])
        self.assertEqual((document["bomFormat"], document["specVersion"]), ("CycloneDX", "1.5"))
        version = subprocess.run([TOOL, "--version"], capture_output=True, text=True, check=True).stdout.strip()
        self.assertEqual(document["metadata"]["component"]["version"], version)
        components = document["components"]
        self.assertEqual(len({one["bom-ref"] for one in components}), len(components), "each once")
        for one in components:
            self.assertTrue(one["version"] and one["purl"].endswith(one["version"]) or "?arch=" in one["purl"], one)
        linked = " ".join(one.get("description", "") for one in components)
        libraries = re.findall(r"=> \S*/(\S+) ", subprocess.run(["ldd", TOOL], capture_output=True, text=True, check=True).stdout)
        self.assertGreater(len(libraries), 10)
        self.assertEqual([name for name in libraries if name not in linked], [])
        names = {one["name"] for one in components}
        lock = json.loads((SOURCE / "web/package-lock.json").read_text())["packages"]
        wanted = {path.rsplit("node_modules/", 1)[1] for path, entry in lock.items() if path and not entry.get("optional")}
        self.assertEqual(wanted - names, set())
        self.assertIn("libboost-dev", names)
        self.assertTrue(any(name.startswith("libyaml-cpp0.") for name in names), names)


if __name__ == "__main__":
    main()
