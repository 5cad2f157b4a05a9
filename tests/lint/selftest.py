#!/usr/bin/env python3
"""selftest.py - plants one violation of each house rule and looks whether lint finds it, at its file and line.

Works on a small tree of its own in a scratch folder, in which lint finds nothing. Prints TAP; tests/run runs it.
"""
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
KERNELS_COMPILE = os.path.abspath(os.path.join(os.environ.get("BUILD", "build/release"), "tests/lint/kernels_compile"))


def header(path, *lines):
    """A header that keeps every rule, with `lines` from line 5 on."""
    name = os.path.basename(path)
    guard = "SPLATLAB_" + path.upper().replace("/", "_").replace(".", "_")
    return "\n".join([f"// {name} - one sentence.", f"#ifndef {guard}", f"#define {guard}", "", *lines, "", "#endif", ""])


CLEAN = {
    "Makefile": "all:\n\techo\n",
    "kernels/shared.h": header("kernels/shared.h", "#define TILE_SIZE 16"),
    "kernels/double_it.cl": "// double_it.cl - twice.\n#include \"shared.h\"\n\n"
                            "__kernel void double_it(__global float *x) { x[get_global_id(0)] *= 2; }\n",
    "lab/base/base.h": header("lab/base/base.h", "int base(void);"),
    "lab/base/base.c": "#include \"lab/base/base.h\"\n\nint base(void) { return 1; }\n",
    "lab/gpu/gpu.h": header("lab/gpu/gpu.h", "#include \"lab/base/base.h\""),
    "lab/io/io.h": header("lab/io/io.h", "#include \"lab/base/base.h\""),
    "splat3d/splat.h": header("splat3d/splat.h", "#include \"kernels/shared.h\"", "#include \"lab/gpu/gpu.h\""),
    "docs/page.md": "A page.\n",
}

# name of the case, files that are added or replaced, path and line of the finding, a word of its text
LONG_FUNCTION = "int f(void);\nint f(void) {\n" + "    f();\n" * 80 + "    return 0;\n}\n"
CASES = [
    ("an include upwards", {"lab/base/up.c": "\n#include \"splat3d/splat.h\"\n"}, "lab/base/up.c:2", "floor"),
    ("an include sideways", {"lab/io/side.c": "#include \"lab/gpu/gpu.h\"\n"}, "lab/io/side.c:1", "floor"),
    ("an include that is not from the root", {"lab/io/near.c": "#include \"io.h\"\n"}, "lab/io/near.c:1", "root"),
    ("a circle", {"lab/base/one.h": header("lab/base/one.h", "#include \"lab/base/two.h\""),
                  "lab/base/two.h": header("lab/base/two.h", "#include \"lab/base/one.h\"")}, "lab/base/two.h:5", "circle"),
    ("OpenCL outside lab/gpu", {"splat3d/cl.c": "#include <CL/cl.h>\n"}, "splat3d/cl.c:1", "lab/gpu"),
    ("OpenCL in splat2d", {"splat2d/gpu2.c": "#include \"lab/gpu/gpu.h\"\n"}, "splat2d/gpu2.c:1", "plain C"),
    ("OpenImageIO elsewhere", {"splat3d/oiio.cpp": "#include <OpenImageIO/imageio.h>\n"}, "splat3d/oiio.cpp:1", "image_io"),
    ("ImGui elsewhere", {"lab/app/main.cpp": "#include <imgui.h>\n"}, "lab/app/main.cpp:1", "gui"),
    ("cmocka outside tests", {"splat3d/t.c": "#include <cmocka.h>\n"}, "splat3d/t.c:1", "tests"),
    ("a header that does not compile alone", {"lab/io/a.h": header("lab/io/a.h", "size_t f(void);")}, "lab/io/a.h:5", "alone"),
    ("a header without its first line", {"lab/io/b.h": "#ifndef B\n#define B\n#endif\n"}, "lab/io/b.h:1", "first line"),
    ("a long header", {"lab/io/c.h": header("lab/io/c.h", *["// more"] * 195)}, "lab/io/c.h:201", "at most 200"),
    ("a long file", {"lab/io/d.c": "// more\n" * 501}, "lab/io/d.c:501", "at most 500"),
    ("a long function", {"lab/io/e.c": LONG_FUNCTION}, "lab/io/e.c:2", "f() has 83 lines"),
    ("a name that is taken", {"splat3d/base.c": "int x;\n"}, "splat3d/base.c:1", "same name"),
    ("a tab", {"docs/page.md": "A\tpage.\n"}, "docs/page.md:1", "tab"),
    ("a blank at the end", {"docs/page.md": "A page.\nMore. \n"}, "docs/page.md:2", "blanks"),
    ("no newline at the end", {"docs/page.md": "A page."}, "docs/page.md:1", "newline"),
    ("a word that marks something unfinished", {"lab/io/f.c": "// TO" "DO: the rest\n"}, "lab/io/f.c:1", "finish"),
    ("a goto", {"lab/io/g.c": "int f(void);\nint f(void) {\n    goto end;\nend:\n    return 0;\n}\n"}, "lab/io/g.c:3", "goto"),
    ("code that is not formatted", {"lab/io/h.c": "int  x;\n"}, "lab/io/h.c:1", "format"),
    ("a kernel that is not formatted", {"kernels/k.cl": "// k.cl - k.\nconstant int  x = 1;\n"}, "kernels/k.cl:2", "format"),
    ("a kernel that does not compile", {"kernels/double_it.cl": "// double_it.cl - twice.\n__kernel void double_it(float3) { x }\n"},
     "kernels/double_it.cl:2", "undeclared"),
    ("a kernel with a warning", {"kernels/double_it.cl": "// double_it.cl - twice.\n"
                                 "__kernel void double_it(__global int *x) {\n    if (x[0] = 1) x[1] = 2;\n}\n"},
     "kernels/double_it.cl:3", "paren"),
]


def run(command, folder):
    """Standard output. The device's own self-test kernel comes from the real tree, the others from `folder`."""
    environment = {**os.environ, "SPLATLAB_KERNELS": os.path.join(HERE, "../../kernels")}
    return subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True).stdout


def findings(files):
    """The output of lint and of the kernel compiler on the clean tree with `files` laid over it."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in {**CLEAN, **files}.items():
            os.makedirs(os.path.join(root, os.path.dirname(path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as stream:
                stream.write(text)
        shutil.copy(os.path.join(HERE, "../../.clang-format"), root)
        out = run([sys.executable, os.path.join(HERE, "lint.py"), root], root)
        if "kernels/double_it.cl" in files or not files:
            out += run([KERNELS_COMPILE], root)
        return out


def report(number, good, name, output):
    print(f"{'ok' if good else 'not ok'} {number} - {name}")
    if not good:
        print("\n".join("# " + line for line in (output or "no finding").split("\n")), flush=True)


def main():
    print(f"1..{len(CASES) + 1}")
    clean = findings({})
    report(1, clean == "", "nothing is found in a clean tree", clean)
    for number, (name, files, place, word) in enumerate(CASES, 2):
        output = findings(files)
        found = [line for line in output.split("\n") if line.startswith(place + ":") and word in line]
        report(number, len(found) == 1, f"lint finds {name}", output)


if __name__ == "__main__":
    main()
