"""The page of all claims that tests/verification makes, from the names of its tests."""

import re

TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+),\s*(\w+)\)", re.M)


def sentence(name):
    """HoldTheTrueErrors -> hold the true errors; capitals in a row stay as they are."""
    words = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+", name)
    return " ".join(word if word.isupper() and len(word) > 1 else word.lower() for word in words)


def page(root):
    folder = root / "tests/verification"
    lines = ["# Every claim", "",
             "What the tests of `tests/verification` claim, by their names; the figures are on [Validation](tests/README.md).",
             "`bash tests/run -R Subject` repeats those of a subject.", ""]
    for room in sorted(path for path in folder.iterdir() if path.is_dir()):
        rows = [f"| `{subject}` | {sentence(name)} | `{file.name}` |"
                for file in sorted(room.glob("*_test.cpp")) for subject, name in TEST.findall(file.read_text())]
        if rows:
            lines += [f"## {room.name}", "", "| subject | claim | file |", "|---|---|---|", *rows, ""]
    return "\n".join(lines)
