// umbrameter serve: a process that measures one scene again and again, at the parameters that each request names.
#include <unistd.h>

#include <cstdio>

#include "app/commands.h"
#include "core/input_lines.h"
#include "core/parallel.h"
#include "core/standard_streams.h"
#include "experiments/serve/evaluation_server.h"
#include "scenes/builtin.h"

namespace umbrameter {

ExitCode serve_lines(const std::function<std::string(const std::string&)>& reply) {
  InputLines requests(STDIN_FILENO, max_request);
  while (const std::optional<std::string> request = requests.next()) {
    write_to(stdout, reply(*request) + "\n");
    std::fflush(stdout);
  }
  return ExitCode::ok;
}

ExitCode run_serve(const CommandLine& line, const Console& console) {
  const Experiment given = make_experiment(line);
  if (has_files(given.frame)) {
    throw Error(ExitCode::usage, "--frame.visibility", "serve draws its own frames", "use umbrameter evaluate");
  }
  const SweptQuantity quantity = choose_quantity(given.run.measure, {});
  const ThreadLimit threads(line.threads);
  Scene scene = load_scene(given.scene, given.view.scene, given.scene_params,
                           load_options(line, quantity == SweptQuantity::image));
  Stages stages(std::move(scene), stage_options(line, console, given), console);
  EvaluationServer server(stages, given, quantity);
  return serve_lines([&](const std::string& request) { return server.reply(request); });
}

}  // namespace umbrameter
