"""A run that is stopped ends soon, and leaves nothing half-written: a few moments of a scenario of each job."""
import json
import os
import random
import resource
import signal
import subprocess

from cancel import more_runs, processor_s, scenario_jobs, stop_at, usual_s
from held_run import HeldRun
from tool import SOURCE, TOOL, ToolTest, main, until

PARTS = (0.1, 0.6)  # of the usual time
MOST_S = 2.0  # of the processors' work from the signal to the end; cancel_soak.py asks for less, of time too


def one_of_each_job():
    rows = {}
    for path, job in scenario_jobs():
        rows.setdefault(job, []).append(path)
    small = {"guard": "driveby", "drive": "open_loop", "cover": "cover_room", "explore": "leaking_yard"}
    for job, paths in rows.items():
        yield job, next((path for path in paths if small.get(job, "") in path.stem), paths[0])


class Cancel(ToolTest):
    def test_each_job_at_some_moments(self):
        runs = [(job, ["run", str(path)]) for job, path in one_of_each_job()] + more_runs()[:1]
        for name, words in runs:
            usual = usual_s(words)
            for part in PARTS:
                with self.subTest(run=name, part=part):
                    stopped = stop_at(words, part * usual)
                    self.assertEqual(stopped.complaint, "")
                    self.assertLess(stopped.worked_s, MOST_S)

    def test_from_the_first_moment(self):
        """A signal that waits when the tool begins raises the token: blocked before, it is not lost."""
        scenario = str(SOURCE / "scenarios/yard/yard.yaml")
        process = subprocess.Popen([TOOL, "run", scenario, "--json", "--out", "out"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                   preexec_fn=lambda: (signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]),
                                                       os.kill(os.getpid(), signal.SIGINT)))
        output, errors = process.communicate()
        self.assertEqual(process.returncode, 1, errors)
        answer = json.loads(output)
        self.assertEqual((answer["status"], answer["job"], answer["files"]), ("cancelled", "guard", {}))
        self.assertIn("nothing was written", " ".join(answer["warnings"]))
        self.assertFalse((self.folder / "out").exists())

    def test_what_does_not_hear_is_ended(self):
        """A dense graph is one factorisation, which takes far longer than a stop may."""
        draws = random.Random(1)
        nodes = [(draws.uniform(-50, 50), draws.uniform(-50, 50)) for _ in range(2000)]
        pairs = [(k, k + 1) for k in range(1999)] + [draws.sample(range(2000), 2) for _ in range(8000)]
        self.write("dense.g2o", "".join(
            [f"VERTEX_SE2 {k} {x:.3f} {y:.3f} 0\n" for k, (x, y) in enumerate(nodes)] +
            [f"EDGE_SE2 {a} {b} {nodes[b][0] - nodes[a][0]:.3f} {nodes[b][1] - nodes[a][1]:.3f} 0 1 0 0 1 0 1\n"
             for a, b in pairs]))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        with subprocess.Popen([TOOL, "slam", "dense.g2o", "--json", "--out", "out"], cwd=self.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL) as process:
            worked_s = until("work on the graph", lambda: max(0.0, processor_s(process.pid) - 3.0)) + 3.0
            process.terminate()
            output, errors = process.communicate()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertEqual(process.returncode, 1, errors)
        answer = json.loads(output)
        self.assertEqual((answer["status"], answer["files"]), ("cancelled", {}))
        self.assertIn("cannot be interrupted", answer["reason"])
        self.assertFalse((self.folder / "out").exists())
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime - worked_s, MOST_S)

    def test_what_an_earlier_run_left_stays_whole(self):
        words = self.guard("--out", "out")
        self.assertEqual(self.run_tool(*words).returncode, 0)
        before = self.tree()
        scenario = SOURCE / "scenarios/yard/yard.yaml"
        with HeldRun("run", scenario, "--out", "out", "--plan-resolution", "0.05", variable="OUTRIDER_PROGRESS", room=140,
                     cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
            run.wait_until_held()  # after its first line
            run.send_signal(signal.SIGINT)
            self.assertRegex(run.read(1 << 40).decode().split()[0], '"name":"surveying')
            output, errors = run.communicate()
        self.assertEqual(run.returncode, 1, errors)
        self.assertIn("cancelled", output)
        self.assertIn("nothing was written to out", errors)
        self.assertEqual(self.tree(), before)
        self.assertEqual(self.run_tool("replay", "out").returncode, 0)


if __name__ == "__main__":
    main()
