#include "app/command_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

template <class Number>
CLI::Validator number_check(Number min, Number max, const char* kind) {
  return CLI::Validator(
      [=](const std::string& text) {
        Number number{};
        const bool is_number = CLI::detail::lexical_cast(text, number);
        if (is_number && number >= min && number <= max) return std::string();
        return fmt::format("'{}' is not allowed; expected {} from {} to {}", shortened(text, 40), kind, min, max);
      },
      "");
}

}  // namespace

CLI::Validator number_between(int min, int max) { return number_check(min, max, "an integer"); }
CLI::Validator number_between(double min, double max) { return number_check(min, max, "a number"); }

void add_diff_options(CLI::App& command, CommandLine& line) {
  DiffOptions& diff = line.diff;
  command.add_option("TEST", diff.test, "image to judge: EXR, PNG, Radiance HDR or PFM")->required();
  command.add_option("REFERENCE", diff.reference, "image to compare with, of the same size")->required();
  const auto text = [&](const char* names, auto& value, const char* placeholder, const char* meaning) {
    return command.add_option(names, value, meaning)->type_name(placeholder);
  };
  text("-o,--output", line.output, "FILE", "write an error map, .png, with a fixed colour scale");
  text("--metrics", diff.metrics, "LIST", "metrics to measure, comma-separated; all by default");
  text("--map", diff.map, "NAME", "metric of the error map (hdr-flip for linear files, else ldr-flip)");
  text("--layer", diff.layer, "NAME", "layer of EXR files: truth_ao, truth_ao.Y");
  text("--reference-layer", diff.reference_layer, "NAME", "layer of the reference, if it has another name");
  text("--mask", diff.mask, "FILE", "count only the pixels where this image is not black");
  text("--crop", diff.crop, "X,Y,W,H", "compare only this rectangle [px]");
  text("--pixels-per-degree", diff.pixels_per_degree, "X", "resolution seen by the viewer, for FLIP (67.02)")
      ->check(number_between(1.0, 1000.0));
  text("--exposure", diff.exposure, "EV", "exposure of linear files for metrics of displayed images [EV] (0)")
      ->check(number_between(-100.0, 100.0));
  text("--exposures", diff.exposures, "RANGE", "exposures of HDR-FLIP [EV], START:STOP[:COUNT]; automatic by default");
  command.add_flag("--data", diff.data, "the values are data from 0 to 1 (visibility, AO), compared as they are");
  command.add_flag("--exit-code", diff.exit_code, "exit with 1 if a counted pixel differs");
}

void add_figure_options(CLI::App& command, FigureOptions& figures) {
  const auto add = [&](const char* name, auto& value, const char* placeholder, const char* meaning) {
    return command.add_option(name, value, meaning)->type_name(placeholder)->group(figure_group);
  };
  add("--figure-style", figures.style, "STYLE", "figures for print: column (84 mm), page (176 mm) or slide (300 mm)");
  add("--figure-size", figures.size, "W[xH]", "width of figures in print, and height of plots [mm]");
  add("--figure-font", figures.font, "NAME", "font family of figures (DejaVu Sans)");
  add("--figure-font-size", figures.font_size, "PT", "size of labels in print [pt] (8; slide 20)")
      ->check(number_between(4.0, 72.0));
  command.add_flag("--figure-title", figures.title, "draw titles into the figures")->group(figure_group);
  add("--inset", figures.insets, "REGION", "draw X,Y,W,H [px] or the region of most error, worst, enlarged; repeatable")
      ->take_all();
}

void add_tune_options(CLI::App& command, CommandLine& line) {
  TuneOptions& tune = line.tune;
  command.add_option("--vary", line.vary, "parameter to tune: first:last[:log], or an axis of sweep; repeatable")
      ->type_name("PARAM=AXIS")
      ->take_all();
  command.add_option("--minimize", tune.minimize, "cost: a statistic, or a sum like 'acne + 0.5*rmse' (mae)")
      ->type_name("COST");
  command.add_option("--constraint", tune.constraints, "condition that every case must keep: 'acne<0.1%'; repeatable")
      ->type_name("CONDITION")
      ->take_all();
  command.add_option("--over", tune.over, "measure all these values: view.camera=all, light.angle=0,0.5; repeatable")
      ->type_name("PARAM=LIST")
      ->take_all();
  command.add_flag("--worst-case", tune.worst_case, "minimize the largest cost of all cases, not their mean");
  command.add_flag("--relative", tune.relative, "minimize each case's cost in multiples of its cost at the default");
  command.add_option("--held-out", tune.held_out, "check the result on view.camera=LIST or scene=NAME; repeatable")
      ->type_name("PARAM=LIST")
      ->take_all();
  command.add_option("--evaluations", tune.evaluations, "max evaluations of all cases (30 for each searched axis)")
      ->check(number_between(1, 1000000))
      ->type_name("N");
  command.add_option("--minutes", tune.minutes, "end the search after this time")
      ->check(number_between(0.001, 1e6))
      ->type_name("X");
}

}  // namespace umbrameter
