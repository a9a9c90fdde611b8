"""The reference page of all statistics and image metrics, from the program's descriptions."""

INTRODUCTION = """# Statistics

Generated from the program's descriptions by `scripts/docs --references`; do not edit. These names are the columns of
`sweep.csv` and `results.sqlite`, the keys of [`summary.json`](summary.md), and the names that `check`, `--fail-if` and
`tune` take. A statistic with an interval has two more columns, `name_lo` and `name_hi`: the ends of its 95 % interval or, where
its meaning says so, [bounds](reference.md#bounds-of-absolute-errors). They cover the noise of the reference's rays for these
pixels; the intervals of [`report`](figures.md#several-runs-side-by-side) also say how much a value depends on which parts of the scene an image shows.
Shares and errors have the unit 1: 0.01 is 1 %.
"""

SECTIONS = {
    "visibility": "`shadows[].statistics` if the light has no extent and the technique is a sum of depth comparisons.",
    "edges": "`shadows[].statistics` if the light has no extent and the technique has no taps (filtered maps, screen space). "
             "The distance is that to the [shadow edges](shadow-error.md#distance-to-the-shadow-edges): [Techniques without taps](shadow-error.md#techniques-without-taps).",
    "soft_visibility": "`shadows[].statistics` if the light has an area or `truth.shadow` is `pixel`.",
    "ao": "`ao.statistics`.",
    "ao_stages": "`ao.stages.statistics` and `ao_stages.csv`, with `--run.ao-stages true`: [AO by stage](ambient-occlusion/stages.md).",
    "image": "`image.statistics`, with `--measure image`: [The shaded image](shading.md).",
    "view": "`shadows[].shape.views`, of cascades and point lights.",
    "seams": "`shadows[].shape.seams`, of cascades and point lights.",
    "fit_shimmer": "`shadows[].shape.fit_shimmer`, with `--shimmer`.",
}


def escape(text):
    return text.replace("|", "\\|")


def statistics_page(quantities):
    lines = [INTRODUCTION]
    for group in quantities["statistics"]:
        lines += [f"## {group['title']}", "", SECTIONS[group["name"]], "",
                  "| name | unit | interval | meaning |", "| --- | --- | --- | --- |"]
        for each in group["statistics"]:
            interval = "yes" if each["interval"] else ""
            lines.append(f"| `{each['name']}` | {each['unit']} | {interval} | {escape(each['meaning'])} |")
        lines.append("")
    lines += ["## Image metrics", "",
              "`shadows[].metrics`, `ao.metrics` and `image.metrics`, and columns of a sweep, if `--run.metrics` names them. Formulas and papers: "
              "[Image metrics](metrics.md).", "", "| name | unit | meaning |", "| --- | --- | --- |"]
    for each in quantities["metrics"]:
        lines.append(f"| `{each['name']}` | {each['unit']} | {escape(each['meaning'])} |")
    return "\n".join(lines) + "\n"
