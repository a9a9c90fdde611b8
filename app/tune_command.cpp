#include "app/tune_run.h"

namespace umbrameter {

ExitCode run_tune_command(const CommandLine& line, const Console& console) {
  TuneRun run(line, tuned_experiments(line));
  RunFolder folder(line.output, plan_of(run), line.force);
  run.load(console);
  return write_tune(run, folder, {}, console);
}

}  // namespace umbrameter
