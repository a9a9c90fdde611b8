// umbrameter engine: lists the engines, holds an adapter against the protocol, and serves our own rasteriser as one.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/print_json.h"
#include "core/parallel.h"
#include "experiments/engine/conformance.h"
#include "experiments/engine/engine.h"
#include "experiments/serve/own_adapter.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

ExitCode list_engines(const Console& console) {
  Json json = Json::array();
  for (const InstalledEngine& engine : installed_engines()) {
    const std::string where = engine.folder.empty() ? "our own rasteriser" : engine.folder.string();
    const std::string state =
        engine.is_set_up ? where : fmt::format("not set up: run {}/setup", engine.folder.string());
    print_line(console, fmt::format("{:<12} {}", engine.name, state));
    json.push_back({{"name", engine.name}, {"folder", engine.folder.string()}, {"is_set_up", engine.is_set_up}});
  }
  add_line(console,
           "Measure one: umbrameter compare courtyard --engine NAME -o out; or any command that speaks the "
           "engine protocol: --engine 'COMMAND ...'");
  print_json(console, json);
  return ExitCode::ok;
}

ExitCode check_engine(const CommandLine& line, const Console& console) {
  if (line.names.empty()) {
    throw Error(ExitCode::usage, "engine check", "no adapter given", "umbrameter engine check 'COMMAND ...'");
  }
  bool is_fine = true;
  Json json = Json::array();
  for (const ConformanceCheck& check : check_conformance(line.names.front())) {
    is_fine = is_fine && check.problem.empty();
    print_line(console, fmt::format("{:<6} {}{}", check.problem.empty() ? "ok" : "FAILS", check.title,
                                    check.problem.empty() ? "" : ": " + check.problem));
    json.push_back({{"check", check.title}, {"problem", check.problem}});
  }
  print_json(console, json);
  return is_fine ? ExitCode::ok : ExitCode::check_failed;
}

}  // namespace

ExitCode run_engine(const CommandLine& line, const Console& console) {
  if (line.action == "check") return check_engine(line, console);
  if (line.action != "serve") return list_engines(console);
  const ThreadLimit threads(line.threads);
  OwnAdapter adapter(line.gl_device, line.threads);
  return serve_lines([&](const std::string& request) { return adapter.reply(request); });
}

}  // namespace umbrameter
