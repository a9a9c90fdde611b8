#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "app/commands.h"
#include "app/planned_folder.h"
#include "app/print_json.h"
#include "core/lists.h"
#include "core/parallel.h"
#include "core/standard_streams.h"
#include "present/plateau_text.h"
#include "present/presentation_parts.h"
#include "present/run_output.h"
#include "present/runs_report.h"
#include "reports/files/data.h"
#include "reports/files/latex.h"
#include "reports/files/output.h"
#include "store/finished_sweep.h"
#include "store/run_folder.h"
#include "store/run_value.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

std::vector<StoredRun> read_runs(const CommandLine& line) {
  std::vector<StoredRun> runs =
      mapped(line.report.folders, [](const fs::path& folder) { return read_stored_run(folder); });
  // Runs whose folders have the same name are called by their paths.
  std::map<std::string, int> uses;
  for (const StoredRun& run : runs) ++uses[run.name];
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (uses[runs[i].name] > 1) runs[i].name = line.report.folders[i].string();
  }
  return runs;
}

// Figures that show the same of several runs stand side by side, in the order in which the first of them comes.
void sort_by_content(std::vector<Figure>& figures) {
  const auto content_of = [](const Figure& figure) {
    const std::string& stem = head_of(figure).stem;
    return std::pair(figure.index(), stem.substr(0, stem.rfind('_')));
  };
  std::vector<Figure> sorted;
  for (const Figure& first : figures) {
    const auto is_same = [&](const Figure& figure) { return content_of(figure) == content_of(first); };
    if (std::ranges::any_of(sorted, is_same)) continue;
    std::copy_if(figures.begin(), figures.end(), std::back_inserter(sorted), is_same);
  }
  figures = std::move(sorted);
}

// Images of the lights in the order of the sections about them, then all others.
void sort_by_light(std::vector<Figure>& figures, const StoredRun& run) {
  std::vector<std::string> lights;
  for (const MeasuredStatistic& each : run.statistics) {
    const auto layer = run.layers.find(each.light);
    if (layer != run.layers.end() && std::ranges::find(lights, layer->second) == lights.end()) {
      lights.push_back(layer->second);
    }
  }
  // A layer's name can end as a shorter one does: "lamp_1" and "1".
  const auto place = [&](const Figure& figure) {
    if (!std::holds_alternative<ImageFigure>(figure)) return lights.size();
    const std::string& stem = head_of(figure).stem;
    const std::string content = stem.substr(0, stem.rfind('_'));
    std::size_t best = lights.size();
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const bool is_longer = best == lights.size() || lights[i].size() > lights[best].size();
      if (is_longer && content.ends_with("_" + lights[i])) best = i;
    }
    return best;
  };
  std::ranges::stable_sort(figures, {}, place);
}

// By kind: images, plots, heat maps, waterfalls.
std::vector<Figure> figures_of(const std::vector<StoredRun>& runs, const std::vector<fs::path>& folders,
                               ErrorImages& errors) {
  std::vector<Figure> all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::vector<Figure> figures = stored_figures(folders[i], runs[i]);
    const std::string suffix = runs.size() > 1 ? fmt::format("_{}", i + 1) : "";
    for (auto& [stem, error] : error_images_of(figures, runs[i].images)) {
      errors.emplace(stem + suffix, std::move(error));
    }
    for (Figure& figure : figures) {
      head_of(figure).stem += suffix;
      if (runs.size() > 1) head_of(figure).title += ", " + runs[i].name;
      all.push_back(std::move(figure));
    }
  }
  if (runs.size() > 1) {
    sort_by_content(all);
    sort_by_light(all, runs.front());
  }
  std::ranges::stable_sort(all, {}, [](const Figure& figure) { return figure.index(); });
  return all;
}

std::vector<ReportSection> figure_sections(const std::vector<Figure>& figures) {
  ReportSection plots, images;
  plots.title = "Plots";
  images.title = "Images";
  for (const Figure& figure : figures) {
    (std::holds_alternative<ImageFigure>(figure) ? images : plots).figures.push_back(head_of(figure));
  }
  std::vector<ReportSection> sections = {std::move(plots), std::move(images)};
  std::erase_if(sections, [](const ReportSection& section) { return section.figures.empty(); });
  return sections;
}

// Whether a cell of a table has a text that passes the test; the first column has names.
template <class Test>
bool has_cell(const Table& table, const Test& test) {
  return std::ranges::any_of(table.rows, [&](const std::vector<Value>& row) {
    return std::any_of(row.begin() + 1, row.end(), [&](const Value& cell) { return test(to_string(cell)); });
  });
}

bool is_range(const std::string& text) { return text.find(" to ") != std::string::npos; }
bool is_interval(const std::string& text) { return text.find("±") != std::string::npos || is_range(text); }
bool is_difference(const std::string& text) { return text != "0" && text != "—"; }

bool has_differences(const PartTables& part) { return has_cell(part.printed_differences, is_difference); }

std::vector<std::string> planned_files(const CommandLine& line, std::vector<std::string> files,
                                       const std::vector<PartTables>& parts) {
  files.insert(files.end(), {"index.html", "comparison.csv"});
  if (!line.report.latex) return files;
  for (const PartTables& part : parts) {
    files.push_back("figures/" + part.stem + ".tex");
    if (has_differences(part)) files.push_back("figures/" + part.stem + "_difference.tex");
  }
  return files;
}

// What the signs in a table's cells mean.
std::string note_of(const Table& table, const std::string& of_star) {
  std::string note;
  if (has_cell(table, is_interval)) note = has_cell(table, is_range) ? range_note : interval_note;
  if (has_cell(table, [](const std::string& text) { return text.ends_with('*'); })) {
    note += (note.empty() ? "" : "; ") + of_star;
  }
  return note;
}

void write_latex(const fs::path& folder, const std::vector<PartTables>& parts) {
  fs::create_directories(folder / "figures");
  for (const PartTables& part : parts) {
    write_text(folder / "figures" / (part.stem + ".tex"),
               to_latex(part.printed_values, note_of(part.printed_values, rays_only_note)));
    if (!has_differences(part)) continue;
    write_text(folder / "figures" / (part.stem + "_difference.tex"),
               to_latex(part.printed_differences, note_of(part.printed_differences, significance_note)));
  }
}

// "hard, box: 1280×720 pixels, camera overview, 95,204 triangles"; without the view where the runs differ in it.
std::string subtitle_of(const std::vector<StoredRun>& runs, const std::vector<fs::path>& folders) {
  const std::vector<std::string> views = mapped(folders, stored_view);
  const bool is_shared = std::ranges::all_of(views, [&](const std::string& view) { return view == views.front(); });
  return joined(runs, ", ", &StoredRun::name) + (is_shared && !views.front().empty() ? ": " + views.front() : "");
}

// Whether an equal bias in texels is another length in another run.
bool is_bias_another_length(const std::vector<StoredRun>& runs) {
  const auto has_texels = [](const StoredRun& run) {
    const auto found =
        std::ranges::find(run.parameters, "shadow.constant-bias", &std::pair<std::string, std::string>::first);
    return found != run.parameters.end() && found->second.ends_with("texels");
  };
  std::map<std::string, double> sizes;  // by light
  const auto has_others = [&](const StoredRun& run) {
    return std::ranges::any_of(run.statistics, [&](const MeasuredStatistic& each) {
      // Another camera sums up equal texels with another rounding.
      constexpr double rounding = 1e-9;
      if (each.name != "mean_texel") return false;
      const double first = sizes.emplace(each.light, each.value).first->second;
      return std::abs(each.value - first) > rounding * first;
    });
  };
  return std::ranges::all_of(runs, has_texels) && std::ranges::any_of(runs, has_others);
}

Report make_report(const fs::path& page, const std::vector<StoredRun>& runs, const std::vector<fs::path>& folders,
                   const std::vector<PartTables>& parts, const std::vector<ReportSection>& figures) {
  Report report;
  report.title = fmt::format("{}: {}", runs.front().scene, runs.size() > 1 ? "runs side by side" : "a run");
  report.subtitle = subtitle_of(runs, folders);
  report.command = "umbrameter report";
  for (const fs::path& folder : folders) report.command += " " + shell_word(fs::proximate(folder, page).string());
  report.command += " -o OUT";
  if (runs.size() > 1) {
    ReportSection section;
    section.title = "Parameters that differ";
    const Table table = differing_parameters(runs);
    section.text =
        table.rows.empty()
            ? "All parameters of what is compared are equal; the page of each run lists them under 'Settings'."
            : "All others are equal; the page of each run lists them under 'Settings'.";
    if (is_bias_another_length(runs)) {
      section.text +=
          " Texel sizes differ between the runs, so that the same bias in texels can be a different length.";
    }
    if (!table.rows.empty()) section.tables.push_back({"Parameters that differ", table});
    report.sections.push_back(std::move(section));
  }
  for (const PartTables& part : parts) {
    ReportSection section;
    section.title = part.title;
    const bool has_intervals = has_cell(part.values, is_interval);
    section.tables.push_back({has_intervals ? "Errors, with 95 % intervals" : "Errors", part.values});
    section.text =
        has_intervals
            ? std::string("95 % intervals say how much a value depends on which parts of the scene the image shows") +
                  (part.is_sampled ? " and on the rays of the reference" : "") +
                  ": one block of pixels at a time is left out (jackknife)."
            : "These errors have no 95 % intervals" +
                  (part.few_blocks > 0 ? ": " + few_blocks_text(part.few_blocks) : std::string()) + ".";
    if (part.has_noise) {
      section.text +=
          " Noise of the rays raises absolute errors, so that the true one may be lower than the value shown. The ± of "
          "an absolute error, and of a difference of two, includes what noise may have added.";
    }
    if (has_cell(part.all, [](const std::string& text) { return text.ends_with('*'); })) {
      section.text +=
          " An interval marked * covers the noise of the reference only: counted pixels lie in too few blocks of the "
          "image, or the images of the run do not give this statistic.";
    }
    if (has_cell(part.values, [](const std::string& text) { return text == "—"; })) {
      section.text += " A dash stands where a run has no such statistic; filtered shadow maps, for one, have no acne.";
    }
    if (has_cell(part.differences, is_difference)) {
      section.text += fmt::format(" Differences are to the run '{}'.", runs.front().name);
      if (has_cell(part.differences, [](const std::string& text) { return text.starts_with('('); })) {
        section.text +=
            has_intervals
                ? " Those in parentheses are not significant, or cannot be tested because they have no such interval."
                : " Those in parentheses cannot be tested; the last column of 'All statistics' says why.";
      }
      section.tables.push_back({fmt::format("Difference to the run '{}'", runs.front().name), part.differences});
    } else if (runs.size() > 1) {
      const std::size_t run = column_index(part.all, "run");
      std::set<std::string> measured;
      for (const std::vector<Value>& row : part.all.rows) measured.insert(to_string(row[run]));
      section.text += measured.size() == 1             ? " One run alone measured this."
                      : measured.size() == runs.size() ? " All runs have the same errors."
                                                       : " All runs that measured this have the same errors.";
    }
    section.tables.push_back({"All statistics", part.all});
    report.sections.push_back(std::move(section));
  }
  report.sections.insert(report.sections.end(), figures.begin(), figures.end());
  return report;
}

void check_insets_of(FigureStyle& style, const std::vector<Figure>& figures) {
  const auto holds_image = [](const Figure& figure) { return std::holds_alternative<ImageFigure>(figure); };
  const auto image = std::ranges::find_if(figures, holds_image);
  if (image == figures.end()) return;
  style.view = image_size(std::get<ImageFigure>(*image));
  check_insets(style, style.view.x, style.view.y);
}

// The runs side by side, and the tables of both kinds of report.
struct Comparison {
  std::vector<StoredRun> runs;
  std::vector<ComparedStatistic> statistics;
  std::vector<PartTables> parts;
};

Comparison compare(const CommandLine& line) {
  Comparison comparison{read_runs(line), {}, {}};
  comparison.statistics = compare_runs(comparison.runs);
  comparison.parts = part_tables(comparison.runs, comparison.statistics);
  return comparison;
}

RunFolder open_folder(const CommandLine& line, const std::vector<std::string>& figures, const Comparison& comparison) {
  std::string plan = "report";
  for (const fs::path& folder : line.report.folders) plan += " " + folder.string();
  return {line.output, RunPlan{line.command, plan, planned_files(line, figures, comparison.parts)}, line.force};
}

// Writes comparison.csv and, with --latex, the tables.
void write_tables(const CommandLine& line, const Console& console, const RunFolder& folder,
                  const Comparison& comparison) {
  const Table rows = comparison_rows(comparison.runs, comparison.statistics);
  write_text(folder.path() / "comparison.csv", to_csv(rows));
  if (line.report.latex) write_latex(folder.path(), comparison.parts);
  print_json(console, rows_json(rows));
}

// The page and the figures of one run again, as the run itself made them, with copies of the files to which it links.
ExitCode show_again(const CommandLine& line, const Console& console, const RunResults& results) {
  PageOptions options{make_figure_style(line.figures), !line.no_figures};
  std::optional<FinishedSweep> sweep;
  std::optional<SweepResults> rows;
  if (results.sweep) {
    sweep.emplace(line.report.folders.front());
    rows.emplace(sweep->rows(results.sweep->ao_limit));
  }
  const SweepResults* const rows_or_none = rows ? &*rows : nullptr;
  RunPage page = present_run(results, rows_or_none, options);
  for (const Presentation& part : page.parts) check_insets_of(options.style, part.figures);
  const bool has_statistics = !results.tune;
  const Comparison comparison = has_statistics ? compare(line) : Comparison{};
  const fs::path& from = line.report.folders.front();
  const std::vector<std::string> linked = linked_files(from);
  std::vector<std::string> files = figure_files(page);
  files.insert(files.end(), linked.begin(), linked.end());
  RunFolder folder = open_folder(line, files, comparison);
  folder.begin();
  for (const std::string& name : linked) copy_whole(from / name, folder.path() / name);
  for (const Presentation& part : page.parts) {
    for (const std::string& text : part.answers) print_line(console, text);
  }
  std::fflush(stdout);
  const std::vector<std::string> problems = draw_figures(folder.path(), console, results, page, options);
  write_run_page(folder.path(), results, rows_or_none, page, problems, options);
  if (has_statistics) write_tables(line, console, folder, comparison);
  return finish_run(folder, console, problems);
}

ExitCode show_side_by_side(const CommandLine& line, const Console& console) {
  FigureStyle style = make_figure_style(line.figures);
  const Comparison comparison = compare(line);
  const std::vector<StoredRun>& runs = comparison.runs;
  const std::vector<std::string> limits = limits_of_comparison(runs);
  ErrorImages errors;
  std::vector<Figure> figures;
  if (!line.no_figures) figures = figures_of(runs, line.report.folders, errors);
  check_insets_of(style, figures);
  complete_error_images(figures, errors, style);
  const std::vector<ReportSection> sections = figure_sections(figures);
  const std::vector<std::string> answers = comparison_answers(runs, comparison.statistics);

  RunFolder folder = open_folder(line, figure_files(sections), comparison);
  folder.begin();
  for (const std::string& text : answers) print_line(console, text);
  for (const std::string& text : limits) note(console, text);
  std::fflush(stdout);
  const std::vector<std::string> problems = write_figures(folder.path() / "figures", figures, style, errors);
  Report report = make_report(folder.path(), runs, line.report.folders, comparison.parts, sections);
  report.answers = answers;
  report.notes = limits;
  for (std::size_t i = 0; i < runs.size() && !line.no_figures; ++i) {
    if (runs[i].command != "sweep" || has_stored_cells(line.report.folders[i], runs[i])) continue;
    report.notes.push_back(fmt::format("{} has no plots: its results.sqlite is missing.", runs[i].name));
  }
  write_tables(line, console, folder, comparison);
  write_page(folder.path(), report);
  return finish_run(folder, console, problems);
}

}  // namespace

ExitCode run_report(const CommandLine& line, const Console& console) {
  const ThreadLimit threads(line.threads);
  for (const fs::path& folder : line.report.folders) {
    std::error_code error;
    if (!fs::equivalent(folder, line.output, error)) continue;
    throw Error(ExitCode::usage, line.output.string(), "it holds a run that the report reads",
                "write the report to another folder");
  }
  for (auto folder = line.report.folders.begin(); folder != line.report.folders.end(); ++folder) {
    const bool is_repeated = std::any_of(line.report.folders.begin(), folder, [&](const fs::path& earlier) {
      std::error_code error;
      return fs::equivalent(earlier, *folder, error);
    });
    if (!is_repeated) continue;
    throw Error(ExitCode::usage, folder->string(), "this run is given twice", "name each run once");
  }
  std::optional<RunResults> results;
  if (line.report.folders.size() == 1) results = read_run_value(line.report.folders.front());
  return results ? show_again(line, console, *results) : show_side_by_side(line, console);
}

}  // namespace umbrameter
