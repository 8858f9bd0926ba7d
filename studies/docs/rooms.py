"""What Doxygen says of each namespace: the list of folders of contributing.md, with a link to the folder's page."""

import re

ROW = re.compile(r"^\| `([a-z/_]+)` \| (.*) \|$", re.M)


def page(root):
    lines = ["/**"]
    for folder, words in ROW.findall((root / "studies/docs/contributing.md").read_text()):
        name = folder.removeprefix("lib/")
        if not any((root / folder).rglob("*.hpp")) or name == "tests":
            continue
        lines += [rf"\namespace {'dovetail' if name == 'core' else 'dovetail::' + name}", rf"\brief `{folder}`: {words}", ""]
        about = "studies/program" if name == "studies" else folder
        lines += [f"More on [its page](../{about}/README.html).", "", rf"\dir {folder}", rf"\brief {words}", ""]
    return "\n".join([*lines, "*/", ""])
