"""The stub of the Python package's parameters, from the output of `umbrameter parameters --json`."""

TYPES = {"boolean": "bool", "integer": "int", "number": "float", "string": "str", "size": "str | tuple[int, int]",
         "length": "float | str"}


def stub(parameters):
    lines = ['"""Parameters as keyword arguments. Written by scripts/docs --references; do not edit."""',
             "from typing import Literal, TypedDict", "", "", "class Keywords(TypedDict, total=False):",
             '    """The program\'s parameters."""', ""]
    for each in parameters:
        keyword = each["name"].replace(".", "_").replace("-", "_")
        kind = TYPES.get(each["type"])
        if kind is None:
            kind = f"Literal[{', '.join(repr(name) for name in [*each['choices'], *each.get('aliases', {})])}]"
        unit = f" [{each['unit']}]" if each["unit"] not in ("", "1") else ""
        default = f" Default: {each['default']}." if each["default"] != "" else ""
        lines += [f"    {keyword}: {kind}", f'    """{each["meaning"]}{unit}; {each["limits"]}.{default}"""']
    return "\n".join(lines) + "\n"
