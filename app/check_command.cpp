#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/print_json.h"
#include "present/gate_report.h"
#include "reports/files/output.h"
#include "store/gate.h"
#include "store/run_record.h"

namespace umbrameter {
namespace {

std::vector<MeasuredStatistic> read_runs(const std::vector<std::filesystem::path>& folders) {
  std::vector<MeasuredStatistic> measured;
  for (const std::filesystem::path& folder : folders) {
    for (MeasuredStatistic& each : read_run(folder)) measured.push_back(std::move(each));
  }
  return measured;
}

ExitCode update(const CheckOptions& options, const std::vector<MeasuredStatistic>& measured, const Console& console) {
  std::vector<BudgetEntry> budget;
  std::error_code error;
  const bool is_new = !std::filesystem::exists(options.budget, error);
  if (!is_new) budget = read_budget(options.budget);
  const std::size_t before = budget.size();
  budget = update_budget(std::move(budget), measured);
  const std::size_t added = budget.size() - before;
  write_budget(options.budget, budget);
  for (const std::string& text : gate_notes(budget, measured)) note(console, text);
  // Budgets that no run measured keep their bounds.
  std::size_t kept = 0;
  for (const GateCheck& check : check_budget(budget, measured)) kept += check.measured ? 0u : 1u;
  print_line(console, is_new ? fmt::format("{}: {} bounds written", options.budget.string(), budget.size())
                             : fmt::format("{}: {} of {} bounds updated{}", options.budget.string(), before - kept,
                                           before, added > 0 ? fmt::format(", {} added", added) : std::string()));
  if (kept > 0) {
    note(console, kept == 1 ? "1 bound names nothing in these runs and was left as it is"
                            : fmt::format("{} bounds name nothing in these runs and were left as they are", kept));
  }
  print_json(console, {{"bounds", budget.size()}, {"unchanged", kept}});
  return ExitCode::ok;
}

}  // namespace

ExitCode show_checks(const Console& console, const std::vector<GateCheck>& checks) {
  const std::size_t failed = count_failed(checks);
  for (const std::string& line : gate_lines(checks, false)) print_line(console, line);
  print_line(console, gate_answer(checks));
  std::fflush(stdout);
  return failed == 0 ? ExitCode::ok : ExitCode::check_failed;
}

ExitCode run_check(const CommandLine& line, const Console& console) {
  const CheckOptions& options = line.check;
  if (options.update && (!options.junit.empty() || !options.summary.empty())) {
    throw Error(ExitCode::usage, "--update", "it checks nothing", "leave --junit and --summary out");
  }
  if (options.update) return update(options, read_runs(options.folders), console);
  if (std::error_code unknown; !std::filesystem::exists(options.budget, unknown) && !unknown) {
    throw Error(ExitCode::unreadable_input, "cannot read " + options.budget.string(), "there is no such file",
                "write it with --update");
  }
  const std::vector<BudgetEntry> budget = read_budget(options.budget);
  const std::vector<MeasuredStatistic> measured = read_runs(options.folders);
  const std::vector<GateCheck> checks = check_budget(budget, measured);
  const std::vector<std::string> notes = gate_notes(budget, measured);
  for (const std::string& text : notes) note(console, text);
  const ExitCode code = show_checks(console, checks);
  if (console.verbose) {
    for (const std::string& text : gate_lines(checks, true)) diagnostic(console, text);
  }
  if (!options.junit.empty()) write_text(options.junit, junit_xml(checks));
  if (!options.summary.empty()) {
    // Several steps write to one file.
    write_text(options.summary, text_of_file(options.summary).value_or("") + gate_markdown(checks, notes));
  }
  nlohmann::ordered_json json = to_json(checks);
  json["notes"] = notes;
  print_json(console, json);
  return code;
}

}  // namespace umbrameter
