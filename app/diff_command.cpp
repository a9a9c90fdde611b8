#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "app/commands.h"
#include "app/print_json.h"
#include "compare/alignment.h"
#include "compare/metrics/color_metric.h"
#include "core/lists.h"
#include "reports/figures/figures.h"
#include "reports/files/image_file.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void reject(const std::string& option, const std::string& text, const std::string& remedy) {
  throw Error(ExitCode::usage, option + " " + text, "not understood", remedy);
}

struct Pair {
  ColorImage test, reference;
  Image<vec3> mask;  ///< empty: all pixels count
  ImageContent content = ImageContent::display;
};

std::string size_text(const Image<vec3>& image) { return fmt::format("{}x{}", image.width, image.height); }

void require_same_size(const ImageFile& file, const ImageFile& reference) {
  if (file.width() == reference.width() && file.height() == reference.height()) return;
  throw Error(ExitCode::usage, file.path().string(),
              fmt::format("its size {}x{} differs from the reference's {}x{}", file.width(), file.height(),
                          reference.width(), reference.height()),
              "compare images of one size");
}

void require_numbers(const std::filesystem::path& path, const Image<vec3>& image) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    const vec3& color = image[i];
    if (std::isfinite(color.x) && std::isfinite(color.y) && std::isfinite(color.z)) continue;
    throw Error(ExitCode::unreadable_input, path.string(),
                fmt::format("pixel ({}, {}) is infinite or not a number", i % static_cast<std::size_t>(image.width),
                            i / static_cast<std::size_t>(image.width)),
                "use --crop to leave it out");
  }
}

Image<vec3> cropped(const Image<vec3>& image, int left, int top, int width, int height) {
  Image<vec3> result(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) result.at(x, y) = image.at(left + x, top + y);
  }
  return result;
}

void crop(Pair& pair, const std::string& text) {
  const std::optional<std::vector<int>> box = parsed_list<int>(text, ',');
  if (!box || box->size() != 4) reject("--crop", text, "write it like 100,50,640,360: left, top, width, height");
  const auto [left, top, width, height] = std::array{(*box)[0], (*box)[1], (*box)[2], (*box)[3]};
  const Image<vec3>& image = pair.reference.linear;
  if (left < 0 || top < 0 || width < 1 || height < 1 || left > image.width - width || top > image.height - height) {
    throw Error(ExitCode::usage, "--crop " + text, "it leaves the image of " + size_text(image));
  }
  for (Image<vec3>* each : {&pair.test.linear, &pair.reference.linear, &pair.mask}) {
    if (!each->empty()) *each = cropped(*each, left, top, width, height);
  }
}

Pair read_pair(const DiffOptions& diff) {
  const ImageFile test(diff.test);
  const ImageFile reference(diff.reference);
  require_same_size(test, reference);
  Pair pair;
  if (!diff.mask.empty()) {
    const ImageFile mask(diff.mask);
    require_same_size(mask, reference);
    pair.mask = mask.decode().linear;
  }
  pair.test = test.decode(diff.layer);
  pair.reference = reference.decode(diff.reference_layer.empty() ? diff.layer : diff.reference_layer);
  if (!diff.crop.empty()) crop(pair, diff.crop);
  require_numbers(diff.test, pair.test.linear);
  require_numbers(diff.reference, pair.reference.linear);
  const bool both_display = pair.test.is_display && pair.reference.is_display;
  pair.content = diff.data ? ImageContent::data : both_display ? ImageContent::display : ImageContent::scene;
  return pair;
}

ColorMetricParams metric_params(const DiffOptions& diff) {
  ColorMetricParams params;
  if (diff.pixels_per_degree > 0.0) params.pixels_per_degree = diff.pixels_per_degree;
  params.exposure = diff.exposure;
  if (diff.exposures.empty()) return params;
  const std::optional<std::vector<double>> range = parsed_list<double>(diff.exposures, ':');
  const bool is_range = range && (range->size() == 2 || range->size() == 3) && std::isfinite((*range)[0]) &&
                        std::isfinite((*range)[1]) && std::abs((*range)[0]) <= 100.0 && std::abs((*range)[1]) <= 100.0;
  const double count = is_range && range->size() == 3 ? (*range)[2] : 2.0;
  if (!is_range || !(count >= 1.0 && count <= 1000.0 && count == std::floor(count))) {
    reject("--exposures", diff.exposures, "write it like -3:4 or -3:4:8, in stops from -100 to 100, at most 1000");
  }
  params.start_exposure = (*range)[0];
  params.stop_exposure = (*range)[1];
  params.exposures = range->size() == 3 ? static_cast<int>(count) : 0;
  return params;
}

struct Measured {
  const Metric* metric = nullptr;
  MetricResult result;
  PooledMap pooled;
};

std::vector<const Metric*> chosen_metrics(const DiffOptions& diff, ImageContent content) {
  if (!diff.metrics.empty()) return select_metrics(diff.metrics, color_metrics(), "--metrics");
  std::vector<const Metric*> all;
  for (const Metric& metric : color_metrics()) {
    // HDR-FLIP is about exposures, which only images of a scene have.
    if (metric.name != hdr_flip_metric.name || content == ImageContent::scene) all.push_back(&metric);
  }
  return all;
}

std::string cell(double value, int digits) { return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits); }

constexpr const char* weighted_meaning =
    "weighted 25 %: the pixels of the map up to this value make up 25 % of its sum, likewise 50 % and 75 % (FLIP's "
    "weighted quartiles); '-' where the map has values below 0. 99 % of pixels: the value that they do not exceed";

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> edge_meanings{
    {{"edge-displacement", "above 0 shadows are larger than in REFERENCE, below 0 smaller (score and map)"},
     {"edge-roughness", "how unevenly TEST's edges run along those of REFERENCE"},
     {"edge-width", "above 0 edges are softer, below 0 sharper (score and map)"},
     {"edges-found", "of the edge points that count in REFERENCE, the share that counts in TEST, too"}}};

// A figure has other pixels than those that were measured.
std::string figure_warning(const char* name, const std::filesystem::path& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  const std::filesystem::path images = folder.parent_path() / "images.exr";
  if (folder.filename() != "figures" || !std::filesystem::exists(images)) return "";
  return fmt::format(
      "warning: {} is a figure of a run, drawn for people: for the pixels that were measured use {} with --layer", name,
      std::filesystem::proximate(images).string());
}

// One line for all metrics with the same details.
std::vector<std::string> details_lines(const std::vector<Measured>& all) {
  std::vector<std::pair<std::string, std::string>> lines;  // details, metrics
  for (const Measured& each : all) {
    std::string details;
    for (const auto& [name, value] : each.result.details) {
      if (std::isnan(value)) continue;
      const bool is_count = value == std::floor(value) && value > 1.0 && value < 1e15;
      details += fmt::format("{}{} {}", details.empty() ? "" : "; ", name,
                             is_count ? grouped(static_cast<std::uint64_t>(value)) : fmt::format("{:.4g}", value));
    }
    if (details.empty()) continue;
    const auto found = std::ranges::find(lines, details, &std::pair<std::string, std::string>::first);
    if (found == lines.end()) {
      lines.emplace_back(details, each.metric->name);
    } else {
      found->second += ", " + std::string(each.metric->name);
    }
  }
  return mapped(lines, [](const auto& line) { return line.second + ": " + line.first; });
}

constexpr const char* few_edges =
    "note: few edges pass from below 0.1 to above 0.9 in both images, as those of shadow masks do: "
    "edge metrics of others say little";

constexpr const char* squared_maps =
    "maps of rmse, psnr, relative-rmse: squares of the (relative) differences; of edge-roughness: px²";

bool finds_few_edges(const std::vector<Measured>& all) {
  constexpr double few = 0.05;  // of the reference's edge points
  return std::ranges::any_of(all, [](const Measured& each) {
    const auto detail =
        std::ranges::find_if(each.result.details, [](const auto& pair) { return pair.first == edges_used; });
    return (each.metric->name == "edges-found" && !(each.result.score >= few)) ||
           (detail != each.result.details.end() && !(detail->second >= few));
  });
}

// The statistics are those of the map; the JSON has more of them, and all digits.
std::vector<std::string> table_lines(const std::vector<Measured>& all) {
  std::vector<std::vector<std::string>> rows = {{"metric", "score", "map: min", "weighted 25 %", "weighted 50 %",
                                                 "weighted 75 %", "99 % of pixels", "max", "at x,y"}};
  for (const Measured& each : all) {
    const PooledMap& p = each.pooled;
    const std::string unit = each.metric->unit == "1" ? "" : " " + std::string(each.metric->unit);
    rows.push_back({std::string(each.metric->name),
                    cell(each.result.score, 6) + (std::isnan(each.result.score) ? "" : unit), cell(p.min, 4),
                    cell(p.weighted_quartile_1, 4), cell(p.weighted_median, 4), cell(p.weighted_quartile_3, 4),
                    cell(p.percentile_99, 4), cell(p.max, 4),
                    std::isnan(p.max) ? "-" : fmt::format("{},{}", p.max_at.x, p.max_at.y)});
  }
  return aligned(rows);
}

// JSON has neither NaN nor infinity: both are null.
Json to_json(const Measured& each) {
  const PooledMap& p = each.pooled;
  Json json = {{"score", each.result.score},
               {"unit", each.metric->unit},
               {"range", each.metric->range},
               {"higher_is_better", each.metric->is_higher_better},
               {"mean", p.mean},
               {"min", p.min},
               {"min_at", {p.min_at.x, p.min_at.y}},
               {"max", p.max},
               {"max_at", {p.max_at.x, p.max_at.y}},
               {"median", p.median},
               {"percentile_95", p.percentile_95},
               {"percentile_99", p.percentile_99},
               {"weighted_quartile_1", p.weighted_quartile_1},
               {"weighted_median", p.weighted_median},
               {"weighted_quartile_3", p.weighted_quartile_3}};
  for (const auto& [name, value] : each.result.details) json[name] = value;
  return json;
}

// "warning: TEST lies 2 px right and 1 px down of REFERENCE: …".
std::string to_text(const Misalignment& found) {
  std::string where;
  if (found.flips_x || found.flips_y) {
    where = std::string("is upside down");
    if (found.flips_x) where = found.flips_y ? "is turned by 180°" : "has left and right exchanged";
  } else {
    const auto along = [&](int pixels, const char* positive, const char* negative) {
      if (pixels == 0) return;
      where += fmt::format("{}{} px {}", where.empty() ? "lies " : " and ", std::abs(pixels),
                           pixels > 0 ? positive : negative);
    };
    along(found.shift.x, "to the right", "to the left");
    along(found.shift.y, "down", "up");
  }
  return fmt::format(
      "warning: TEST {} relative to REFERENCE: without this, {:.0f} % of the squared difference disappears; check how "
      "both images were written",
      where, 100.0 * (1.0 - found.remaining));
}

Json to_json(const std::optional<Misalignment>& found) {
  if (!found) return nullptr;
  return {{"shift_px", {found->shift.x, found->shift.y}},
          {"left_right_flip", found->flips_x},
          {"top_bottom_flip", found->flips_y},
          {"remaining_difference", found->remaining}};
}

const char* content_text(ImageContent content) {
  if (content == ImageContent::data) return "data without colour conversion";
  return content == ImageContent::display ? "sRGB" : "linear";
}

// " (TEST: sRGB, assumed)": the encoding, where the file does not state it or states another curve.
std::string encodings_text(const Pair& pair) {
  std::string text;
  for (const auto& [name, encoding] : {std::pair{"TEST", pair.test.encoding}, {"REFERENCE", pair.reference.encoding}}) {
    if (encoding == "linear" || encoding == "sRGB") continue;
    text += fmt::format("{}{}: {}", text.empty() ? " (" : "; ", name, encoding);
  }
  return text.empty() ? text : text + ")";
}

}  // namespace

ExitCode run_diff(const CommandLine& line, const Console& console) {
  const ThreadLimit threads(line.threads);
  const DiffOptions& diff = line.diff;
  const ColorMetricParams params = metric_params(diff);
  if (!line.output.empty() && line.output.extension() != ".png") {
    reject("-o", line.output.string(), "name a .png file");
  }
  if (!diff.map.empty()) select_metrics(diff.map, color_metrics(), "--map");
  if (!diff.metrics.empty()) select_metrics(diff.metrics, color_metrics(), "--metrics");
  const Pair pair = read_pair(diff);
  const auto is_counted = [&](std::size_t i) { return pair.mask.empty() || pair.mask[i] != vec3(0.0f); };
  const ColorInput input{pair.test.linear, pair.reference.linear, is_counted, pair.content, params};
  std::size_t counted = 0;
  bool is_equal = true;
  for (std::size_t i = 0; i < input.test.size(); ++i) {
    if (!is_counted(i)) continue;
    ++counted;
    is_equal = is_equal && input.test[i] == input.reference[i];
  }
  if (counted == 0) throw Error(ExitCode::usage, "--mask " + diff.mask.string(), "no pixel counts");

  std::vector<Measured> all;
  const auto measured = [&](const Metric* metric) -> const Measured& {
    for (const Measured& each : all) {
      if (each.metric == metric) return each;
    }
    MetricResult result = measure_color(*metric, input);
    const PooledMap pooled = pool(result.map);
    return all.emplace_back(Measured{metric, std::move(result), pooled});
  };
  for (const Metric* metric : chosen_metrics(diff, pair.content)) measured(metric);

  const std::optional<Misalignment> misaligned = find_misalignment(input.test, input.reference, is_counted);
  Json json = {{"test", diff.test.string()},          {"reference", diff.reference.string()},
               {"width", input.test.width},           {"height", input.test.height},
               {"counted_pixels", counted},           {"values", content_text(pair.content)},
               {"test_encoding", pair.test.encoding}, {"reference_encoding", pair.reference.encoding},
               {"exposure", params.exposure},         {"pixels_per_degree", params.pixels_per_degree}};
  json["misalignment"] = to_json(misaligned);
  for (const Measured& each : all) json["metrics"][std::string(each.metric->name)] = to_json(each);
  const bool chose_layer = pair.test.has_other_layers || pair.reference.has_other_layers;
  print_line(console,
             fmt::format("{}×{} pixels, {} compared, {}{}{}{}", input.test.width, input.test.height, grouped(counted),
                         content_text(pair.content), encodings_text(pair),
                         pair.content == ImageContent::scene ? fmt::format(", shown at {:+g} EV", params.exposure) : "",
                         chose_layer ? "; channels R, G, B: --layer selects another layer" : ""));
  for (const std::string& text : table_lines(all)) print_line(console, text);
  if (std::ranges::any_of(all, [](const Measured& each) {
        return each.metric->name == "rmse" || each.metric->name == "psnr" || each.metric->name == "relative-rmse" ||
               each.metric->name == "edge-roughness";
      })) {
    print_line(console, squared_maps);
  }
  add_line(console, weighted_meaning);
  std::string edges;
  for (const auto& [name, meaning] : edge_meanings) {
    if (std::ranges::none_of(all, [&](const Measured& each) { return each.metric->name == name; })) continue;
    edges += fmt::format("{}{}: {}", edges.empty() ? "" : "; ", name, meaning);
  }
  if (!edges.empty()) {
    add_line(console, edges);
    add_line(console,
             fmt::format("an edge point counts if the image passes from below 0.1 to above 0.9 there and at {} or "
                         "more of the {} points beside it on the edge; only points that count in both images are "
                         "used; edge-roughness also leaves out edges with fewer than {} used points",
                         fewest_edge_lines - 1, 2 * edge_lines, fewest_edge_points));
  }
  if (misaligned) print_line(console, to_text(*misaligned));
  for (const auto& [name, file] : {std::pair{"TEST", diff.test}, {"REFERENCE", diff.reference}}) {
    if (const std::string warning = figure_warning(name, file); !warning.empty()) print_line(console, warning);
  }
  if (finds_few_edges(all)) add_line(console, few_edges);
  for (const std::string& text : details_lines(all)) add_line(console, text);
  if (!line.output.empty()) {
    const std::string usual(pair.content == ImageContent::scene ? hdr_flip_metric.name : ldr_flip_metric.name);
    const Metric* metric = select_metrics(diff.map.empty() ? usual : diff.map, color_metrics(), "--map").front();
    write_png(line.output, colorize(measured(metric).result.map, {ColorMap::visibility, 0.0, 1.0, ""}));
    json["map"] = {{"file", line.output.string()}, {"metric", metric->name}, {"first", 0.0}, {"last", 1.0}};
    add_line(console, fmt::format("{}: map of {}, dark is 0, bright is 1", line.output.string(), metric->name));
  }
  print_json(console, json);
  return diff.exit_code && !is_equal ? ExitCode::check_failed : ExitCode::ok;
}

}  // namespace umbrameter
