#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages as HTML:  docs.py BUILD FOLDER

Writes into FOLDER the manual pages of BUILD/man by mandoc, the README.md files by cmark-gfm, their pictures, and the page
BUILD/depthprec.html. A command that the page has is a link to it, with the command typed in. All of it opens from disk,
and may be served as it is: no address in it begins with a slash.
"""

import concurrent.futures
import html
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import formulas

READMES = ["README.md", "plots/README.md", "src/README.md", "tests/README.md", "src/python/README.md",
           "src/python/RECIPES.md", "src/npm/README.md"]
SHOWN = [
    ("index.html", "Start"),
    ("man/depthprec-questions.7.html", "Questions"),
    ("man/depthprec.1.html", "Commands"),
    ("man/depthprec-camera.7.html", "Cameras"),
    ("man/depthprec.7.html", "Theory"),
    ("man/depthprec.5.html", "Files and JSON"),
    ("man/depthprec.3.html", "Library"),
    ("plots/index.html", "Gallery"),
    ("depthprec.html", "Try it"),
]
COMMAND = re.compile(r"^( *(?:\$ )?)(depthprec (?:[^\n]|(?<=\\)\n)*)", re.M)


def run(*words, text=None):
    return subprocess.run(words, input=text, capture_output=True, text=True, check=True).stdout


def words_of(command):
    """The arguments that the page can be given: without the pipe behind them and the file that is written."""
    try:
        words = shlex.split(command.replace("\\\n", " "), comments=True)[1:]
    except ValueError:
        return None
    for stop in ("|", ">", ";", "&&"):
        words = words[: words.index(stop)] if stop in words else words
    if "-o" in words:
        file = words.index("-o")
        del words[file : file + 2]
    return words


class Links:
    """The page's addresses of commands, each asked of the program once."""

    def __init__(self, program):
        self.program, self.known = str(program), {}

    def ask(self, commands):
        def one(words):
            got = subprocess.run([self.program, *words, "--link"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
            return got.stdout.strip() if got.returncode == 0 and got.stdout.startswith("depthprec.html#") else ""

        new = [w for w in {tuple(c) for c in commands if c} if w not in self.known]
        with concurrent.futures.ThreadPoolExecutor() as pool:
            self.known.update(zip(new, pool.map(one, new)))

    def of(self, words):
        return self.known.get(tuple(words or ()), "")


def plain(markup):
    return html.unescape(re.sub(r"<[^>]*>", "", markup))


def commands_in(body):
    for block in re.findall(r"<pre>(?:<code[^>]*>)?(.*?)</pre>", body, re.S):
        yield from (m[2] for m in COMMAND.finditer(plain(block)))
    yield from (plain(c) for c in re.findall(r"<code>(depthprec .*?)</code>", body, re.S))


def linked(body, links, up):
    """The same with each command that the page has as a link."""

    def anchor(command, shown):
        address = links.of(words_of(command))
        return f'<a class="try" href="{up}{html.escape(address)}">{shown}</a>' if address else shown

    def block(match):
        text = plain(match[2])
        if not COMMAND.search(text):
            return match[0]
        out, end = [], 0
        for m in COMMAND.finditer(text):
            out += [html.escape(text[end : m.start(2)]), anchor(m[2], html.escape(m[2]))]
            end = m.end()
        return match[1] + "".join(out) + html.escape(text[end:]) + match[3]

    body = re.sub(r"(<pre>(?:<code[^>]*>)?)(.*?)((?:</code>)?</pre>)", block, body, flags=re.S)
    return re.sub(r"<code>(depthprec .*?)</code>", lambda m: anchor(plain(m[1]), m[0]), body, flags=re.S)


def named(body):
    """The same with a name for each heading and each term that lacks one: what is looked for ends there."""
    taken = set(re.findall(r'\bid="([^"]*)"', body))

    def give(match):
        tag, rest, inner = match[1], match[2], match[3]
        if "id=" in rest or 'id="' in inner:
            return match[0]
        name = base = re.sub(r"[^\w.-]+", "-", plain(inner).strip()).strip("-")[:60] or tag
        for n in range(2, 1000):
            if name not in taken:
                break
            name = f"{base}-{n}"
        taken.add(name)
        return f'<{tag} id="{html.escape(name)}"{rest}>{inner}</{tag}>'

    return re.sub(r"<(h[1-6]|dt)\b([^>]*)>(.*?)</\1>", give, body, flags=re.S)


def numbered(body):
    """The questions, each with a name, and a list of them on top."""
    count, listed = 0, []

    def give(match):
        nonlocal count
        count += 1
        listed.append(f'<li><a href="#q{count}">{match[1].strip()}</a></li>')
        return f'<li id="q{count}">{match[1]}<div'

    head, mark, rest = body.partition('<ol class="Bl-enum">')
    rest = re.sub(r"<li>(.*?)<div", give, rest, flags=re.S)
    return f"{head}<ol>{''.join(listed)}</ol>{mark}{rest}"


def sections(title, address, body):
    """What search knows: of each heading and each term its name, its place, and the words behind it."""
    parts = re.split(r"<(?=(?:h[1-6]|dt)\b)", body)
    for part in parts[1:]:
        inner = re.match(r"(h[1-6]|dt)\b[^>]*>(.*?)</\1>", part, re.S)
        name = re.search(r'\bid="([^"]*)"', part[: inner.end()])
        text = " ".join(plain(part[inner.end() :]).split())
        yield [" ".join(plain(inner[2]).split()), title, f"{address}#{html.unescape(name[1])}", text]


def page(title, address, body):
    up = "../" * address.count("/")
    shown = "".join(
        f'<a href="{up}{a}"{" aria-current=page" if a == address else ""}>{name}</a>' for a, name in SHOWN
    )
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{html.escape(title)}</title>
<link rel="stylesheet" href="{up}docs.css">
<script src="{up}search.js" data-up="{up}" defer></script>
</head>
<body>
<nav aria-label="Pages">{shown}
<input type="search" placeholder="Search" aria-label="Search all pages" autocomplete="off"></nav>
<main><div id="search-results" role="status" hidden></div>
{body}</main>
</body>
</html>
"""


def manual(source):
    name = source.name
    body = run("mandoc", "-T", "html", "-O", "fragment,toc,man=%N.%S.html", str(source))
    body = re.sub(r'<table class="(head|foot)">.*?</table>', "", body, flags=re.S)
    here = {p.name for p in source.parent.iterdir()}
    body = re.sub(  # a page of another program has no file here
        r'<a class="Xr" href="([^"]*)\.html">(.*?)</a>', lambda m: m[0] if m[1] in here else m[2], body, flags=re.S
    )
    # In a fragment all pages begin with h1; here each has one, its own name.
    body = re.sub(r"(</?)h([1-4])\b", lambda m: f"{m[1]}h{int(m[2]) + 1}", body)
    body = body.replace("TABLE OF CONTENTS</h2>", "Contents</h2>")
    if name == "depthprec.7":
        body = re.sub(r"<pre>(.*?)</pre>", lambda m: formulas.block(plain(m[1])) or m[0], body, flags=re.S)
    if name == "depthprec-questions.7":
        body = numbered(body)
    root, section = name.rsplit(".", 1)
    return f"{root}({section})", f"man/{name}.html", f"<h1>{root}({section})</h1>{body}"


def readme(source):
    body = run("cmark-gfm", "-e", "table", "-t", "html", source)
    body = re.sub(r'(href="[^"]*)README\.md', r"\1index.html", body).replace('href="RECIPES.md', 'href="RECIPES.html')
    title = plain(re.search(r"<h1>(.*?)</h1>", body)[1])
    # The first row of a table without headings is empty; a picture in a heading stays one.
    body = re.sub(r"<thead>\s*<tr>(?:\s*<th></th>)+\s*</tr>\s*</thead>", "", body)
    return title, source.replace("README.md", "index.html").replace(".md", ".html"), body


def main(build, folder):
    build, folder = pathlib.Path(build), pathlib.Path(folder)
    pages = [readme(r) for r in READMES] + [manual(m) for m in sorted((build / "man").iterdir())]
    links = Links(build / "depthprec")
    links.ask(words_of(c) for _, _, body in pages for c in commands_in(body))
    shutil.rmtree(folder, ignore_errors=True)
    found = []
    for title, address, body in pages:
        body = linked(named(body), links, "../" * address.count("/"))
        body = re.sub(r"<(pre|table)\b", r'<\1 tabindex="0"', body)  # wider than a phone, they scroll: by keys, too
        found += sections(title, address, body)
        file = folder / address
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(page(title, address, body), encoding="utf-8")
        for target in re.findall(r'(?:src|href)="([^"#:]+)"', body):  # pictures, and files that are named
            source = (pathlib.Path(address).parent / target).resolve().relative_to(pathlib.Path.cwd())
            if source.is_file() and not (folder / source).exists():
                (folder / source).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, folder / source)
    shutil.copy(build / "depthprec.html", folder)
    for name in ("docs.css", "search.js"):
        shutil.copy(f"man/{name}", folder)
    with open(folder / "sections.js", "w", encoding="utf-8") as out:
        out.write("sections(" + json.dumps(found, ensure_ascii=False, separators=(",", ":")) + ");\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
