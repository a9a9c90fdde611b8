"""Writes the generated parts of docs/ - definitions in summary.schema.json, summary.md, statistics.md, parameters.md - and
what the Python package knows of the program: parameters, their keywords, and the quantities of statistics.

usage: references.py QUANTITIES PROGRAM DOCS [--check]

QUANTITIES is the program umbrameter_quantities, PROGRAM is umbrameter. With --check nothing is written, and the exit
code is 1 if a file is out of date.
"""

import json
import pathlib
import subprocess
import sys

from python_stub import stub
from schema_page import schema_page
from statistics_page import statistics_page


def number(quantity, kind):
    return {"description": quantity["meaning"], "unit": quantity["unit"] or "1", "type": kind}


def statistics_definition(group):
    """All columns are always present. Over no pixels a statistic is undefined, which JSON writes as null."""
    properties = {}
    for each in group["statistics"]:
        properties[each["name"]] = number(each, "integer" if each["integer"] else ["number", "null"])
        if each["interval"]:
            for end, text in (("lo", "lower"), ("hi", "upper")):
                limit = {**each, "meaning": f"{text} end of the interval of `{each['name']}`"}
                properties[f"{each['name']}_{end}"] = number(limit, ["number", "null"])
    return {"description": group["title"], "type": "object", "properties": properties, "required": list(properties)}


def closed(definition):
    return {**definition, "additionalProperties": False}


def parameter_definition(parameter):
    kind = {"length": ["number", "string"], "size": "string", "choice": "string"}.get(parameter["type"], parameter["type"])
    definition = {"description": f"{parameter['meaning']} ({parameter['limits']})", "type": kind}
    if parameter["unit"]:
        definition["unit"] = parameter["unit"]
    elif kind in ("number", "integer"):
        definition["unit"] = "1"
    return definition


ENGINE = "^engine[.]"  # parameters that an engine describes


def generated_definitions(quantities):
    groups = {group["name"]: group for group in quantities["statistics"]}
    parameters = {each["name"]: parameter_definition(each) for each in quantities["parameters"]}
    definitions = {}
    for name, group in groups.items():
        definition = statistics_definition(group)
        # The others are closed where they are used, beside keys that the program adds.
        definitions[f"statistics_{name}"] = closed(definition) if name in ("view", "seams", "fit_shimmer") else definition
    metrics = {each["name"]: number(each, ["number", "null"]) for each in quantities["metrics"]}
    cell_groups = ["visibility", "edges", "soft_visibility", "ao", "image"]
    of_any_cell = {}
    for name in cell_groups:
        of_any_cell.update(definitions[f"statistics_{name}"]["properties"])
    of_statistics = set(of_any_cell)
    of_any_cell.update(metrics)
    definitions["metrics"] = closed(
        {"description": "image metrics by name, null where one is undefined", "type": "object", "properties": metrics})
    value = {"description": "value of the parameter, in the unit of its axis", "type": ["number", "string", "boolean"]}
    definitions["parameters"] = closed(
        {"description": "every parameter; a length is a number of metres or a text with its unit; `engine.*` as the engine describes it",
         "type": "object", "properties": parameters, "patternProperties": {ENGINE: value}, "required": list(parameters)})
    definitions["parameter_name"] = {"description": "full name of a parameter",
                                     "anyOf": [{"enum": list(parameters)}, {"pattern": ENGINE}]}
    text = {"description": "the axis as given", "type": "string"}
    name = {"$ref": "#/$defs/parameter_name"}
    definitions["axis_values"] = {"description": "values of varied parameters, in the units of their axes",
                                  "type": "object", "propertyNames": name, "additionalProperties": value}
    definitions["axis_texts"] = {"description": "axes as given, such as `0.01:0.2:33:log`",
                                 "type": "object", "propertyNames": name, "additionalProperties": text}
    # Names of parameters have a dot, names of statistics have none.
    definitions["sweep_row"] = {
        "description": "values of the axes, then the statistics of one kind", "type": "object",
        "propertyNames": {"anyOf": [name, {"pattern": "^[^.]+$"}]}, "patternProperties": {"[.]": value},
        "properties": {each: one for each, one in metrics.items() if each not in of_statistics},
        "anyOf": [{"$ref": f"#/$defs/statistics_{each}"} for each in cell_groups], "unevaluatedProperties": False}
    definitions["tune_statistics"] = {
        "description": "the statistics that cost and constraints name; `pass_time` is the time of the technique's pass, with read-back",
        "type": "object",
        "properties": {**of_any_cell, "pass_time": {"description": "time of the technique's pass, with read-back", "unit": "ms",
                                                  "type": ["number", "null"]}}}
    return definitions


def updated_schema(text, quantities):
    schema = json.loads(text)
    generated = generated_definitions(quantities)
    kept = {name: each for name, each in schema["$defs"].items()
            if name not in generated and not name.startswith("statistics_")}
    schema["$defs"] = {**kept, **generated}
    schema["properties"]["schema_version"]["const"] = quantities["schema_version"]
    return json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


def statistics_list(quantities):
    """Unit and meaning of each statistic of each kind, with the ends of its interval."""
    kinds = {group["name"]: {name: {"unit": each["unit"], "meaning": each["description"]}
                             for name, each in statistics_definition(group)["properties"].items()}
             for group in quantities["statistics"]}
    document = {"schema_version": quantities["schema_version"], "kinds": kinds}
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main(arguments):
    quantities_program, program, docs = arguments[:3]
    docs = pathlib.Path(docs)
    parameters = output_of(program, "parameters", "--json")
    quantities = {**json.loads(output_of(quantities_program)), **json.loads(parameters)}
    schema = updated_schema((docs / "summary.schema.json").read_text(), quantities)
    pages = {
        "summary.schema.json": schema,
        "summary.md": schema_page(json.loads(schema)),
        "statistics.md": statistics_page(quantities),
        "parameters.md": output_of(program, "parameters", "--markdown"),
        "../python/umbrameter/parameters.json": parameters,
        "../python/umbrameter/keywords.pyi": stub(quantities["parameters"]),
        "../python/umbrameter/statistics.json": statistics_list(quantities),
    }
    stale = [name for name, text in pages.items()
             if not (docs / name).exists() or (docs / name).read_text() != text]
    if "--check" in arguments:
        for name in stale:
            print(f"docs/{name} is out of date: run scripts/docs --references")
        return 1 if stale else 0
    for name in stale:
        (docs / name).write_text(pages[name])
        print(f"docs/{name}: updated")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
