#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "app/commands.h"
#include "core/interrupt.h"
#include "core/standard_streams.h"
#include "reports/files/markup.h"
#include "reports/files/output.h"

namespace umbrameter {
namespace {

ExitCode run(int argc, const char* const* argv) {
  const std::variant<CommandLine, Information> parsed = parse_command_line(argc, argv);
  if (const auto* information = std::get_if<Information>(&parsed)) {
    if (information->file.empty()) {
      write_to(information->code == ExitCode::ok ? stdout : stderr, information->text);
    } else {
      write_text(information->file, information->text);
    }
    return information->code;
  }
  const CommandLine& line = std::get<CommandLine>(parsed);
  const Console console{line.quiet, line.json, line.verbose};
  if (line.command == "sweep") return run_sweep_command(line, console);
  if (line.command == "plan") return run_plan(line, console);
  if (line.command == "run") return run_shards(line, console);
  if (line.command == "merge") return run_merge(line, console);
  if (line.command == "status") return run_status(line, console);
  if (line.command == "tune") return run_tune_command(line, console);
  if (line.command == "diff") return run_diff(line, console);
  if (line.command == "check") return run_check(line, console);
  if (line.command == "report") return run_report(line, console);
  if (line.command == "scenes") return run_scenes(line, console);
  if (line.command == "scene") return run_scene(line, console);
  if (line.command == "presets") return run_presets(console);
  if (line.command == "engine") return run_engine(line, console);
  if (line.command == "convert") return run_convert(line, console);
  if (line.command == "cache") return run_cache(line, console);
  if (line.command == "serve") return run_serve(line, console);
  if (line.command == "info") return run_info(line, console);
  if (line.command == "parameters") return run_parameters(line);
  return run_image_command(line, console);
}

// stdout may be a full disk or a closed pipe; that is found out only when it is flushed.
ExitCode finish_output(ExitCode code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  throw Error(ExitCode::partial, "stdout", "some output could not be written", "check where the output goes");
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  using namespace umbrameter;
  install_interrupt_handlers();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file size is then a failed write, which has its message
  try {
    return static_cast<int>(finish_output(run(argc, argv)));
  } catch (const Error& error) {
    write_to(stderr, fmt::format("umbrameter: {}\n", plain_text(error.what())));
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    write_to(stderr, "umbrameter: out of memory; use a smaller --size or a smaller scene\n");
    return static_cast<int>(ExitCode::partial);
  } catch (const std::exception& error) {
    write_to(stderr, fmt::format("umbrameter: unexpected failure: {}; please report this\n", plain_text(error.what())));
    return static_cast<int>(ExitCode::partial);
  }
}
