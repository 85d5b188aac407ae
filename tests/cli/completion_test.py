"""Completion of the shells, and the pages for man: both name every command and every flag that the help names."""
import functools
import json
import re
import shutil
import subprocess
import unittest

from tool import TOOL, ToolTest, main

BASH = r"""
compopt() { :; }
source outrider.bash
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_outrider
printf '%s\n' "${COMPREPLY[@]}"
"""


@functools.cache
def help_of(*words):
    return subprocess.run([TOOL, *words, "--help"], capture_output=True, text=True, check=True).stdout


def commands_of(*words):
    """The commands below one, as lists of words."""
    listed = help_of(*words).partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    return [[*words, line.split()[0]] for line in listed.splitlines()]


def all_commands():
    return [one for command in commands_of() for one in [command, *commands_of(*command)]]


def flags_of(*words):
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_of(*words), re.MULTILINE))


class Completion(ToolTest):
    def setUp(self):
        super().setUp()
        for shell, name in (("bash", "outrider.bash"), ("zsh", "_outrider"), ("fish", "outrider.fish")):
            (self.folder / name).write_text(self.run_tool("completion", shell).stdout)

    def bash(self, *words):
        found = subprocess.run(["bash", "-c", BASH, "bash", "outrider", *words], cwd=self.folder, capture_output=True,
                               text=True, check=True)
        self.assertEqual(found.stderr, "")
        return set(found.stdout.split())

    def test_bash_completes_what_the_help_lists(self):
        self.assertEqual(self.bash(""), {command[0] for command in commands_of()} | {"-h", "--help", "--version"})
        self.assertGreater(len(all_commands()), 20)
        for command in all_commands():
            self.assertEqual(self.bash(*command, "--"), flags_of(*command), command)

    def test_bash_completes_files_where_files_are_wanted(self):
        (self.folder / "yonder.yaml").touch()
        self.assertEqual(self.bash("run", "yo"), {"yonder.yaml"})
        self.assertEqual(self.bash("plan", "--map", "yo"), {"yonder.yaml"})
        self.assertEqual(self.bash("plan", "--radius", "yo"), set())

    def test_bash_completes_values_that_are_one_of_few(self):
        planners = set(json.loads(self.run_tool("schema", "--job", "pursue").stdout)["properties"]["planner"]["enum"])
        self.assertGreater(len(planners), 1)
        self.assertEqual(self.bash("pursue", "--planner", ""), planners)
        self.assertEqual(self.bash("schema", "--as", "s"), {"schema", "scenario"})
        self.assertEqual(self.bash("completion", "z"), {"zsh"})

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes_what_the_help_lists(self):
        for command in all_commands():
            script = f"source outrider.fish; complete -C 'outrider {' '.join(command)} --'"
            found = subprocess.run(["fish", "--no-config", "-c", script], cwd=self.folder, capture_output=True, text=True,
                                   check=True)
            self.assertEqual({line.split()[0] for line in found.stdout.splitlines()}, flags_of(*command), command)

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_takes_its_script(self):
        subprocess.run(["zsh", "-n", "_outrider"], cwd=self.folder, check=True)

    def test_zsh_names_what_the_help_lists(self):
        script = (self.folder / "_outrider").read_text()
        for command in all_commands():
            function = script.partition("\n_outrider_" + "_".join(command) + "() {\n")[2].partition("\n}\n")[0]
            self.assertEqual(set(re.findall(r"^    (?:'\(-h --help\)'\{-h,|')(--[\w-]+)", function, re.MULTILINE)),
                             flags_of(*command), command)

    def test_another_shell_is_refused(self):
        result = self.run_tool("completion", "tcsh")
        self.assertEqual(result.returncode, 2)
        self.assertIn("'tcsh' is not valid; expected bash, zsh or fish", result.stderr)


class ManualPages(ToolTest):
    def page(self, *command):
        return self.run_tool("manual", *command).stdout

    def test_they_name_what_the_help_lists(self):
        for command in commands_of():
            page = self.page(*command).replace("\\-", "-")
            self.assertIn(f".B outrider {command[0]}\n", page)
            wanted = set().union(*(flags_of(*one) for one in [command, *commands_of(*command)]))
            self.assertEqual(set(re.findall(r"\\fB(--[\w-]+)\\fR", page)), wanted, command)
            self.assertIn(f"\\fB{command[0]}\\fR\n", self.page())
        self.assertEqual(self.run_tool("manual", "nothing").returncode, 2)

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_groff_has_nothing_to_complain_about(self):
        for command in [[], *commands_of()]:
            result = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z"], input=self.page(*command), text=True,
                                    capture_output=True, check=True)
            self.assertEqual(result.stderr, "", command)


if __name__ == "__main__":
    main()
