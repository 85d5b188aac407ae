"""Stops runs with Ctrl-C and SIGTERM in turn, MOMENTS times each, and tells the worst latency: `make cancel`.

The runs are every published scenario, and each planner of each catalogue on something large. The moments are drawn with
a seed, from the start to somewhat after the usual end. `work s` is the most that all threads together worked after a
signal, to 10 ms: it decides, since other programs that keep the machine busy are not in it. `deaf` counts the runs that
did not hear the signal, and were ended without results.
"""
import argparse
import random
import signal
import sys
import tempfile

from cancel import SOURCE, WITHIN_S, more_runs, planning_runs, scenario_jobs, stop_at, usual_s


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moments", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--within", type=float, default=WITHIN_S, help="largest work after a signal, s")
    parser.add_argument("--only", default="", help="part of the names of the runs to do")
    given = parser.parse_args()
    draws = random.Random(given.seed)
    wrong = []
    home = tempfile.TemporaryDirectory(prefix="outrider-cancel-maps-")
    print(f"{'run':44} {'usual s':>8} {'stopped':>8} {'median s':>9} {'worst s':>8} {'at s':>7} {'work s':>7} {'deaf':>5}")
    runs = [(str(path.relative_to(SOURCE)), ["run", str(path)]) for path, _ in scenario_jobs()] + more_runs()
    runs += planning_runs(home.name, random.Random(given.seed))
    for name, words in runs:
        if given.only not in name:
            continue
        usual = usual_s(words)
        all_runs = [stop_at(words, draws.uniform(0.0, 1.02 * usual), (signal.SIGINT, signal.SIGTERM)[k % 2])
                    for k in range(given.moments)]
        wrong += [f"{name} at {run.moment_s:.3f} s: {run.complaint}" for run in all_runs if run.complaint]
        stopped = sorted((run for run in all_runs if run.latency_s > 0.0), key=lambda run: run.latency_s)
        if not stopped:
            continue
        most_work = max(run.worked_s for run in stopped)
        worst, median = stopped[-1], stopped[len(stopped) // 2]
        if most_work > given.within:
            wrong.append(f"{name}: it worked {most_work:.3f} s after a signal")
        print(f"{name:44} {usual:8.2f} {len(stopped):8} {median.latency_s:9.3f} {worst.latency_s:8.3f} "
              f"{worst.moment_s:7.3f} {most_work:7.3f} {sum(run.deaf for run in stopped):5}", flush=True)
    for line in wrong:
        print(line)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
