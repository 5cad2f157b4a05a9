#!/usr/bin/env python3
"""pages.py - the pages of docs/ and exercises/ hang together: links, pictures, formulas, navigation, and the site of docs/.

    tests/lint/pages.py [ROOT]

Prints TAP; tests/run runs it. The site is made only where MkDocs and its parts are installed (`make deps-docs`). A tree with
planted mistakes, made here, shows that each check can fail.
"""
import html.parser
import os
import re
import shutil
import subprocess
import sys
import tempfile
from urllib.parse import unquote

ROOT = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "../.."))
KATEX = "/usr/share/javascript/katex"


# ---- what a page says ----

def pages(root):
    return sorted(name for name in os.listdir(os.path.join(root, "docs")) if name.endswith(".md"))


def all_pages(root):
    """Paths of what a repository's browser shows as a page: docs/, and the exercises' tasks and hints."""
    found = ["docs/" + name for name in pages(root)]
    for where, _, names in os.walk(os.path.join(root, "exercises")):
        found += [os.path.relpath(os.path.join(where, name), root) for name in names if name.endswith(".md")]
    return sorted(found)


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as stream:
        return stream.read()


def prose(text):
    """Without code and formulas, in which brackets mean other things."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`|\$[^$\n]*\$", "", re.sub(r"^    .*$", "", text, flags=re.M))


def anchors(text):
    titles = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-") for title in titles}


# ---- checks: each yields findings ----

def broken_links(root):
    for name in all_pages(root):
        for target in re.findall(r"\]\(([^)\s]+)\)", prose(read(root, name))):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            full = os.path.normpath(os.path.join(root, os.path.dirname(name), path)) if path else os.path.join(root, name)
            if not os.path.exists(full):
                yield f"{name}: there is no {target}"
            elif anchor and anchor not in anchors(read(root, os.path.relpath(full, root))):
                yield f"{name}: {path} has no heading #{anchor}"


def unused_pictures(root):
    said = "".join(read(root, "docs/" + name) for name in pages(root)) + read(root, "README.md")
    said += "".join(read(root, os.path.join(where, "README.md")) for where, _, names in
                    os.walk(os.path.join(root, "exercises")) if "README.md" in names)
    for name in sorted(os.listdir(os.path.join(root, "docs/images"))):
        if name not in said and not re.match(r"ex_\d\d_", name):  # those are drawn for the exercises' pages
            yield f"docs/images/{name}: no page shows it"


def wrong_navigation(root):
    listed = re.findall(r": ([\w/]+\.md)$", read(root, "mkdocs.yml"), re.M)
    for name in pages(root):
        if listed.count(name) != 1:
            yield f"mkdocs.yml: nav lists {name} {listed.count(name)} times, want 1"
    for name in listed:
        if name not in pages(root):
            yield f"mkdocs.yml: nav lists {name}, which is not in docs/"


def wrong_order(root):
    """docs/README.md links the pages in the order of the navigation, and each lesson page leads to the next one."""
    listed = [name for name in re.findall(r": ([\w/]+\.md)$", read(root, "mkdocs.yml"), re.M) if name != "README.md"]
    linked = re.findall(r"^\d+\. \[[^\]]*\]\((\w+\.md)\)", read(root, "docs/README.md"), re.M)
    if linked != listed:
        yield f"docs/README.md: its list is {' '.join(linked)}, that of mkdocs.yml {' '.join(listed)}"
    for name, after in zip(listed, listed[1:]):
        found = re.search(r"^(?:.*\. )?Next: \[[^\]]*\]\((\w+\.md)\)", read(root, "docs/" + name), re.M)
        if found and found[1] != after:
            yield f"docs/{name}: leads to {found[1]}, the navigation to {after}"


def wrong_formulas(root):
    for name in all_pages(root):
        text = read(root, name)
        if len(re.findall(r"^```", text, re.M)) % 2:
            yield f"{name}: a ``` without its twin"
        text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
        for paragraph in re.sub(r"`[^`\n]*`", "", text).split("\n\n"):
            if paragraph.count("$") % 2:
                yield f"{name}: a $ without its twin near {paragraph.strip()[:50]!r}"


CHECKS = [broken_links, unused_pictures, wrong_navigation, wrong_order, wrong_formulas]


# ---- the site ----

class Page(html.parser.HTMLParser):
    """Addresses of a page of the site, and how many elements hold a formula."""

    def __init__(self):
        super().__init__()
        self.addresses, self.formulas, self.torn, self.formula = [], 0, 0, None  # formula: the tag that holds one

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.torn += self.formula is not None  # what looks like a tag in a formula: j<i
        if "arithmatex" in (given.get("class") or "").split():
            self.formulas, self.formula = self.formulas + 1, tag
        for key in ("href", "src"):
            if given.get(key):
                self.addresses.append((tag, given[key]))

    def handle_endtag(self, tag):
        if tag == self.formula:
            self.formula = None


def site_findings(site):
    for where, _, names in os.walk(site):
        for name in sorted(names):
            path = os.path.join(where, name)
            if name.endswith(".css"):
                for address in re.findall(r"url\(([^)]*)\)", read(site, os.path.relpath(path, site))):
                    if re.match(r"[\"']?(https?:)?//", address):
                        yield f"{name}: needs {address}"
            if not name.endswith(".html") or name == "404.html":
                continue
            page = Page()
            page.feed(read(site, os.path.relpath(path, site)))
            for tag, address in page.addresses:
                if re.match(r"(https?:)?//", address):
                    if tag != "a":
                        yield f"{name}: needs {address}"
                elif not re.match(r"#|[a-z]+:", address):
                    target = os.path.normpath(os.path.join(where, unquote(address.split("#")[0])))
                    if not os.path.isfile(target):
                        yield f"{name}: {address} is not in the site"


def lost_formulas(root, site):
    """A formula that the site's Markdown did not see is shown as its source."""
    for name in pages(root):
        text = read(root, "docs/" + name)
        blocks = len(re.findall(r"^```math", text, re.M))
        text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
        text = re.sub(r"^    .*$", "", text, flags=re.M)
        wanted = blocks + len(re.findall(r"\$[^$]+\$", re.sub(r"`[^`\n]*`", "", text)))
        page = Page()
        page.feed(read(site, "index.html" if name == "README.md" else name[:-3] + ".html"))
        if page.formulas != wanted:
            yield f"{name}: {wanted} formulas, {page.formulas} in the site"
        if page.torn:
            yield f"{name}: {page.torn} tags inside of formulas; is a < not escaped?"


def build_site(root):
    site = tempfile.mkdtemp()
    try:
        made = subprocess.run(["mkdocs", "build", "--quiet", "--site-dir", site], cwd=root, capture_output=True, text=True)
        yield from (made.stdout + made.stderr).splitlines() if made.returncode else []
        if made.returncode == 0:
            yield from site_findings(site)
            yield from lost_formulas(root, site)
    finally:
        shutil.rmtree(site)


def missing_part():
    program = shutil.which("mkdocs")
    if not program:
        return "mkdocs"
    with open(program, "rb") as stream:  # a script, with an interpreter of its own
        interpreter = stream.readline().decode(errors="replace").lstrip("#!").split()
    if subprocess.run([*interpreter, "-c", "import pymdownx"], capture_output=True).returncode:
        return "python3-pymdownx"
    return None if os.path.isdir(KATEX) else "libjs-katex"


# ---- mistakes, to be found ----

def tree(root, changes):
    """A little tree without findings, with some files changed."""
    files = {
        "README.md": "# Top\n![A picture](docs/images/a.png)\n", "exercises/README.md": "", "docs/images/a.png": "",
        "docs/README.md": "# Docs\n1. [One](one.md)\n2. [Two](two.md)\n", "docs/two.md": "# Two\nEnd.\n",
        "docs/one.md": "# One\n![A](images/a.png) [two](two.md#two) $x$\n\nNext: [two](two.md).\n",
        "mkdocs.yml": "nav:\n  - D: README.md\n  - One: one.md\n  - Two: two.md\n",
    }
    for path, text in {**files, **changes}.items():
        os.makedirs(os.path.dirname(os.path.join(root, path)) or root, exist_ok=True)
        with open(os.path.join(root, path), "w", encoding="utf-8") as stream:
            stream.write(text)


PLANTED = [
    ("a link to nowhere", broken_links, {"docs/two.md": "[x](three.md)\n"}),
    ("an exercise's link to nowhere", broken_links, {"exercises/01_one/README.md": "[x](../../docs/three.md)\n"}),
    ("a heading that is not there", broken_links, {"docs/two.md": "[x](one.md#three)\n"}),
    ("a picture that is not there", broken_links, {"docs/two.md": "![x](images/b.png)\n"}),
    ("a picture that no page shows", unused_pictures, {"docs/images/b.png": ""}),
    ("a page outside the navigation", wrong_navigation, {"docs/three.md": "# Three\n"}),
    ("a page of the navigation that is not there", wrong_navigation,
     {"mkdocs.yml": "nav:\n  - D: README.md\n  - One: one.md\n  - Two: two.md\n  - Three: three.md\n"}),
    ("another order", wrong_order, {"docs/README.md": "1. [Two](two.md)\n2. [One](one.md)\n"}),
    ("a page that leads elsewhere", wrong_order, {"docs/one.md": "Next: [docs](README.md).\n"}),
    ("half a formula", wrong_formulas, {"docs/two.md": "It costs $x.\n"}),
    ("a fence without its twin", wrong_formulas, {"docs/two.md": "```math\nx\n"}),
]


def planted(check, changes):
    root = tempfile.mkdtemp()
    try:
        tree(root, {})
        clean = [finding for any_check in CHECKS for finding in any_check(root)]
        tree(root, changes)
        if clean:
            yield f"the tree without mistakes: {clean[0]}"
        elif not list(check(root)):
            yield "it was not found"
    finally:
        shutil.rmtree(root)


def main():
    tests = [(check.__name__.replace("_", " ") + ": none", lambda check=check: check(ROOT)) for check in CHECKS]
    tests += [(f"{name} is found", lambda check=check, changes=changes: planted(check, changes))
              for name, check, changes in PLANTED]
    print(f"1..{len(tests) + 1}")
    failed = 0
    for number, (name, run) in enumerate(tests, 1):
        findings = list(run())
        failed += bool(findings)
        print(f"{'not ok' if findings else 'ok'} {number} - {name}")
        for finding in findings:
            print(f"# {finding}")
    number, missing, name = len(tests) + 1, missing_part(), "the site is made, whole, and needs no network"
    if missing:
        print(f"skipped: {missing} is not installed, `make deps-docs` brings it\nok {number} - {name} # SKIP")
    else:
        findings = list(build_site(ROOT))
        failed += bool(findings)
        print(f"{'not ok' if findings else 'ok'} {number} - {name}")
        for finding in findings:
            print(f"# {finding}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
