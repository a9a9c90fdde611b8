// index.html: one self-contained file that shows the figures and tables of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/table.h"
#include "reports/figures/figures.h"
#include "reports/page/cells.h"

namespace umbrameter {

struct ViewerPack;

/// A number that the reader should see first.
struct Headline {
  std::string label;  ///< "mean absolute error"
  std::string value;  ///< "0.83 %", interval included where the reference is sampled
  std::string note;   ///< "of 402,113 counted pixels"
};

struct ReportTable {
  std::string title;  ///< "Error by object"
  Table table;
  std::vector<std::string> below{};    ///< columns that are shown in smaller type below the one before them
  std::vector<std::string> remarks{};  ///< paragraphs below the table
};

/// A share of a bar that shows how far something is; the kind decides its colour: "done", "running", "failed".
struct BarShare {
  std::string kind;
  double share = 0.0;
};

struct ReportSection {
  std::string title;
  std::string text;  ///< plain paragraphs, separated by blank lines
  std::vector<Headline> headlines;
  std::vector<BarShare> bar{};      ///< above the headlines; the rest of it is empty
  std::vector<FigureHead> figures;  ///< in DIR/figures, shown in this order; a caption includes the conditions
  std::vector<ReportTable> tables;
  std::vector<ChartCells> charts{};  ///< of those figures whose points are cells of a sweep
  bool tables_first = false;         ///< tables stand before figures
};

struct Report {
  std::string title;     ///< "courtyard: bias × resolution"
  std::string subtitle;  ///< view, light, date-free facts
  std::string command;   ///< what repeats this run, or what `command_title` says
  std::string command_title = "Repeat this run";
  std::string warning_title{};          ///< of a box above all else
  std::vector<std::string> warnings{};  ///< what is wrong with the whole page, one line each; none: no box
  std::vector<std::string> answers{};   ///< what the run was made for, one line each: at the top of the page
  std::vector<std::string> notes;       ///< what was assumed
  std::vector<ReportSection> sections;
  Table settings;  ///< every parameter: name, value, default, ...; those whose value is not the default first
  std::optional<ReportCells> cells{};  ///< their table stands before the first section
};

/// The files beside a page that it links to, each where the folder has it.
std::vector<std::string> linked_files(const std::filesystem::path& folder);

/// Writes DIR/index.html with the figures of DIR/figures inlined and its data as JSON. Refers to no other file. The
/// page is complete without its script, which adds the image viewer and the table of all cells, and sorts tables.
void write_page(const std::filesystem::path& folder, const Report& report, const ViewerPack* viewer = nullptr);

/// The same as a file of any name; its figures and the files that it links to are in the same folder.
void write_page_to(const std::filesystem::path& file, const Report& report, const ViewerPack* viewer = nullptr);

}  // namespace umbrameter
