"""Each path of the repository that the documentation or a comment names exists.

paths_test.py SOURCES
"""
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
BUILT = re.compile(r"\.(?!ci)|build-|build$|out$")  # folders in the root that are no sources
OTHERS = re.compile(r"\n\*\*[\w.-]+/[\w.-]+\*\*\n.*?(?=\n## |\Z)", re.DOTALL)  # a list of files of another repository
PATTERN = re.compile(r"[<>*{}$=\[]|\.\.\.")


def listed() -> list[pathlib.Path]:
    """Returns every file and folder of the repository."""
    found = []
    for folder, folders, files in os.walk(ROOT):
        here = pathlib.Path(folder)
        folders[:] = [name for name in folders if name != "node_modules" and not (here == ROOT and BUILT.match(name))]
        found += [here / name for name in [*folders, *files]]
    return found


def named(path: pathlib.Path) -> list[str]:
    """Returns what a page has between backticks, or what the comments of a source say, word by word."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".md":
        quoted = re.findall(r"`([^`\n]+)`", OTHERS.sub("", text))
        return [word.strip(".,;:()\"'").rstrip("/") for words in quoted for word in words.split()]
    comments = re.findall(r"//+<?\s(.*)", text)
    return [word for comment in comments for word in re.findall(r"[\w./-]+/\w+\.(?:hpp|cpp)\b", comment)]


def main() -> int:
    paths = listed()
    tops = {path.name for path in paths if path.parent == ROOT and path.is_dir()}
    ends = set()
    for path in paths:
        parts = path.relative_to(ROOT).parts
        ends.update("/".join(parts[k:]) for k in range(len(parts)))
    checked, missing = 0, []
    for path in paths:
        if path.suffix not in (".md", ".hpp", ".cpp") or not path.is_file():
            continue
        for word in named(path):
            ours = "/" in word and (word.split("/")[0] in tops or word.endswith((".hpp", ".cpp")))
            if ours and not PATTERN.search(word):
                checked += 1
                if word.split("#")[0] not in ends:
                    missing.append(f"{path.relative_to(ROOT)}: {word}")
    print("\n".join(missing) or f"{checked} paths exist")
    return 1 if missing or checked < 100 else 0


sys.exit(main())
