"""The reference page of summary.json, from its schema."""

import json

INTRODUCTION = """# Reference of `summary.json`

Generated from [summary.schema.json](summary.schema.json) by `scripts/docs --references`; do not edit. The schema is
JSON Schema, draft 2020-12, and is installed in `share/umbrameter/`. Validate a file with any validator:

```sh
check-jsonschema --schemafile /usr/local/share/umbrameter/summary.schema.json out/summary.json
```

- Shares and errors of visibility, AO and images are from 0 to 1. `1` in the column "unit" is a plain number.
- A number is `null` if it is undefined, for example an error over no pixels.
- `name_lo` and `name_hi` are the ends of the 95 % interval of `name`, or of its [bounds](glossary.md), as the meaning of `name` says.
- Pixels are counted from the top left.
- `schema_version` is the version of this schema. `check`, `report` and a rerun refuse a file of a later version; they read
  older ones, which have no version.
- *always* means that the key is present in every object of that kind.

`umbrameter compare … --json` prints the same text. The file has no times and no paths, so that equal runs give
equal bytes.
"""


def escape(text):
    return text.replace("|", "\\|")


def target(node):
    return node["$ref"].rsplit("/", 1)[1] if "$ref" in node else None


def variants(node):
    return node.get("oneOf", node.get("anyOf", []))


def type_names(node):
    """As the column "type" shows it, with links to the sections of this page."""
    if target(node):
        return [f"[{target(node)}](#{target(node)})"]
    if "const" in node:
        return [f"`{json.dumps(node['const'], ensure_ascii=False)}`"]
    if "enum" in node:
        return [" or ".join(f"`{each}`" for each in node["enum"])]
    if "items" in node and "type" in node and "array" in node["type"]:
        items = ", ".join(type_names(node["items"]))
        return [f"list of {items}"] + (["null"] if "null" in node["type"] else [])
    kind = node.get("type", [])
    if kind == "object" or not kind:
        alternatives = [name for each in variants(node) for name in type_names(each)]
        return alternatives or ["object"]
    return kind if isinstance(kind, list) else [kind]


def rows_of(node, prefix):
    """Rows of the keys of an object; the keys of objects without a section of their own follow."""
    required = node.get("required", [])
    for key, child in node.get("properties", {}).items():
        path = f"{prefix}.{key}" if prefix else key
        presence = "always" if key in required else ""
        yield (f"| `{path}` | {', '.join(type_names(child))} | {child.get('unit', '')} | {presence} | "
               f"{escape(child.get('description', ''))} |")
        inner = child
        if child.get("type") == "array" and isinstance(child.get("items"), dict):
            inner, path = child["items"], path + "[]"
        if not target(inner) and "properties" in inner:
            yield from rows_of(inner, path)
        elif isinstance(child.get("additionalProperties"), dict) and "properties" in child["additionalProperties"]:
            yield from rows_of(child["additionalProperties"], path + ".PARAMETER")


def table(node):
    return ["| key | type | unit | present | meaning |", "| --- | --- | --- | --- | --- |", *rows_of(node, "")]


def object_of(node):
    """The object among the variants of a nullable one."""
    return next((each for each in [node, *variants(node)] if "properties" in each), None)


# Long lists that other pages have.
ELSEWHERE = {
    "parameters": "One key for each parameter: [Parameters](parameters.md). A length is a number of metres, or text with its unit.",
    "parameter_name": "The full name of a parameter: [Parameters](parameters.md).",
    "axis_values": "A key for each varied parameter, with its value: [Parameters](parameters.md).",
    "axis_texts": "A key for each varied parameter, with its axis as given, such as `0.01:0.2:33:log`.",
    "sweep_row": "A key for each varied parameter, then the statistics of the measured quantity: one of "
                 "[statistics_visibility](#statistics_visibility), [statistics_edges](#statistics_edges), "
                 "[statistics_soft_visibility](#statistics_soft_visibility), [statistics_ao](#statistics_ao) or "
                 "[statistics_image](#statistics_image).",
    "tune_statistics": "A key for each statistic or metric that the cost and the constraints name, and `pass_time`, the "
                       "time of the technique's pass in ms.",
}


def schema_page(schema):
    lines = [INTRODUCTION, "## The file", "", *table(schema), ""]
    for name, node in schema["$defs"].items():
        lines += [f"## {name}", ""]
        if name in ELSEWHERE:
            lines += [ELSEWHERE[name], ""]
            continue
        description = node.get("description", "")
        lines += [description[:1].upper() + description[1:] + ".", ""]
        with_keys = object_of(node)
        if with_keys:
            lines += [*table(with_keys), ""]
    return "\n".join(lines).rstrip() + "\n"
