"""Runs a notebook of python/examples and writes its page: text, code, and what each cell shows, figures as PNG.

usage: notebook_page.py FOLDER    writes NAME.md and NAME-N.png of each notebook into docs/notebooks or another folder
"""
import ast
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

examples = pathlib.Path(__file__).resolve().parents[2] / "python" / "examples"


def write_page(notebook, folder):
    """The results of the notebook's runs lie in a temporary folder. Returns the figures."""
    images, parts = [], []
    variables = {"__name__": notebook.stem}
    with tempfile.TemporaryDirectory() as results, contextlib.chdir(results):
        for number, cell in enumerate(json.loads(notebook.read_text())["cells"]):
            source = "".join(cell["source"])
            if cell["cell_type"] == "markdown":
                parts.append(source)
                continue
            parts.append(f"```python\n{source}\n```")
            shown = run_cell(source, f"{notebook.name}, cell {number}", variables)
            if shown:
                parts.append(f"```text\n{shown}\n```")
            for figure in plt.get_fignums():
                images.append(folder / f"{notebook.stem}-{len(images) + 1}.png")
                plt.figure(figure).savefig(images[-1], dpi=150)
                plt.close(figure)
                parts.append(f"![Figure {len(images)}]({images[-1].name})")
    origin = f"This page is `python/examples/{notebook.name}` with what its cells show; `scripts/docs --notebooks` writes it."
    (folder / f"{notebook.stem}.md").write_text("\n\n".join([*parts, origin]) + "\n", encoding="utf-8")
    return images


def run_cell(source, name, variables):
    """What a notebook shows as text: what is printed, then the value of the last expression."""
    body = ast.parse(source, name).body
    last = ast.Expression(body.pop().value) if isinstance(body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(ast.Module(body, []), name, "exec"), variables)
        value = eval(compile(last, name, "eval"), variables) if last else None
    shown = "" if value is None or isinstance(value, matplotlib.axes.Axes) else repr(value)
    return "\n".join(map(wrapped, (printed.getvalue() + shown).rstrip().split("\n")))


def wrapped(line):
    """As long as the page shows it without scrolling."""
    if len(line) <= 96:
        return line
    bound = line.replace(" %", "\N{NO-BREAK SPACE}%")
    filled = textwrap.fill(bound, 96, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    return filled.replace("\N{NO-BREAK SPACE}", " ")


if __name__ == "__main__":
    sys.path.insert(0, str(examples.parent))
    target = pathlib.Path(os.path.abspath(sys.argv[1]))
    target.mkdir(exist_ok=True)
    for each in sorted(examples.glob("*.ipynb")):
        write_page(each, target)
