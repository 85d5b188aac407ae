"""The decision problem as PDDL, our plan for it, and the verdict on plans.

The files are read here by an interpreter that knows PDDL 2.1 and nothing of guns, and follows the plan through
them: what our judge says and what the files say must be the same.
"""
import operator
import re
import unittest

from tool import SOURCE, ToolTest, flat, main

STATIONS = ["--supplies-stations=well=-2,-2,water dock=0,-2.3,charge", "--supplies-tank", "1",
            "--supplies-battery", "1"]
TOLERANCE = 1e-6


def expressions(text):
    """Nested lists of the words of a PDDL file."""
    stack = [[]]
    for word in re.findall(r"[()]|[^\s()]+", re.sub(";.*", "", text.lower())):
        if word == "(":
            stack.append([])
        elif word == ")":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack[-1].append(word)
    (whole,) = stack[0]
    return whole


def section(whole, name):
    return next(part for part in whole[1:] if isinstance(part, list) and part[0] == name)


def typed(words):
    """{object: type} of 'a b - pose c - target'."""
    result, waiting = {}, []
    words = iter(words)
    for word in words:
        if word == "-":
            kind = next(words)
            result.update({name: kind for name in waiting})
            waiting = []
        else:
            waiting.append(word)
    assert not waiting, waiting
    return result


class Interpreter:
    """One durative action after the other."""

    def __init__(self, domain, problem):
        domain, problem = expressions(domain), expressions(problem)
        self.objects = typed(section(domain, ":constants")[1:]) | typed(section(problem, ":objects")[1:])
        self.declared = {f[0] for f in section(domain, ":predicates")[1:]}
        self.functions = {f[0] for f in section(domain, ":functions")[1:] if isinstance(f, list)}
        self.actions = {a[1]: dict(zip(a[2::2], a[3::2])) for a in domain if a[0] == ":durative-action"}
        self.facts, self.numbers = set(), {}
        for fact in section(problem, ":init")[1:]:
            if fact[0] == "=":
                assert fact[1][0] in self.functions, fact
                self.numbers[tuple(fact[1])] = float(fact[2])
            else:
                assert fact[0] in self.declared, fact
                self.facts.add(tuple(fact))
        self.goal = [tuple(fact) for fact in section(problem, ":goal")[1][1:]]

    def number(self, term, bound):
        if isinstance(term, str):
            return bound[term] if term in bound else float(term)
        if term[0] in ("+", "-", "*"):
            does = {"+": operator.add, "-": operator.sub, "*": operator.mul}[term[0]]
            return does(self.number(term[1], bound), self.number(term[2], bound))
        return self.numbers[tuple(bound.get(word, word) for word in term)]

    def holds(self, condition, bound):
        if condition[0] in ("=", ">="):
            left, right = self.number(condition[1], bound), self.number(condition[2], bound)
            return left >= right - TOLERANCE and (condition[0] == ">=" or left <= right + TOLERANCE)
        assert condition[0] in self.declared, condition
        return tuple(bound.get(word, word) for word in condition) in self.facts

    def apply(self, effects, bound):
        """At one moment: what is taken away first, and numbers from those before."""
        before = [(e, self.number(e[2], bound)) for e in effects if e[0] in ("assign", "decrease")]
        ground = lambda fact: tuple(bound.get(word, word) for word in fact)
        self.facts -= {ground(e[1]) for e in effects if e[0] == "not"}
        self.facts |= {ground(e) for e in effects if e[0] in self.declared}
        for effect, amount in before:
            key = ground(effect[1])
            assert key in self.numbers, key
            self.numbers[key] = amount if effect[0] == "assign" else self.numbers[key] - amount

    def run(self, name, words, duration):
        """The first broken condition, or None."""
        action = self.actions[name]
        parameters = typed(action[":parameters"])
        assert len(parameters) == len(words), (name, words)
        bound = dict(zip(parameters, words)) | {"?duration": duration}
        for parameter, kind in parameters.items():
            assert self.objects[bound[parameter]] == kind, (parameter, words)
        lasts = action[":duration"]
        conditions, effects = action[":condition"][1:], action[":effect"][1:]
        for bad in (c for c in (lasts[1:] if lasts[0] == "and" else [lasts]) if not self.holds(c, bound)):
            return bad
        for moment in ("start", "end"):
            for bad in (c for _, when, c in conditions if when == moment and not self.holds(c, bound)):
                return bad
            self.apply([e for _, when, e in effects if when == moment], bound)
        return None


def lines_of(plan):
    return [(float(t), words.split(), float(d)) for t, words, d in
            re.findall(r"^([\d.]+): \((.*)\) \[([\d.]+)\]$", plan, re.M)]


class Pddl(ToolTest):
    def written(self, *flags, folder="pddl"):
        result = self.run_tool(*self.guard(*flags, "--json", "--pddl", "--out", folder))
        self.assertEqual(result.returncode, 0, result.stderr)
        return flat(self.json_of(result))

    def judged(self, plan, *flags):
        self.write("their.txt", plan)
        result = self.run_tool(*self.guard(*flags, "--json", "--validate", "their.txt"))
        verdict = flat(self.json_of(result))
        self.assertEqual(result.returncode, 0 if verdict["status"] == "done" else 1, result.stderr)
        return verdict

    def text(self, name):
        return (self.folder / "pddl" / name).read_text()

    def followed(self):
        """Carries our plan out by the files, and returns its end."""
        world = Interpreter(self.text("domain.pddl"), self.text("problem.pddl"))
        end = 0.0
        for start, (name, *words), duration in lines_of(self.text("plan.txt")):
            self.assertGreater(start, end - 1e-12)
            self.assertIsNone(world.run(name, words, duration), (name, words))
            end = start + duration
        self.assertLessEqual(set(world.goal), world.facts)
        return end

    def test_our_plan_is_valid_by_the_files_and_by_the_judge(self):
        for flags in [[], STATIONS, ["--pddl-stops", "2"]]:
            with self.subTest(flags=flags):
                answer = self.written(*flags)
                self.assertEqual(sorted(p.name for p in (self.folder / "pddl").iterdir()),
                                 ["domain.pddl", "plan.txt", "problem.pddl", "run.json"])
                self.assertAlmostEqual(self.followed(), answer["makespan_s"], places=6)
                verdict = self.judged(self.text("plan.txt"), *flags)
                self.assertEqual((verdict["status"], verdict["reason"]), ("done", ""))
                self.assertLess(abs(verdict["makespan_s"] / verdict["our_makespan_s"] - 1), 1e-6)
                self.assertLessEqual(answer["lower_bound_s"], answer["makespan_s"] + 1e-6)
                self.assertEqual(answer["stations"], 2 if flags == STATIONS else 0)

    def test_the_judge_agrees_with_the_files_on_changed_plans(self):
        self.written(*STATIONS)
        lines = lines_of(self.text("plan.txt"))
        agreed = 0
        for i in range(len(lines)):
            for name, changed in [("without", lines[:i] + lines[i + 1:]), ("twice", lines[:i + 1] + lines[i:]),
                                  ("short", lines[:i] + [(*lines[i][:2], lines[i][2] - 0.05)] + lines[i + 1:])]:
                world = Interpreter(self.text("domain.pddl"), self.text("problem.pddl"))
                broken = any(world.run(words[0], words[1:], duration) for _, words, duration in changed)
                valid = not broken and set(world.goal) <= world.facts
                time, text = 0.0, ""
                for _, words, duration in changed:
                    text += f"{time:.9f}: ({' '.join(words)}) [{duration:.9f}]\n"
                    time += duration
                verdict = self.judged(text, *STATIONS)
                self.assertEqual(verdict["status"] == "done", valid, (name, lines[i], verdict))
                agreed += 1
        self.assertGreater(agreed, 15)

    def test_the_first_broken_condition_is_told(self):
        self.written()
        lines = self.text("plan.txt").splitlines()
        verdict = self.judged("\n".join(lines[:1] + lines[2:]))
        self.assertEqual(verdict["status"], "not_done")
        self.assertRegex(verdict["reason"], r"^their\.txt:2: \(shoot .*\): it begins at another pose")
        verdict = self.judged("; nothing\n")
        self.assertEqual(verdict["reason"], "target t0 is never hit")
        self.write("their.txt", "\n".join(lines))
        result = self.run_tool(*self.guard("--validate", "their.txt"))
        self.assertRegex(result.stdout, r"^valid: \d+ actions, makespan [\d.]+ s; ours takes [\d.]+ s\n")

    def test_the_same_bytes_with_any_threads(self):
        self.written("--threads", "1")
        before = self.tree()
        self.written("--threads", "2")
        self.assertEqual(self.tree(), before)

    def test_what_supplies_do_not_suffice_for_is_left_out(self):
        answer = self.written("--supplies-tank", "1")
        self.assertEqual(answer["metrics"]["targets"], 1)
        self.assertEqual((answer["left_out"], len(answer["warnings"])), (2, 2))
        self.assertIn("is left out", self.text("problem.pddl"))
        self.followed()

    def test_what_is_wrong_gets_a_sentence(self):
        self.write("deep.txt", "0: " + "(" * 100000 + ")" * 100000)
        self.write("plan.txt", "; ours\n0: (fly p0-0 p1-0) [2]\n")
        self.write("file", "")
        for flags, says in [
                (["--validate", "plan.txt"], ["plan.txt:2", "'(fly p0-0 p1-0)' is no action here"]),
                (["--validate", "none.txt"], ["none.txt", "no such file"]),
                (["--pddl", "--out", ""], ["--out", "its name is empty"]),
                (["--pddl", "--out", "file/x"], ["--out", "is no folder"]),
                (["--pddl", "--validate", "plan.txt"], ["pddl.validate", "leave one of"]),
                (["--pddl", "--pddl-stops", "-1"], ["--pddl-stops", "'-1'", "from 0 to 300"]),
                (["--pddl", "--robots", "2"], ["pddl", "several robots"]),
                (["--validate", "deep.txt"], ["deep.txt:1"]),
                (["--pddl", "--arrivals-count", "2", "--arrivals-entrances=gate=-2,-2"],
                 ["pddl", "still yard"])]:
            with self.subTest(flags=flags):
                self.refused(*self.guard(*flags), says=says)

    def test_nothing_to_decide_is_an_answer(self):
        self.write("high.txt", "type=1 x=1 y=-1 z=40\n")
        self.refused(*self.guard("--targets", "high.txt", "--pddl"), says=["no target can be hit"], status=1)

    def test_the_bundled_scenario(self):
        scenario = SOURCE / "scenarios" / "stations" / "stations.yaml"
        result = self.run_tool("guard", "--scenario", scenario, "--plan-resolution", "0.2", "--pddl", "--out", "pddl")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("(fill-", self.text("plan.txt"))
        self.followed()


if __name__ == "__main__":
    main()
