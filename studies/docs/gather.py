"""Gathers the pages of the site from the folders they describe:  gather.py PROGRAM FOLDER

Pages keep their places in the tree, so links between them work here as on a git host; files they link to come along.
The front page is the README with the contents of the site at its end. Made here are the reference of keys, from the program,
the list of what tests claim, from their names, and that of folders' pages, of all that the contents do not name.
"""

import pathlib
import re
import shutil
import subprocess
import sys

import checks
import keys
import rooms

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARTS = ("lib", "geometry", "optimizer", "studies", "tests")
CONTENTS = ROOT / "studies/docs/contents.md"
LINK = re.compile(r"\]\(([^)#:]+)[)#]")


def pages():
    found = [ROOT / "README.md"]
    for part in PARTS:
        found += sorted((ROOT / part).rglob("*.md"))
    return [page for page in found if page != CONTENTS]


def copy(file, folder):
    there = folder / file.relative_to(ROOT)
    there.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(file, there)


def other_pages():
    """A page that lists those which the contents do not."""
    contents = CONTENTS.read_text()
    names = [page.relative_to(ROOT).with_suffix("").as_posix() for page in pages()]
    lines = [f"{name.removesuffix('/README')} </{name}>" for name in names if name != "README" and f"/{name}\n" not in contents]
    return "\n".join(["# Folders, one by one", "", "```{toctree}", ":maxdepth: 1", "", *lines, "```", ""])


def main(program, folder):
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    for page in pages():
        copy(page, folder)
        for link in LINK.findall(page.read_text()):
            target = (page.parent / link).resolve()
            if target.is_file() and target.suffix != ".md" and ROOT in target.parents:
                copy(target, folder)
    front = folder / "README.md"
    front.write_text(front.read_text() + "\n" + CONTENTS.read_text())
    (folder / "checks.md").write_text(checks.page(ROOT))
    (folder / "folders.md").write_text(other_pages())
    (folder / "rooms.dox").write_text(rooms.page(ROOT))
    schema = subprocess.run([program, "schema", "study"], capture_output=True, text=True, check=True).stdout
    (folder / "keys.md").write_text(keys.page(schema))


if __name__ == "__main__":
    main(*sys.argv[1:])
