"""The page of all keys of a study file, made from its JSON Schema (`dovetail schema study`)."""

import json

UNITS = {  # how a key ends: what it is written in; the longest ending counts
    "_n_per_m3": "N/m³", "_n_per_m": "N/m", "_per_pa": "1/Pa", "_m3_per_j": "m³/J", "_j_per_m2": "J/m²", "_kg_m3": "kg/m³",
    "_mm": "mm", "_um": "µm", "_deg": "degrees", "_rpm": "1/min", "_gpa": "GPa", "_mpa": "MPa", "_pa": "Pa", "_hz": "Hz",
    "_n": "N", "_s": "s", "_m": "m", "_kg": "kg",
}
ABOUT = {  # tables of which the schema has no sentence: what they are
    "variable": "What may change: a number of the file between bounds, in the units of the file.",
    "linked": "Keys that follow from the variables by a formula.",
    "objective": "What counts: one response, or [several](studies/program/study_files.md#several-objectives).",
    "constraint": "Limits on responses, in SI.",
    "case": "[Several loads](studies/program/study_files.md#several-loads): what is different in each, by keys of the file.",
    "uncertain": "[What is not known for certain](studies/program/study_files.md#uncertain-numbers).",
    "export": "Formats that a run writes its best design in.",
}
MEANING = {
    "name": "Name of the study; of its directory of results, if no other is given.",
    "title": "Title of the report.",
    "material.blade.grade": "Name of a material (`dovetail materials`), in place of the numbers.",
    "material.disk.grade": "The same of the disk.",
    "variable.key": "The number that changes.",
    "variable.keys": "Several that have one value, in place of `key`.",
    "variable.lower": "Least value.",
    "variable.upper": "Largest value.",
    "variable.start": "Where the search starts; if not given, the file's number.",
    "linked.key": "The key that follows.",
    "linked.value": "A formula of the variables' keys, with `_` in place of `.`.",
    "objective.response": "The response.",
    "objective.weight": "Given for each of several: one sum of weight * response / scale.",
    "objective.scale": "What counts as one.",
    "objective.reference": "Of a front: beyond it a design counts nothing for the hypervolume.",
    "objective.absolute": "Its size counts, whatever its sign.",
    "objective.aim": "`min`, `max`, `zero`, or a number to come near to.",
    "objective.over": "Of several cases: `worst`, `mean`, `sum`, `deviation`, `quantile`, or the name of one.",
    "objective.accuracy": "Bar over value asked for this response, in place of `solver.accuracy`.",
    "constraint.response": "The response.",
    "constraint.lower": "It is to be no less.",
    "constraint.upper": "It is to be no more.",
    "constraint.scale": "What counts as one; if not given, the limit.",
    "constraint.absolute": "The limit is on its size, whatever its sign.",
    "constraint.over": "As of an objective.",
    "constraint.accuracy": "As of an objective.",
    "case.name": "Name of the case.",
    "case.weight": "Share of the life.",
    "uncertain.key": "The number that is not certain.",
    "uncertain.distribution": "`uniform` in the range, or `normal` with the deviation given by `plus_minus` or `relative`.",
    "uncertain.lower": "Least value.",
    "uncertain.upper": "Largest value.",
    "uncertain.plus_minus": "Half of the range, about the file's number; of a variable about the design's.",
    "uncertain.relative": "The same as a share of that number.",
    "uncertain.mean": "With `plus_minus`: the middle, in place of the file's number.",
    "export.formats": "The formats.",
}


def unit(key):
    endings = [ending for ending in UNITS if key.endswith(ending)]
    return UNITS[max(endings, key=len)] if endings else ""


def number(value):
    return f"{value:.12g}"


def allowed(schema):
    if "anyOf" in schema:
        return " or ".join(allowed(choice) for choice in schema["anyOf"])
    if "const" in schema:
        return number(schema["const"])
    if "enum" in schema:
        return ", ".join(f"`{name}`" for name in schema["enum"])
    if schema.get("type") == "array":
        return "list of " + (allowed(schema["items"]) or "values")
    if schema.get("type") in ("string", "boolean"):
        return {"string": "text", "boolean": "`true`, `false`"}[schema["type"]]
    bounds = []
    for name, sign in (("exclusiveMinimum", ">"), ("minimum", "≥"), ("exclusiveMaximum", "<"), ("maximum", "≤")):
        if name in schema:
            bounds.append(f"{sign}\N{NO-BREAK SPACE}{number(schema[name])}")
    return ("whole, " if schema.get("type") == "integer" else "") + (", ".join(bounds) or "any number")


def meaning(name, schema):
    return schema.get("description") or MEANING.get(name, "")


def row(name, key, schema):
    cells = (f"`{key}`", unit(key), allowed(schema), meaning(name, schema).replace("|", "\\|"))
    return "| " + " | ".join(cells) + " |"


def table(name, properties):
    return ["| key | unit | allowed | meaning |", "|---|---|---|---|",
            *(row(f"{name}.{key}" if name else key, key, schema) for key, schema in properties.items()), ""]


def section(name, schema, head):
    """A table of the file with the tables within it."""
    own = {key: of for key, of in schema["properties"].items() if of.get("type") != "object"}
    within = {key: of for key, of in schema["properties"].items() if of.get("type") == "object"}
    lines = [f"## {head}", ""]
    if name in ABOUT:
        lines += [ABOUT[name], ""]
    if own:
        lines += table(name, own)
    seen = {}
    for key, of in within.items():
        same = next((other for other, known in seen.items() if known == of), None)
        seen[key] = of
        if same:
            lines += [f"### [{name}.{key}]", "", f"The same keys as `[{name}.{same}]`.", ""]
        else:
            lines += [f"### [{name}.{key}]", "", *table(f"{name}.{key}", of["properties"])]
    return lines


def as_text(schema):
    """A key that may be a table, too, as it is at the top of the file."""
    choices = [choice for choice in schema.get("anyOf", []) if choice.get("type") != "object"]
    return {**schema, "anyOf": choices} if choices else schema


def page(text):
    properties = json.loads(text)["properties"]
    lines = ["# Keys of a study file", "",
             "As the program knows them (`dovetail schema study`). A key ends with the unit its value is written in.", ""]
    top = {key: as_text(of) for key, of in properties.items() if of.get("type") not in ("object", "array")}
    lines += ["## At the top of the file", "", *table("", top)]
    for key, of in properties.items():
        tables = [choice for choice in (of, *of.get("anyOf", [])) if choice.get("type") == "object"]
        if tables:
            lines += section(key, tables[0], f"[{key}]")
        elif of.get("type") == "array":
            lines += section(key, of["items"], f"[[{key}]]")
    return "\n".join(lines)
