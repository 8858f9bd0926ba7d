#!/usr/bin/env python3
"""Checks the pages beside the code, without Sphinx:  python3 tests/docs/check_pages.py [FOLDER]

Every relative link leads to a file that is there, and to a heading where it names one; every status and doubt that a
program may answer is explained in studies/program/statuses.md, and every message quoted there stands in the sources.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]).resolve()
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
STATUSES = "studies/program/statuses.md"
# Where the names stand that a status may be.
NAMED = {
    "lib/core/status.hpp": "Status",
    "optimizer/problem/outcome.hpp": "Outcome",
    "lib/wear/asymptote/asymptote.hpp": "Verdict",
    "lib/wear/history/history.hpp": "HistoryEnd",
}


def pages():
    yield ROOT / "README.md"
    for part in ("lib", "geometry", "optimizer", "studies", "tests"):
        yield from sorted((ROOT / part).rglob("*.md"))


def without_code(text):
    """Links are looked for in words: in code [a](b) is an index and a call."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(page):
    """Headings as git hosts and the site name them: lower case, spaces as dashes, no punctuation."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), re.M):
        name = re.sub(r"[^\w\- ]", "", re.sub(r"\]\([^)]*\)", "]", heading).lower()).replace(" ", "-")
        times = sum(1 for other in found if re.fullmatch(re.escape(name) + r"(-\d+)?", other))
        found.add(f"{name}-{times}" if times else name)
    return found


def broken_links():
    for page in pages():
        for link in LINK.findall(without_code(page.read_text())):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = (page.parent / path).resolve() if path else page
            name = f"{page.relative_to(ROOT)}: {link}"
            if not target.is_file():  # the site has no pages of folders
                yield f"{name}: no such file"
            elif anchor and anchor not in anchors(target):
                yield f"{name}: no such heading"


def names_without_explanation():
    explained = (ROOT / STATUSES).read_text()
    names = [name for file, kind in NAMED.items()
             for name in re.findall(rf'\{{{kind}::\w+, "(\w+)"\}}', (ROOT / file).read_text())]
    names += [name for name in re.findall(r'Doubt::\w+, "(\w+)"', (ROOT / "lib/wear/asymptote/doubt.cpp").read_text())]
    if len(names) < 30:
        yield f"{STATUSES}: only {len(names)} names of statuses were found in the sources"
    for name in names:
        if f"`{name}`" not in explained:
            yield f"{STATUSES}: `{name}` is not explained"


def messages_nobody_says():
    sources = "".join(file.read_text() for part in ("lib", "geometry", "optimizer", "studies") for file in (ROOT / part).rglob("*.[ch]pp"))
    sources = re.sub(r'"\s*\n?\s*"', "", sources)  # literals that follow one another are one
    for table in re.findall(r"^\| it says .*\n\|.*\n((?:\|.*\n)+)", (ROOT / STATUSES).read_text(), re.M):
        for row in table.splitlines():
            for words in row.split("|")[1].split("..."):
                if words.strip(" ,.;:") and words.strip() not in sources:
                    yield f"{STATUSES}: \"{words.strip()}\" is said nowhere"


wrong = [*messages_nobody_says(), *broken_links(), *names_without_explanation()]
if len((ROOT / "README.md").read_text().splitlines()) >= 150:
    wrong.append("README.md: has 150 lines or more; what it says beyond a newcomer's needs belongs on a page of its own")
if wrong:
    sys.exit("\n".join(wrong))
print(f"pages: {sum(1 for _ in pages())}, every relative link leads somewhere, every status is explained, every message is one")
