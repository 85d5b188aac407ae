"""Runs every job on tiny worlds with keys at the ends of their ranges, beyond them, and in random pairs: `make totality RUNS=20000`.

Every run has to end with exit status 0 to 3 in less than 10 s of processor time and 1 GiB, without a signal; where it refuses,
with one sentence of at most 400 characters and without leaving a file. Prints what did not, with the command that repeats it.
"""
import argparse
import pathlib
import shutil
import sys

from totality import MOST_S, cases, command_of, run, shortest, write_worlds


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=20000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most", type=float, default=MOST_S, help="processor time of a run, s")
    parser.add_argument("--only", default="", help="part of the names of the bases and keys to try")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/totality"))
    given = parser.parse_args()
    shutil.rmtree(given.out, ignore_errors=True)
    given.out.mkdir(parents=True)
    write_worlds(given.out)
    tried = [case for case in cases(given.runs, given.seed) if given.only in case.named()]
    found, costs, total_s = {}, [], 0.0
    for number, case in enumerate(tried):
        result = run(case, given.out, given.most)
        total_s += result.processor_s
        costs.append((result.processor_s, result.memory_mib, case.named()))
        if not result.complaint:
            continue
        case, result = shortest(case, result, given.out, given.most)
        cause = (case.base, *case.values, result.complaint[:40])
        if cause not in found:
            found[cause] = case
            print(f"{case.named():64} {result.complaint}\n    {command_of(case, given.out, number)}", flush=True)
    if costs:
        print(f"{len(tried)} runs, {total_s:.0f} s of processor time; the longest {max(costs)[0]:.1f} s ({max(costs)[2]}), "
              f"the largest {max(cost[1] for cost in costs):.0f} MiB; {len(found)} did wrong")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
