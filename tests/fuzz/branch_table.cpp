// Which branches of the loader the fuzzer's corpus reaches, by what llvm-cov exports, instantiations of a template
// taken together; and which it cannot, by a list with a reason for each.
// usage: branch_table EXPORT.json LIST PART     PART: of the files' paths, "/scenes/gltf_"
// A line of LIST: file | the condition as it is written | true or false: the way it never goes | why
// Ends with 1 when a branch is neither reached nor in the list, or when the list names one that is reached.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using Lines = std::vector<std::string>;

Lines read_lines(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  Lines lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// One way of one condition.
struct Way {
  std::string file;
  std::string condition;
  std::string direction;
  auto operator<=>(const Way&) const = default;
};

struct Place {
  std::string path;
  std::size_t line = 0, column = 0, last_line = 0, last_column = 0;  // from 1; the last column is the first beyond
  auto operator<=>(const Place&) const = default;
};

struct Taken {
  std::uint64_t when_true = 0;
  std::uint64_t when_false = 0;
};

std::string text_at(const Place& place, const Lines& lines) {
  const std::string& line = lines.at(place.line - 1);
  const std::size_t end = place.last_line == place.line ? place.last_column : line.size() + 1;
  return line.substr(place.column - 1, end - place.column);
}

// llvm-cov, "export": a branch is its place, how often it was true and false, and the number of its file.
std::map<Place, Taken> read_branches(const std::filesystem::path& path, const std::string& part) {
  std::ifstream file(path);
  const nlohmann::json root = nlohmann::json::parse(file);
  std::map<Place, Taken> branches;
  for (const auto& function : root.at("data").at(0).at("functions")) {
    for (const auto& branch : function.at("branches")) {
      const std::string source = function.at("filenames").at(branch.at(6).get<std::size_t>());
      if (source.find(part) == std::string::npos) continue;
      Taken& taken = branches[{source, branch.at(0), branch.at(1), branch.at(2), branch.at(3)}];
      taken.when_true += branch.at(4).get<std::uint64_t>();
      taken.when_false += branch.at(5).get<std::uint64_t>();
    }
  }
  return branches;
}

std::map<Way, std::string> read_list(const std::filesystem::path& path) {
  std::map<Way, std::string> list;
  for (const std::string& line : read_lines(path)) {
    if (line.empty() || line.front() == '#') continue;
    Lines fields;
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t end = std::min(line.find(" | ", at), line.size());
      fields.push_back(trimmed(line.substr(at, end - at)));
      at = end + 3;
    }
    if (fields.size() != 4) throw std::runtime_error(path.string() + ": not four fields: " + line);
    list[{fields[0], fields[1], fields[2]}] = fields[3];
  }
  return list;
}

struct Row {
  int ways = 0;
  int reached = 0;
  int out_of_reach = 0;
};

int print_table(const std::map<Place, Taken>& branches, const std::map<Way, std::string>& list) {
  std::map<std::string, Lines> sources;
  std::map<std::string, Row> rows;
  std::set<Way> unused;
  for (const auto& [way, reason] : list) unused.insert(way);
  int missed = 0;
  for (const auto& [place, taken] : branches) {
    Lines& lines = sources[place.path];
    if (lines.empty()) lines = read_lines(place.path);
    const std::string file = std::filesystem::path(place.path).filename().string();
    const std::string condition = text_at(place, lines);
    for (const auto& [direction, count] : {std::pair("true", taken.when_true), {"false", taken.when_false}}) {
      Row& row = rows[file];
      ++row.ways;
      const Way way{file, condition, direction};
      if (count > 0) {
        ++row.reached;
      } else if (list.contains(way)) {
        ++row.out_of_reach;
        unused.erase(way);
      } else {
        ++missed;
        std::printf("missed: %s:%zu | %s | %s\n", file.c_str(), place.line, condition.c_str(), direction);
      }
    }
  }
  for (const Way& way : unused) {
    std::printf("no longer so: %s | %s | %s\n", way.file.c_str(), way.condition.c_str(), way.direction.c_str());
  }
  Row sum;
  std::printf("%-26s %9s %9s %13s\n", "file", "branches", "reached", "out of reach");
  for (const auto& [file, row] : rows) {
    std::printf("%-26s %9d %9d %13d\n", file.c_str(), row.ways, row.reached, row.out_of_reach);
    sum = {sum.ways + row.ways, sum.reached + row.reached, sum.out_of_reach + row.out_of_reach};
  }
  std::printf("%-26s %9d %9d %13d\n", "all", sum.ways, sum.reached, sum.out_of_reach);
  return missed > 0 || !unused.empty() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: branch_table EXPORT.json LIST PART\n", stderr);
    return 2;
  }
  try {
    return print_table(read_branches(argv[1], argv[3]), read_list(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "branch_table: %s\n", error.what());
    return 3;
  }
}
