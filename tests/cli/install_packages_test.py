"""scripts/install-packages with a dpkg and an apt that only note what they are asked for."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(os.environ["OUTRIDER_SOURCE"], "scripts/install-packages")
PACKAGES = """
# a comment
build  libpresent-dev        is installed
build  libnew-dev|libold-dev  has two names
build  libmissing-dev        reads rare files
page   tool-package|true     a command of any origin
"""
COMMANDS = {
    "dpkg-query": 'echo "installed libpresent-dev"',
    "apt-get": 'echo "$@" >> "$ASKED"',
    "apt-cache": 'case $2 in $KNOWN) echo "$2 | 1.0";; esac',
    "id": "echo 0",
}


class InstallPackages(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        (folder / "scripts").mkdir()
        shutil.copy(SCRIPT, folder / "scripts")
        (folder / "packages.txt").write_text(PACKAGES)
        self.folder, self.asked = folder, folder / "asked"

    def run_script(self, *groups, known, without=()):
        bin_folder = self.folder / "bin"
        shutil.rmtree(bin_folder, ignore_errors=True)
        bin_folder.mkdir()
        for name in ("sh", "awk", "sort", "dirname", "grep", "env", "true", "tr"):
            (bin_folder / name).symlink_to(shutil.which(name))
        for name, body in COMMANDS.items():
            if name not in without:
                (bin_folder / name).write_text(f"#!/bin/sh\n{body}\n")
                (bin_folder / name).chmod(0o755)
        self.asked.write_text("")
        env = {"PATH": str(bin_folder), "ASKED": str(self.asked), "KNOWN": known}
        result = subprocess.run([shutil.which("sh"), self.folder / "scripts/install-packages", *groups], env=env,
                                capture_output=True, text=True, check=False)
        return result, self.asked.read_text()

    def test_takes_the_first_name_that_the_release_has(self):
        for known, taken in {"lib*": "libnew-dev", "libold-dev": "libold-dev"}.items():
            result, asked = self.run_script("build", known=known)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f" {taken}", asked)
            self.assertEqual(asked.count("libnew-dev") + asked.count("libold-dev"), 1)
            self.assertNotIn("libpresent-dev", asked)

    def test_lists_what_no_release_has_with_its_purpose_and_goes_on(self):
        result, asked = self.run_script("build", known="libnew-dev")
        self.assertEqual(result.returncode, 0)
        self.assertIn("libmissing-dev reads rare files", result.stderr)
        self.assertIn("install --yes --no-install-recommends libnew-dev\n", asked)

    def test_goes_on_without_apt(self):
        result, asked = self.run_script("build", known="lib*", without=("apt-get", "apt-cache", "dpkg-query"))
        self.assertEqual((result.returncode, asked), (0, ""))
        for purpose in ("is installed", "has two names", "reads rare files"):
            self.assertIn(purpose, result.stderr)

    def test_a_command_of_any_origin_will_do(self):
        result, asked = self.run_script("page", known="lib*")
        self.assertEqual((result.returncode, asked, result.stderr), (0, "", ""))

    def test_refuses_a_group_without_packages(self):
        result, asked = self.run_script("pagee", known="lib*")
        self.assertEqual((result.returncode, asked), (2, ""))
        self.assertIn("'pagee'", result.stderr)


if __name__ == "__main__":
    unittest.main()
