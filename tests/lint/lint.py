#!/usr/bin/env python3
"""lint.py - the house rules that a machine can check (docs/architecture.md, docs/conventions.md).

    tests/lint/lint.py [ROOT]

Prints one line per finding, "path:line: what, hint", and exits 1 if there is any. A rule is a function that takes the
tree and yields (path, line, text); tests/lint/selftest.py plants a violation of each and looks whether it is found.
Kernels are compiled by tests/lint/kernels_compile.c.
"""
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

FOLDERS = ["lab", "splat2d", "splat3d", "kernels", "exercises", "tests", "docs", ".ci"]
CODE = (".c", ".h", ".cpp", ".cl")
HEADER_LINES, FILE_LINES, FUNCTION_LINES = 200, 500, 80

# An include points to a lower floor or to the own folder. (The longest prefix of the path decides.)
FLOORS = {"kernels": 0, "lab/base": 1, "lab/io": 2, "lab/gpu": 2, "splat2d": 3, "splat3d": 4, "exercises": 5,
          "lab/app": 6, "tests": 7}

# Headers that only some files may include, and why.
OWNERS = [
    (r"CL/", r"lab/gpu/", "OpenCL stays behind lab/gpu/gpu.h"),
    (r"lab/gpu/opencl\.h", r"lab/gpu/", "it is private to lab/gpu; use lab/gpu/gpu.h"),
    (r"lab/(gpu/|io/image_io)", r"(?!splat2d/)", "splat2d is plain C: numbers and JSON, no device, no picture files"),
    (r"OpenImageIO/", r"lab/io/image_io\.cpp", "use lab/io/image_io.h"),
    (r"(backends/)?imgui", r"lab/app/gui_imgui\.cpp", "use lab/app/gui.h"),
    (r"GLFW/", r"lab/app/", "windows belong to lab/app"),
    (r"popt\.h", r"lab/app/", "the command line belongs to lab/app"),
    (r"(cmocka\.h|gsl/)", r"tests/", "only tests may use it"),
]


def is_a_students(root, path):
    """exercises/01_cov2/cov2.c belongs to the person who learns; the stub beside it is ours."""
    found = re.match(r"exercises/\d+_(\w+)/(\w+)\.(c|cl)$", path)
    return bool(found) and found[1] == found[2] and os.path.exists(os.path.join(root, os.path.dirname(path), f"stub.{found[3]}"))


class Tree:
    """The text files below root: `lines[path]`; `code` are the paths of C, C++ and OpenCL C."""

    def __init__(self, root):
        self.root, self.lines = root, {}
        paths = [name for name in os.listdir(root) if os.path.isfile(os.path.join(root, name))]
        for folder in FOLDERS:
            for where, _, names in os.walk(os.path.join(root, folder)):
                paths += [os.path.relpath(os.path.join(where, name), root) for name in names]
        for path in sorted(paths):
            if is_a_students(root, path):
                continue
            if path.endswith(CODE + (".py", ".md", ".txt")) or "." not in os.path.basename(path)[1:]:
                with open(os.path.join(root, path), "rb") as stream:
                    data = stream.read()
                if b"\0" not in data:  # else a program
                    self.lines[path] = data.decode("utf-8").split("\n")
        self.code = [path for path in self.lines if path.endswith(CODE)]

    def includes(self, path):
        """(line number, name, is a project's own) of each #include; names in kernels/ are relative to that folder."""
        for number, line in enumerate(self.lines[path], 1):
            found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
            if found:
                own, name = found[1] == '"', found[2]
                yield number, "kernels/" + name if own and path.startswith("kernels/") else name, own


def floor_of(path):
    folders = [folder for folder in FLOORS if path.startswith(folder + "/")]
    return max(folders, key=len) if folders else None


def include_direction(tree):
    for path in tree.code:
        for number, name, own in tree.includes(path):
            here, there = floor_of(path), floor_of(name)
            if own and name not in tree.lines:
                yield path, number, f'"{name}" is not in the tree, write includes from the root'
            elif own and here and there and here != there and FLOORS[here] <= FLOORS[there]:
                yield path, number, (f"{here} (floor {FLOORS[here]}) includes {there} (floor {FLOORS[there]}), "
                                     "an include points to a lower floor or the own folder")


def include_owner(tree):
    for path in tree.code:
        for number, name, _ in tree.includes(path):
            for header, owner, hint in OWNERS:
                if re.match(header, name) and not re.match(owner, path):
                    yield path, number, f"{name} may not be included here, {hint}"


def include_cycle(tree):
    done = set()

    def visit(path, trail):
        if path in trail:
            circle = trail[trail.index(path):] + [path]
            line = next(number for number, name, _ in tree.includes(trail[-1]) if name == path)
            yield trail[-1], line, f"includes go in a circle: {' -> '.join(circle)}, move the shared part down"
        elif path in tree.lines and path not in done:
            for _, name, own in tree.includes(path):
                if own:
                    yield from visit(name, trail + [path])
            done.add(path)

    for path in tree.code:
        yield from visit(path, [])


def header_alone(tree):
    for_host = {name for path in tree.code if not path.startswith("kernels/") for _, name, _ in tree.includes(path)}
    headers = [path for path in tree.code if path.endswith(".h")
               and (not path.startswith("kernels/") or path in for_host)]

    def compile_header(path):
        command = ["cc", "-std=c17", "-Wall", "-Wextra", "-Werror", "-D_GNU_SOURCE", "-DCL_TARGET_OPENCL_VERSION=120",
                   "-I.", "-fsyntax-only", "-x", "c", "-include", path, "/dev/null"]
        return subprocess.run(command, cwd=tree.root, capture_output=True, text=True).stderr

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for path, errors in zip(headers, pool.map(compile_header, headers)):
            found = re.search(r"^(\S+?):(\d+):\d+: (?:fatal )?(?:error|warning): (.*)$", errors, re.M)
            if found:
                yield path, int(found[2]) if os.path.normpath(found[1]) == path else 1, f"does not compile alone: {found[3]}"
            elif errors:
                yield path, 1, "does not compile alone: " + errors.split("\n")[0]


def first_line(tree):
    for path in tree.code:
        name = os.path.basename(path)
        if path.endswith((".h", ".cl")) and name != "stub.cl" and not tree.lines[path][0].startswith(f"// {name} - "):
            yield path, 1, f"the first line says what the file is: // {name} - ..."


def length(tree):
    for path in tree.code:
        limit = HEADER_LINES if path.endswith(".h") else FILE_LINES
        if len(tree.lines[path]) - 1 > limit:
            yield path, limit + 1, f"{len(tree.lines[path]) - 1} lines, at most {limit}; does it own two nouns?"


def function_length(tree):
    """Formatted code opens a function in the first column and closes it with a lone brace there."""
    for path in tree.code:
        start, head = 0, ""
        for number, line in enumerate(tree.lines[path], 1):
            if re.match(r"[A-Za-z_].*\(", line) and not line.startswith(("typedef", "struct", "enum")):
                start, head = number, line
            elif line == "}" and start:
                if number - start + 1 > FUNCTION_LINES:
                    name = re.search(r"(\w+)\(", head)[1]
                    yield path, start, f"{name}() has {number - start + 1} lines, at most {FUNCTION_LINES}; split it"
                start = 0


def unique_name(tree):
    """One name, one file: a person who reads it in a message knows which. (Exercises repeat their own pattern.)"""
    first = {}
    for path in tree.code:
        name = os.path.basename(path)
        if not path.startswith("exercises/") and first.setdefault(name, path) != path:
            yield path, 1, f"{first[name]} has the same name, rename one"


def blanks(tree):
    for path, lines in tree.lines.items():
        for number, line in enumerate(lines, 1):
            if line != line.rstrip():
                yield path, number, "blanks at the end of the line, remove them"
            if "\t" in line and os.path.basename(path) != "Makefile":
                yield path, number, "a tab, use blanks"
        if lines[-1] != "" or lines[-2:] == ["", ""]:
            yield path, len(lines), "the file ends with one newline, no more and no less"


def words(tree):
    for path in tree.code:
        for number, line in enumerate(tree.lines[path], 1):
            found = re.search(r"\b(TODO|FIXME|XXX)\b", line)
            if found and not path.startswith("exercises/"):
                yield path, number, f"{found[1]}: finish it, or leave it out"
            if re.match(r"\s*goto\b", line):
                yield path, number, "goto: let x_destroy() accept a half-built object instead"


def formatted(tree):
    out = subprocess.run(["clang-format", "--dry-run", "-ferror-limit=1", *tree.code], cwd=tree.root,
                         capture_output=True, text=True).stderr
    seen = set()
    for path, number in re.findall(r"^(\S+?):(\d+):\d+: \w+: code should be clang-formatted", out, re.M):
        if path not in seen:
            seen.add(path)
            yield path, int(number), "not in the form of .clang-format, run `make format`"


RULES = [include_direction, include_owner, include_cycle, header_alone, first_line, length, function_length,
         unique_name, blanks, words, formatted]


def main():
    tree = Tree(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "../.."))
    findings = [finding for rule in RULES for finding in rule(tree)]
    for path, line, text in findings:
        print(f"{path}:{line}: {text}")
    print(f"lint: {len(tree.lines)} files, {len(findings)} findings", file=sys.stderr)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
