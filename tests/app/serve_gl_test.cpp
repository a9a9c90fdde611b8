// umbrameter serve as a process: its pipes, its end, and the example of docs/serve.md.
#include <sys/stat.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> contact_box = {"serve", "contact-box", "--light", "sun", "--size", "96x54", "--quiet"};

class Serve : public GlRun {
 protected:
  ProgramResult serve(const std::vector<std::string>& arguments, const std::string& requests) const {
    ProgramOptions options;
    options.wrapper = {"sh", "-c", "file=$1; shift; exec \"$@\" <\"$file\"", "sh", folder_.write("requests", requests)};
    return run_program(arguments, options);
  }
  // While stdin stays open, a signal arrives after the first reply.
  ProgramResult interrupted(const std::vector<std::string>& arguments, int signal) const {
    const std::string requests = folder_ / "fifo", replies = folder_ / "replies";
    EXPECT_EQ(mkfifo(requests.c_str(), 0600), 0);
    ProgramOptions options;
    options.wrapper = {"sh", "-c",     R"(exec 3<>"$1"; echo '{"id": 1, "request": "describe"}' >&3; out=$2; shift 2
                                      exec "$@" <&3 >"$out")",
                       "sh", requests, replies};
    options.signal = signal;
    options.signal_after_seconds = 0.05;
    options.signal_counts_from = [&] { return std::filesystem::exists(replies) && !text_of(replies).empty(); };
    ProgramResult result = run_program(arguments, options);
    result.out = text_of(replies);
    return result;
  }
};

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
  return lines;
}

// As a page shows them, over several lines.
std::vector<Json> objects_of(const std::string& text) {
  std::vector<Json> objects;
  std::istringstream in(text);
  std::string object;
  for (std::string line; std::getline(in, line);) {
    object += line;
    if (!Json::accept(object)) continue;
    objects.push_back(Json::parse(object));
    object.clear();
  }
  EXPECT_EQ(object, "");
  return objects;
}

// Of a page: the lines of its blocks in this language.
std::string blocks_of(const std::string& page, const std::string& language) {
  std::string lines;
  std::istringstream in(page);
  bool is_inside = false;
  for (std::string line; std::getline(in, line);) {
    if (is_inside && line == "```") {
      is_inside = false;
    } else if (is_inside) {
      lines += line + "\n";
    }
    if (line == "```" + language) is_inside = true;
  }
  return lines;
}

TEST_F(Serve, Each_request_has_one_reply_in_order_and_the_end_of_stdin_is_success) {
  const ProgramResult result = serve(contact_box,
                                     "{\"id\": 7, \"request\": \"describe\"}\nno JSON\n"
                                     "{\"id\": \"b\", \"request\": \"evaluate\", "
                                     "\"parameters\": {\"shadow.constant-bias\": \"2texels\"}}");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  const std::vector<Json> replies = lines_of(result.out);
  ASSERT_EQ(replies.size(), 3u);
  EXPECT_EQ(replies[0]["id"], 7);
  EXPECT_TRUE(replies[1].contains("error"));
  EXPECT_EQ(replies[2]["id"], "b");
  // What compare measures there.
  const ProgramResult compared =
      run_program({"compare", "contact-box", "--light", "sun", "--size", "96x54", "--measure", "shadows",
                   "--no-figures", "--shadow.constant-bias", "2texels", "--json", "-o", folder_ / "out"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const Json expected = Json::parse(compared.out)["shadows"][0]["statistics"];
  for (const auto& [name, value] : expected.items()) {
    EXPECT_NEAR(replies[2]["statistics"].at(name).get<double>(), value.get<double>(), 1e-12) << name;
  }
}

TEST_F(Serve, Notes_are_on_stderr_and_replies_alone_on_stdout) {
  const ProgramResult result = serve({"serve", "contact-box", "--size", "96x54", "--light", "nowhere"}, "");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
}

TEST_F(Serve, A_scene_that_cannot_be_measured_ends_the_process_before_the_first_reply) {
  const std::string request = "{\"id\": 1, \"request\": \"describe\"}\n";
  for (const auto& [scene, code] : {std::pair("no-such-scene", 4), std::pair("courtyard", 2)}) {
    const ProgramResult result = serve({"serve", scene, "--size", "96x54", "--quiet"}, request);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
  }
}

TEST_F(Serve, A_signal_ends_it_while_it_waits_for_a_request) {
  const ProgramResult result = interrupted(contact_box, SIGTERM);
  EXPECT_EQ(result.exit_code, 143) << result.err;
  EXPECT_EQ(lines_of(result.out).size(), 1u);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
}

TEST_F(Serve, Ctrl_c_ends_our_rasteriser_as_an_adapter_while_it_waits) {
  EXPECT_EQ(interrupted({"engine", "serve"}, SIGINT).exit_code, 130);
}

TEST_F(Serve, The_example_of_its_page_has_the_replies_that_the_page_shows) {
  const std::string page = text_of(std::filesystem::path(UMBRAMETER_DOCS) / "serve.md");
  const std::vector<Json> shown = objects_of(blocks_of(page, "json"));
  std::string requests;
  std::vector<Json> expected;
  for (const Json& line : shown) {
    if (line.contains("request")) {
      requests += line.dump() + "\n";
    } else {
      expected.push_back(line);
    }
  }
  const ProgramResult result =
      serve({"serve", "courtyard", "--light", "sun", "--size", "640x360", "--quiet"}, requests);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<Json> replies = lines_of(result.out);
  ASSERT_EQ(replies.size(), expected.size());
  ASSERT_GE(replies.size(), 3u);
  for (std::size_t i = 0; i < replies.size(); ++i) {
    for (const auto& [name, value] : expected[i].items()) {
      const Json& given = replies[i].at(name);
      if (name == "statistics" && value.is_object()) {
        // The page shows some of them, rounded to four digits; other drivers differ in single pixels.
        for (const auto& [statistic, number] : value.items()) {
          EXPECT_NEAR(given.at(statistic).get<double>(), number.get<double>(), 0.01 * number.get<double>())
              << statistic;
        }
      } else if (value.is_array() && name != "lights") {
        for (const Json& each : value) EXPECT_NE(std::ranges::find(given, each), given.end()) << each;
      } else if (name != "milliseconds" && name != "renderer") {
        EXPECT_EQ(given, value) << name;
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
