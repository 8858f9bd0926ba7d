"""The page of all keys of a study file, made from its JSON Schema (`dovetail schema study`)."""

import json

UNITS = {"1": "", "um": "µm", "N/m^3": "N/m³", "kg/m^3": "kg/m³", "m^3/J": "m³/J", "J/m^2": "J/m²"}  # as people write them


def unit(schema):
    return UNITS.get(schema.get("unit", ""), schema.get("unit", ""))


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


def row(key, schema):
    meaning = schema["description"].replace("|", "\\|").replace("*", "\\*")
    return f"| `{key}` | {unit(schema)} | {allowed(schema)} | {meaning} |"


def table(properties):
    return ["| key | unit | allowed | meaning |", "|---|---|---|---|", *(row(key, schema) for key, schema in properties.items()), ""]


def section(name, schema, head, words):
    """A table of the file with the tables within it."""
    own = {key: of for key, of in schema["properties"].items() if of.get("type") != "object"}
    within = {key: of for key, of in schema["properties"].items() if of.get("type") == "object"}
    lines = [f"## {head}", "", words, ""]
    if own:
        lines += table(own)
    seen = {}
    for key, of in within.items():
        same = next((other for other, known in seen.items() if known["properties"] == of["properties"]), None)
        seen[key] = of
        if same:
            lines += [f"### [{name}.{key}]", "", f"The same keys as `[{name}.{same}]`.", ""]
        else:
            lines += [f"### [{name}.{key}]", "", of["description"], "", *table(of["properties"])]
    return lines


def as_text(schema):
    """A key that may be a table, too, as it is at the top of the file."""
    choices = [choice for choice in schema.get("anyOf", []) if choice.get("type") != "object"]
    return {**schema, "anyOf": choices} if choices else schema


def page(text):
    properties = json.loads(text)["properties"]
    lines = ["# Keys of a study file", "",
             "As the program knows them (`dovetail schema study`). A key ends with the unit its value is written in. "
             "[Study files](studies/program/study_files.md) say how they work together.", ""]
    top = {key: as_text(of) for key, of in properties.items() if of.get("type") not in ("object", "array")}
    lines += ["## At the top of the file", "", *table(top)]
    for key, of in properties.items():
        tables = [choice for choice in (of, *of.get("anyOf", [])) if choice.get("type") == "object"]
        if tables:
            lines += section(key, tables[0], f"[{key}]", of["description"])
        elif of.get("type") == "array":
            lines += section(key, of["items"], f"[[{key}]]", of["description"])
    return "\n".join(lines)
