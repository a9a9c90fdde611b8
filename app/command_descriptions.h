// Name, summary and example of each command, for help, completion and the man page.
#pragma once

namespace CLI {
class App;
}

namespace umbrameter {

inline constexpr const char* about =
    "Umbrameter measures the error of real-time shadows and ambient occlusion: it renders a glTF scene with OpenGL and "
    "with Embree, breaks the difference down by cause, and recommends settings.";

struct CommandDescription {
  const char* name;
  const char* summary;
  const char* example;
};

inline constexpr CommandDescription compare_command = {
    "compare", "Measure one configuration: recommended bias, images, causes, report",
    "Example: umbrameter compare courtyard -o out --light sun --shadow.resolution 2048\n"
    "Then open out/index.html. --for godot,three adds the bias in the numbers of these engines."};
inline constexpr CommandDescription sweep_command = {
    "sweep", "Measure all combinations of varied parameters",
    "Example: umbrameter sweep courtyard -o out --light sun \\\n"
    "             --vary shadow.constant-bias=0:0.2:65 --vary shadow.resolution=512,1024,2048\n"
    "An axis is first:last:count[:log] or a list a,b,c. Open out/index.html; out/sweep.csv has all cells."};
inline constexpr CommandDescription plan_command = {
    "plan", "Cut a sweep or a tuning into shards that run anywhere: a folder for run, merge and status",
    "Example: umbrameter plan sweep courtyard -o plan --shards 64 --vary shadow.resolution=256,512,1024\n"
    "Then: umbrameter run plan --shard K for each K from 0, and umbrameter merge plan -o out; docs/many-machines.md."};
inline constexpr CommandDescription run_command = {"run", "Measure shards of a plan",
                                                   "Example: umbrameter run plan --shard 7\n"
                                                   "As a task of an array: umbrameter run plan --shard env"};
inline constexpr CommandDescription merge_command = {
    "merge", "Put the shards of a plan together: the files of the undivided sweep or tuning",
    "Example: umbrameter merge plan -o out\n"
    "Exit code 5 and the list of shards to run if some are missing or broken, or a tuning has another round."};
inline constexpr CommandDescription status_command = {
    "status", "Show which shards of a plan are done, running or failed, and when all will be done",
    "Example: umbrameter status plan"};
inline constexpr CommandDescription tune_command = {
    "tune", "Find the best parameters over several scenes, cameras and lights",
    "Example: umbrameter tune courtyard -o out --over view.camera=all --constraint 'acne<0.1%' \\\n"
    "             --vary shadow.constant-bias=0:8texels --vary shadow.slope-bias=0:4\n"
    "An axis is first:last[:log], or as for sweep. Then run: umbrameter compare -c out/tuned.toml -o best"};
inline constexpr CommandDescription trace_command = {
    "trace", "Render the reference alone: Embree, no OpenGL",
    "Example: umbrameter trace courtyard -o out --truth.spp 1024 --truth.ao-distance 2"};
inline constexpr CommandDescription raster_command = {
    "raster", "Render the techniques alone: OpenGL, no Embree",
    "Example: umbrameter raster courtyard -o out --shadow.filter box --shadow.filter-size 5"};
inline constexpr CommandDescription evaluate_command = {
    "evaluate", "Measure what an engine wrote to files: a shadow mask, AO, or a frame with and without them",
    "Example: umbrameter evaluate scene.glb -o out --visibility mask.exr --depth depth.exr \\\n"
    "             --convention opengl --size 1280x720\n"
    "Camera and light are those of the scene, or --frame.camera; docs/evaluate.md."};
inline constexpr CommandDescription diff_command = {
    "diff", "Measure the difference of two images: FLIP, SSIM, PSNR, ...",
    "Example: umbrameter diff test.exr reference.exr -o error.png --json"};
inline constexpr CommandDescription check_command = {
    "check", "Check finished runs against a budget; exit code 1 if a bound is broken or not measured",
    "Example: umbrameter check out --budget budget.toml --junit report.xml\n"
    "'umbrameter check out --budget budget.toml --update' writes the budget."};
inline constexpr CommandDescription report_command = {
    "report", "Compare finished runs: differences, figures, LaTeX tables",
    "Example: umbrameter report before after -o both --latex --figure-style column\n"
    "Then open both/index.html; both/comparison.csv has all differences."};
inline constexpr CommandDescription scenes_command = {"scenes",
                                                      "List the built-in scenes, or draw them on a contact sheet",
                                                      "Example: umbrameter scenes --sheet scenes.pdf"};
inline constexpr CommandDescription scene_command = {"scene", "Write a built-in scene as a .glb file",
                                                     "Example: umbrameter scene courtyard -o courtyard.glb"};
inline constexpr CommandDescription convert_command = {
    "convert", "Convert a shadow bias between engines, metres, texels and map depth",
    "Example: umbrameter convert courtyard --light sun --shadow.cascades 4 \\\n"
    "             --from godot:bias=0.1,normal_bias=2 --to three:near=1,far=80,unity-urp,metres"};
inline constexpr CommandDescription cache_command = {
    "cache", "List or remove the cached references",
    "Example: umbrameter cache --clear\n"
    "The limit is 2 GB; set UMBRAMETER_CACHE_SIZE to change it (500M, 10G; 0 for no cache)."};
inline constexpr CommandDescription engine_command_text = {
    "engine", "List the engines that can be measured, or check an adapter",
    "Example: umbrameter engine check 'python3 my_adapter.py'\n"
    "An engine takes the place of our techniques: umbrameter compare courtyard --engine threejs -o out"};
inline constexpr CommandDescription serve_command = {
    "serve", "Keep a scene loaded and measure it at the parameters of each request on stdin",
    "Example: echo '{\"id\": 1, \"request\": \"evaluate\", \"parameters\": {\"shadow.constant-bias\": 0.02}}' |\n"
    "             umbrameter serve courtyard --light sun\n"
    "Requests and replies are JSON, one a line: docs/serve.md."};
inline constexpr CommandDescription presets_command = {
    "presets", "List the presets: settings of engines in this program's parameters",
    "Example: umbrameter compare courtyard --light sun --preset godot -o out"};
inline constexpr CommandDescription info_command = {
    "info", "Show versions and OpenGL devices, or the contents of a scene", "Example: umbrameter info courtyard"};
inline constexpr CommandDescription parameters_command = {
    "parameters", "List every parameter with default, unit and limits",
    "Example: umbrameter parameters --markdown > docs/parameters.md"};
inline constexpr CommandDescription help_command = {"help", "Show the help of a command",
                                                    "Example: umbrameter help sweep"};
// Packagers' command, in no list: CMake calls it.
inline constexpr CommandDescription generate_command = {"generate", "Print a completion script or the man page",
                                                        "Example: umbrameter generate bash -o umbrameter.bash"};

/// A subcommand without options.
CLI::App& add_command(CLI::App& app, const CommandDescription& description);

}  // namespace umbrameter
