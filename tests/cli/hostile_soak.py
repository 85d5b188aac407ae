"""Makes thousands of hostile files of every format, and tells which ended badly: `make hostile`.

A file that ended badly is made again by the same seed, so its name says which it was.
"""
import argparse
import collections
import concurrent.futures
import pathlib
import tempfile

import hostile
import hostile_chains
import hostile_seeds


def one_folder(task):
    """Tries all variants of one valid file, or one that was made by hand, in a folder of its own."""
    name, seed, share = task
    found = []
    with tempfile.TemporaryDirectory(prefix="outrider-hostile-") as home:
        folder = pathlib.Path(home)
        hostile_seeds.beside(folder, lambda words: hostile.run(words, folder))
        if name is None:
            tries = [(label, file, content(), words) for label, file, content, words in hostile_chains.made_by_hand() if label == seed]
            name = "made by hand"
        else:
            valid = next(each for each in hostile_seeds.seeds(folder) if each.name == name)
            tries = [("valid", valid.file, valid.content, valid.words)]
            tries += [(label, valid.file, content, valid.words)
                      for label, content in hostile.variants(valid, hostile.generator(seed, name), share)]
        for label, file, content, words in tries:
            ended = hostile.try_file(folder, file, content, words)
            found.append((name, label, ended, words))
    return found


def names():
    for name, *_ in [*hostile_seeds.texts(), *hostile_seeds.binaries()]:
        yield name


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--share", type=float, default=1.0, help="of the variants of each valid file")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="part of the names of the files to make")
    given = parser.parse_args()
    tasks = [(name, given.seed, given.share) for name in names() if given.only in name]
    tasks += [(None, label, 1.0) for label, *_ in hostile_chains.made_by_hand() if given.only in label]
    statuses, bad, count = collections.Counter(), [], 0
    most_s = most_kib = 0
    with concurrent.futures.ProcessPoolExecutor(given.jobs) as pool:
        for task, found in zip(tasks, pool.map(one_folder, tasks)):
            slowest = max(found, key=lambda one: one[2].processor_s)
            largest = max(found, key=lambda one: one[2].memory_kib)
            print(f"{task[0] or task[1]:60} {len(found):5} files, at most {slowest[2].processor_s:5.2f} s, "
                  f"{largest[2].memory_kib >> 10:5} MiB", flush=True)
            for name, label, ended, words in found:
                count += 1
                statuses[ended.status >> 8 if not ended.status & 0x7F else "signal"] += 1
                most_s, most_kib = max(most_s, ended.processor_s), max(most_kib, ended.memory_kib)
                complaint = ended.wrong or ("it is valid and was refused" if label == "valid" and ended.status >> 8 > 1 else "")
                if complaint:
                    bad.append(f"{name}: {label}: {complaint}: {' '.join(words)}: {ended.output[:200]!r}")
                    print("  BAD", bad[-1], flush=True)
    print(f"{count} hostile files: {len(bad)} ended badly; at most {most_s:.1f} s of processor and {most_kib >> 10} MiB; "
          f"statuses {dict(sorted(statuses.items(), key=str))}")
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
