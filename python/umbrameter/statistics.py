"""Units and meanings of the statistics, and the version of `summary.json` that has them.

`statistics.json` is generated from the program's descriptions by `scripts/docs --references`.
"""
from __future__ import annotations

import importlib.resources
import json

_document = json.loads((importlib.resources.files(__package__) / "statistics.json").read_text(encoding="utf-8"))

#: The latest version of `summary.json` that this package reads.
schema_version: int = int(_document["schema_version"])

#: For each kind of measurement (visibility, edges, soft_visibility, ao, image) unit and meaning by name.
statistics: dict[str, dict[str, dict[str, str]]] = _document["kinds"]
