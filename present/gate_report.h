// The result of a gate as text: a table for the console, JUnit XML and Markdown for continuous integration.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "store/gate.h"

namespace umbrameter {

std::size_t count_failed(const std::vector<GateCheck>& checks);

/// "2 of 14 bounds are exceeded" or "all 14 bounds are kept".
std::string gate_answer(const std::vector<GateCheck>& checks);

/// Aligned lines: of what fails, or of everything. Empty if there is nothing to list.
std::vector<std::string> gate_lines(const std::vector<GateCheck>& checks, bool all);

/// One test case for each check, in the form that GitLab, Jenkins and GitHub's actions read.
std::string junit_xml(const std::vector<GateCheck>& checks);

/// What the bounds do not cover: runs of which none names a statistic, and the other views of a sweep.
std::vector<std::string> gate_notes(const std::vector<BudgetEntry>& budget,
                                    const std::vector<MeasuredStatistic>& measured);

/// The answer, a table and the notes, for $GITHUB_STEP_SUMMARY.
std::string gate_markdown(const std::vector<GateCheck>& checks, const std::vector<std::string>& notes);

nlohmann::ordered_json to_json(const std::vector<GateCheck>& checks);

}  // namespace umbrameter
