// What goes wrong in daily use: each gives one line on stderr and its exit code, and leaves no file that looks whole.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <optional>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

void expect_failure(const ProgramResult& result, int exit_code, const std::string& words) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

// The answer was measured and printed; the files could not all be written.
void expect_partial(const ProgramResult& result, const std::string& words) {
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("AO: "), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("report: "), std::string::npos) << result.out;
}

ProgramResult trace(const std::string& scene, const std::string& output, const ProgramOptions& options = {}) {
  return run_program({"trace", scene, "-o", output, "--size", "64x36", "--truth.spp", "4", "--quiet"}, options);
}

TEST(Failure, A_missing_file_is_unreadable_input) {
  const TemporaryFolder folder;
  expect_failure(trace(folder / "missing.glb", folder / "out"), 4, "missing.glb");
}

TEST(Failure, A_directory_as_scene_is_unreadable_input) {
  const TemporaryFolder folder;
  expect_failure(trace(folder.path().string(), folder / "out"), 4, folder.path().string());
}

TEST(Failure, A_truncated_glb_is_unreadable_input) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"scene", "corner", "-o", folder / "whole.glb"}).exit_code, 0);
  const std::string whole = text_of(folder / "whole.glb");
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{10}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(folder / "cut.glb", std::ios::binary) << whole.substr(0, size);
    expect_failure(trace(folder / "cut.glb", folder / "out"), 4, "cut.glb");
  }
}

TEST(Failure, A_name_in_a_file_cannot_steer_the_terminal) {
  const TemporaryFolder folder;
  // A node that does not exist in a scene whose name would colour the terminal and end the line.
  std::ofstream(folder / "rude.gltf") << R"({"asset":{"version":"2.0"},"nodes":[{"name":"\u001b[31m\nred\u009b",)"
                                      << R"("mesh":7}]})";
  const ProgramResult result = trace(folder / "rude.gltf", folder / "out");
  expect_failure(result, 4, "red");
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
  EXPECT_EQ(result.err.find("\xc2\x9b"), std::string::npos);
}

TEST(Failure, A_scene_beyond_single_precision_is_refused) {
  const TemporaryFolder folder;
  const auto scaled_triangle = [&](const char* scale) {
    std::ofstream(folder / "scaled.gltf")
        << R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"scale":[)" << scale << ',' << scale << ',' << scale
        << R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
        << R"("componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
        // Corners at the origin, at x = 1 and at y = 1.
        << R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
        << R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    return folder / "scaled.gltf";
  };
  EXPECT_EQ(trace(scaled_triangle("1e9"), folder / "large").exit_code, 0);
  expect_failure(trace(scaled_triangle("1e30"), folder / "out"), 4, "1e+30 m");
  expect_failure(trace(scaled_triangle("1e-30"), folder / "out"), 4, "the minimum is 1e-10 m");
}

TEST(Failure, A_scene_name_with_a_slip_is_told_the_right_one) {
  const TemporaryFolder folder;
  expect_failure(trace("courtyrad", folder / "out"), 4, "courtyard");
}

TEST(Failure, An_output_folder_that_cannot_be_made_is_a_usage_error) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  expect_failure(trace("corner", folder / "file"), 2, "file");
  expect_failure(trace("corner", folder / "file/out"), 2, "file/out");
  expect_failure(trace("corner", "/proc/umbrameter"), 2, "/proc/umbrameter");
}

TEST(Failure, An_unknown_flag_is_a_usage_error_that_suggests_the_nearest) {
  expect_failure(run_program({"trace", "corner", "-o", "out", "--truth.ssp", "4"}), 2, "--truth.spp");
  expect_failure(run_program({"trace", "corner", "-o", "out", "--nonsense-of-all-kinds"}), 2,
                 "--nonsense-of-all-kinds");
}

TEST(Failure, A_parameter_out_of_range_names_its_limits) {
  expect_failure(run_program({"trace", "corner", "-o", "out", "--truth.spp", "0"}), 2, "from 1 to");
  expect_failure(run_program({"trace", "corner", "-o", "out", "--truth.ao-weight", "round"}), 2, "cosine or uniform");
  expect_failure(run_program({"trace", "corner", "-o", "out", "--size", "12"}), 2, "WIDTHxHEIGHT");
  expect_failure(run_program({"sweep", "corner", "-o", "out", "--vary", "shadow.resolution=0,5"}), 2,
                 "shadow.resolution");
}

TEST(Failure, Missing_or_wrong_words_are_usage_errors) {
  expect_failure(run_program({"compre"}), 2, "compare");
  expect_failure(run_program({"trace", "corner"}), 2, "--output");
  expect_failure(run_program({"trace", "-o", "out"}), 2, "no scene");
  expect_failure(run_program({"sweep", "corner", "-o", "out"}), 2, "--vary");
  expect_failure(run_program({"trace", "corner", "extra", "-o", "out"}), 2, "extra");
}

TEST(Failure, A_scene_is_not_written_to_a_file_that_says_another_format) {
  const TemporaryFolder folder;
  expect_failure(run_program({"scene", "corner", "-o", folder / "corner.obj"}), 2, "name a .glb file");
  EXPECT_FALSE(std::filesystem::exists(folder / "corner.obj"));
}

TEST(Failure, Without_a_command_the_help_is_shown_and_the_code_says_that_nothing_was_done) {
  const ProgramResult result = run_program({});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, run_program({"--help"}).out);
}

TEST(Failure, A_dash_as_output_makes_no_folder_of_that_name) {
  expect_failure(run_program({"trace", "corner", "-o", "-"}), 2, "-o -: results cannot be written to stdout");
  expect_failure(run_program({"scene", "corner", "-o", "-"}), 2, "./-");
}

TEST(Failure, Numbers_that_mean_nothing_are_refused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& flag, const std::string& value, const std::string& words) {
    expect_failure(run_program({"trace", "corner", "-o", folder / "out", "--quiet", flag + "=" + value}), 2, words);
  };
  refused("--ao.radius", "1e30", "'1e30' is not allowed; expected a length from 1e-06 to 1e+12");
  refused("--shading.exposure", "1e30", "expected a number from 1e-12 to 1e+12");
  refused("--shadow.constant-bias", "-1e30", "expected a length from -1e+12 to 1e+12");
  refused("--light.radius", "-0.5", "its radius is below 0");
  refused("--light.angle", "-0.5", "its angular diameter is below 0");
  refused("--threads", "many", "--threads: 'many' is not allowed; expected an integer from 0 to 4096");
}

TEST(Failure, A_value_of_any_length_makes_a_short_message) {
  for (const char* flag : {"--truth.ao-weight", "--truth.spp", "--threads", "--nonsense"}) {
    const ProgramResult result = run_program({"trace", "corner", "-o", "out", flag, std::string(5000, 'x')});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(is_one_line(result.err));
    EXPECT_LT(result.err.size(), 1000u) << flag;
  }
}

TEST(Failure, Output_that_cannot_be_written_is_said_so) {
  ProgramOptions options;
  options.wrapper = {"sh", "-c", "exec \"$@\" >/dev/full", "sh"};
  for (const std::vector<std::string>& command : {std::vector<std::string>{"info", "corner", "--json"},
                                                  {"scenes", "--json"},
                                                  {"parameters", "--markdown"},
                                                  {"--help-all"}}) {
    expect_failure(run_program(command, options), 5, "stdout: some output could not be written");
  }
  options.wrapper[2] = "exec \"$@\" 2>/dev/full";
  EXPECT_EQ(run_program({"trace", "corner", "--no-such-flag"}, options).exit_code, 2);
}

TEST(Failure, What_is_no_regular_file_is_refused_at_once) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string image = folder.write("image.pfm", "Pf\n1 1\n-1\n1234");
  const std::string words = "it is not a regular file; copy it to a file first";
  expect_failure(run_program({"trace", "-c", pipe, "-o", folder / "out"}), 4, words);
  expect_failure(run_program({"diff", pipe, image}), 4, words);
  expect_failure(run_program({"diff", image, pipe}), 4, words);
  expect_failure(run_program({"diff", image, image, "--mask", pipe}), 4, words);
  expect_failure(run_program({"check", folder.path().string(), "--budget", pipe}), 4, words);
  expect_failure(run_program({"diff", image, "/dev/zero"}), 4, words);
}

TEST(Failure, A_signal_ends_the_wait_for_a_pipe) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ProgramOptions options;
  // Somebody keeps it open and writes nothing.
  options.wrapper = {"sh", "-c", "sleep 5 >'" + pipe + "' 2>/dev/null & exec \"$@\" <'" + pipe + "'", "sh"};
  options.signal = SIGTERM;
  options.signal_after_seconds = 1.0;
  expect_failure(run_program({"trace", "-c", "/dev/stdin", "-o", folder / "out"}, options), 143, "stopped");
}

TEST(Failure, A_link_in_place_of_the_figures_is_not_followed) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "elsewhere");
  std::filesystem::create_directories(folder / "out");
  put_text(folder / "elsewhere/truth_ao.svg", "mine");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "out/figures");
  const auto run = [&](const char* last) {
    return run_program(
        {"trace", "corner", "-o", folder / "out", "--size", "64x36", "--truth.spp", "4", "--quiet", last});
  };
  expect_failure(run("--no-cache"), 2, "figures: the file exists and no recorded run wrote it");
  const ProgramResult forced = run("--force");
  EXPECT_EQ(forced.exit_code, 0) << forced.err;
  EXPECT_EQ(text_of(folder / "elsewhere/truth_ao.svg"), "mine");
  EXPECT_EQ(count_files(folder / "elsewhere"), 1u);
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "out/figures"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/figures/truth_ao.svg"));
}

TEST(Failure, An_unknown_light_or_camera_lists_what_there_is) {
  const TemporaryFolder folder;
  expect_failure(run_program({"trace", "corner", "-o", folder / "out", "--light", "moon", "--quiet"}), 2, "sun");
  expect_failure(run_program({"trace", "corner", "-o", folder / "out", "--camera", "99", "--quiet"}), 2, "99");
}

TEST(Failure, A_broken_experiment_file_names_file_and_line) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.toml") << "scene = \"corner\"\n[truth\nspp = 4\n";
  expect_failure(run_program({"trace", "-c", folder / "bad.toml", "-o", folder / "out"}), 2, "bad.toml");
  std::ofstream(folder / "unknown.toml") << "scene = \"corner\"\n[truth]\nspq = 4\n";
  expect_failure(run_program({"trace", "-c", folder / "unknown.toml", "-o", folder / "out"}), 2, "truth.spp");
  expect_failure(run_program({"trace", "-c", folder / "missing.toml", "-o", folder / "out"}), 4, "missing.toml");
}

TEST(Failure, A_wrong_value_in_an_experiment_file_is_reported_with_its_line) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& text) {
    folder.write("a.toml", text);
    return run_program({"trace", "-c", folder / "a.toml", "-o", folder / "out"});
  };
  expect_failure(run("scene = \"corner\"\n\n[truth]\nspp = 0\n"), 2, "a.toml:4: truth.spp");
  expect_failure(run("scene = \"corner\"\n[shadow]\nbias = 1\n"), 2, "a.toml:3: shadow.bias");
  expect_failure(run("scene = \"corner\"\n[vary]\n\"truth.spp\" = \"1:2\"\n"), 2, "a.toml:3: --vary truth.spp");
}

TEST(Failure, An_experiment_file_that_never_ends_is_refused) {
  const TemporaryFolder folder;
  ProgramOptions options;
  options.wrapper = {"sh", "-c", "\"$@\" </dev/zero", "sh"};
  expect_failure(run_program({"trace", "-c", "/dev/stdin", "-o", folder / "out"}, options), 4, "not a regular file");
  options.wrapper[2] = "cat /dev/zero 2>/dev/null | \"$@\"";
  expect_failure(run_program({"trace", "-c", "/dev/stdin", "-o", folder / "out"}, options), 4, "larger than 1 MiB");
}

TEST(Failure, An_experiment_can_come_through_a_pipe) {
  ProgramOptions options;
  options.wrapper = {"sh", "-c", "printf 'scene = \"corner\"\n' | \"$@\"", "sh"};
  const ProgramResult result = run_program({"trace", "-c", "/dev/stdin", "--dry-run", "--quiet"}, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("corner"), std::string::npos) << result.out;
}

TEST(Failure, A_scene_path_that_is_not_utf8_is_refused_before_any_work) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"scene", "corner", "-o", folder / "plain.glb"}).exit_code, 0);
  const std::string path = folder / "caf\xe9.glb";
  std::filesystem::rename(folder / "plain.glb", path);
  expect_failure(trace(path, folder / "out"), 2, "not UTF-8");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Failure, A_scene_without_triangles_is_named_by_its_file) {
  const TemporaryFolder folder;
  folder.write("empty.gltf",
               R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"name":"Scene","nodes":[0]}],"nodes":[{}]})");
  expect_failure(trace(folder / "empty.gltf", folder / "out"), 4, "empty.gltf: the scene has no triangles");
}

TEST(Failure, No_usable_driver_is_said_so) {
  const TemporaryFolder folder;
  // Two ways to take every driver away: a vendor list that does not exist, and a device that nobody has.
  expect_failure(run_program({"raster", "corner", "-o", folder / "out", "--quiet", "--size", "64x36"},
                             {{"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json"}, {}, 0, 0.0}),
                 3, "OpenGL");
  expect_failure(run_program({"raster", "corner", "-o", folder / "out", "--quiet", "--size", "64x36", "--gl-device",
                              "no such device"}),
                 3, "no such device");
}

TEST(Failure, A_run_that_fails_leaves_no_folder_that_it_made) {
  const TemporaryFolder folder;
  const std::string out = folder / "made/for/this";
  const std::vector<std::string> output = {"-o", out, "--quiet", "--size", "64x36"};
  const auto fails = [&](std::vector<std::string> command, int exit_code, const ProgramOptions& options = {}) {
    command.insert(command.end(), output.begin(), output.end());
    EXPECT_EQ(run_program(command, options).exit_code, exit_code) << command[0];
    EXPECT_FALSE(std::filesystem::exists(folder / "made")) << command[0];
  };
  const ProgramOptions no_driver{{"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json"}, {}, 0, 0.0};
  fails({"trace", folder / "missing.glb"}, 4);
  fails({"trace", "corner", "--light", "moon"}, 2);
  fails({"trace", "corner", "--truth.ao-falloff", "linear", "--truth.ao-distance", "0"}, 2);
  fails({"compare", "corner"}, 3, no_driver);
  fails({"raster", "corner"}, 3, no_driver);
  fails({"sweep", "corner", "--vary", "shadow.resolution=16,32"}, 3, no_driver);
  fails({"sweep", "missing", "--vary", "shadow.resolution=16,32"}, 4);
  std::filesystem::create_directory(folder / "made");
  EXPECT_EQ(trace("missing", out).exit_code, 4);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "made")) << "what was there stays";
}

TEST(Failure, A_folder_with_the_results_of_another_run_is_refused_without_force) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "out";
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command = {"trace", "corner", "-o", out, "--size", "64x36", "--truth.spp", "4", "--quiet"};
    command.insert(command.end(), more.begin(), more.end());
    return run_program(command);
  };
  ASSERT_EQ(run({"--light", "sun"}).exit_code, 0);
  ASSERT_TRUE(std::filesystem::exists(out / "figures/truth_visibility_sun.png"));
  put_text(out / "figures/mine.svg", "mine");
  const std::string summary = text_of(out / "summary.json");
  expect_failure(run({"--light", "sun"}), 2, "--force");
  expect_failure(run({"--light", "lamp"}), 2, out.string() + " as output folder: it holds the results of 'umbrameter");
  EXPECT_EQ(text_of(out / "summary.json"), summary);
  expect_failure(run({"--light", "moon", "--force"}), 2, "moon");
  EXPECT_EQ(text_of(out / "summary.json"), summary) << "a command that makes no sense replaces nothing";
  const ProgramResult forced = run({"--light", "lamp", "--force"});
  ASSERT_EQ(forced.exit_code, 0) << forced.err;
  EXPECT_NE(text_of(out / "summary.json"), summary);
  EXPECT_FALSE(std::filesystem::exists(out / "figures/truth_visibility_sun.png"));
  EXPECT_TRUE(std::filesystem::exists(out / "figures/truth_visibility_lamp.png"));
  EXPECT_EQ(text_of(out / "figures/mine.svg"), "mine");
}

TEST(Failure, A_run_into_a_folder_where_another_is_going_is_refused_also_with_force) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "out";
  std::optional<ProgramResult> second;
  ProgramOptions options;
  options.signal = SIGINT;
  options.signal_counts_from = [&] {
    if (!std::filesystem::exists(out)) return false;
    if (!second || second->exit_code == 0) {
      second = run_program({"trace", "corner", "-o", out, "--size", "64x36", "--truth.spp", "4", "--quiet", "--force"});
    }
    return true;
  };
  const ProgramResult first =
      run_program({"trace", "corner", "-o", out, "--size", "1920x1080", "--truth.spp", "65536", "--quiet"}, options);
  ASSERT_TRUE(second.has_value());
  expect_failure(*second, 2, "another run is writing to it");
  EXPECT_EQ(first.exit_code, 130) << first.err;
}

TEST(Failure, A_full_disk_is_a_partial_result_and_leaves_nothing_half_written) {
  const TemporaryFolder folder;
  const std::string disk = folder / "disk";
  std::filesystem::create_directory(disk);
  // A mount namespace of its own; needs root or unprivileged user namespaces.
  const std::string mount = "mount -t tmpfs -o size=32k none '" + disk + "'";
  if (std::system(("unshare -rm sh -c \"" + mount + "\" 2>/dev/null").c_str()) != 0) {
    GTEST_SKIP() << "no tmpfs can be mounted here";
  }
  const std::string listing = folder / "listing";
  ProgramOptions options;
  options.wrapper = {"unshare",
                     "-rm",
                     "sh",
                     "-c",
                     mount + " && { \"$@\"; code=$?; ls '" + disk + "/out' > '" + listing + "'; exit $code; }",
                     "sh"};
  const ProgramResult result = trace("corner", disk + "/out", options);
  expect_partial(result, "No space left on device");
  EXPECT_EQ(text_of(listing).find("images.exr"), std::string::npos) << text_of(listing);
}

TEST(Failure, A_limit_on_file_size_is_no_crash) {
  const TemporaryFolder folder;
  ProgramOptions options;
  options.wrapper = {"sh", "-c", "ulimit -f 16; exec \"$@\"", "sh"};
  expect_partial(trace("corner", folder / "out", options), "File too large");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/images.exr"));
}

TEST(Failure, Ctrl_c_stops_at_once_with_its_exit_code_and_leaves_nothing_half_written) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const TemporaryFolder folder;
    ProgramOptions options;
    options.signal = signal;
    options.signal_after_seconds = 1.5;
    const ProgramResult result = run_program(
        {"trace", "corner", "-o", folder / "out", "--size", "1920x1080", "--truth.spp", "65536", "--quiet"}, options);
    expect_failure(result, code, "stopped");
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

}  // namespace
}  // namespace umbrameter
