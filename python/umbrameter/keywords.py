"""The parameters as a TypedDict; its fields, for editors and type checkers, are in the generated `keywords.pyi`."""
from typing import Any

Keywords = dict[str, Any]
