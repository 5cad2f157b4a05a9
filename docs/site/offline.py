"""offline.py - what MkDocs does not do by itself, for a site that works from a folder without a network.

Links that leave docs/ (to the program's own files) lead to copies as plain text, folders to a list of them. KaTeX comes
from the system's package. The theme's addresses on other machines, for things that no page uses, are taken out.
"""
import html
import os
import re
import shutil

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DOCS = os.path.join(ROOT, "docs")
KATEX = "/usr/share/javascript/katex"
SHOWN = (".md", ".png", ".jpg")  # what a browser shows from docs/ as it is
LINK = re.compile(r"(\]\()([^)#\s]+)([^)]*\))")
FORMULA = re.compile(r"^```math\n.*?^```$", re.M | re.S)

linked = set()  # paths from ROOT


def on_page_markdown(markdown, page, **_):
    here = os.path.dirname(os.path.join(DOCS, page.file.src_path))

    def follow(match):
        target = match[2]
        if re.match(r"[a-z]+:", target):
            return match[0]
        path = os.path.relpath(os.path.normpath(os.path.join(here, target)), ROOT)
        if path.startswith("docs" + os.sep) and path.endswith(SHOWN):
            return match[0]
        linked.add(path)
        end = "/index.html" if os.path.isdir(os.path.join(ROOT, path)) else ".txt"
        return f"{match[1]}source:{path}{end})"  # to MkDocs an address that it need not know

    # Fenced formulas come into the page as they are, where j<i would begin a tag.
    markdown = FORMULA.sub(lambda match: match[0].replace("<", "\\lt ").replace(">", "\\gt "), markdown)
    # In a repository's browser what stands in <details> is Markdown anyway.
    return LINK.sub(follow, markdown).replace("<details>", '<details markdown="1">')


def on_page_content(content, page, **_):
    up = "../" * page.url.count("/")
    return content.replace('href="source:', f'href="{up}source/')


def copy_text(path, site):
    to = os.path.join(site, "source", path + ".txt")
    os.makedirs(os.path.dirname(to), exist_ok=True)
    shutil.copyfile(os.path.join(ROOT, path), to)


def copy_folder(path, site):
    names = sorted(os.listdir(os.path.join(ROOT, path)))
    files = [name for name in names if os.path.isfile(os.path.join(ROOT, path, name))]
    for name in files:
        copy_text(os.path.join(path, name), site)
    os.makedirs(os.path.join(site, "source", path), exist_ok=True)
    with open(os.path.join(site, "source", path, "index.html"), "w", encoding="utf-8") as page:
        rows = "".join(f'<li><a href="{html.escape(name)}.txt">{html.escape(name)}</a></li>\n' for name in files)
        page.write(f'<!doctype html><meta charset="utf-8"><title>{path}</title><h1>{path}</h1>\n<ul>\n{rows}</ul>\n')


def on_post_build(config, **_):
    site = config["site_dir"]
    for path in sorted(linked):
        (copy_folder if os.path.isdir(os.path.join(ROOT, path)) else copy_text)(path, site)
    os.makedirs(os.path.join(site, "katex"), exist_ok=True)
    for name in ("katex.min.css", "katex.min.js", "contrib/auto-render.js"):
        shutil.copyfile(os.path.join(KATEX, name), os.path.join(site, "katex", os.path.basename(name)))
    shutil.copytree(os.path.join(KATEX, "fonts"), os.path.join(site, "katex", "fonts"), dirs_exist_ok=True)
    scripts = os.path.join(site, "assets", "javascripts")
    for folder in ("lunr", "workers"):  # of the search, which needs a server
        shutil.rmtree(os.path.join(scripts, folder), ignore_errors=True)
    for folder in (scripts, os.path.join(site, "assets", "stylesheets")):
        for name in sorted(os.listdir(folder)):
            path = os.path.join(folder, name)
            if name.endswith(".map"):
                os.remove(path)
                continue
            with open(path, encoding="utf-8") as stream:
                text = stream.read()
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(re.sub(r"https://(unpkg\.com|api\.github\.com|gitlab\.com)/", "no-network/", text))
