#include "store/run_value.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/error.h"
#include "reports/files/deflate.h"
#include "reports/files/exr.h"
#include "reports/files/output.h"
#include "store/run_record.h"
#include "store/value_archive.h"

namespace umbrameter {
namespace archive {

template <>
struct StoredAs<GBuffer> {
  struct Stored {
    int width, height;
    Image<std::uint32_t> instance;
  };
  static Stored to_stored(const GBuffer& gbuffer) { return {gbuffer.width, gbuffer.height, gbuffer.instance}; }
  static GBuffer from_stored(Stored stored) {
    GBuffer gbuffer;
    gbuffer.width = stored.width;
    gbuffer.height = stored.height;
    gbuffer.instance = std::move(stored.instance);
    return gbuffer;
  }
};

// Without the images, which are layers: Boost.PFR cannot count the fields of a struct with them.
template <>
struct StoredAs<AoStages> {
  struct Stored {
    std::string integral;
    AoStageStatistics statistics;
    std::vector<AoStageBin> bins;
    int many_draws;
    TraceStatistics integrals;
  };
  static Stored to_stored(const AoStages& stages) {
    return {stages.integral, stages.statistics, stages.bins, stages.many_draws, stages.integrals};
  }
  static AoStages from_stored(Stored stored) {
    return {
        std::move(stored.integral), {}, stored.statistics, std::move(stored.bins), stored.many_draws, stored.integrals};
  }
};

template <>
struct StoredAs<BiasSpec> {
  struct Stored {
    std::string engine;
    std::vector<double> numbers, settings, texels, ranges;
  };
  static Stored to_stored(const BiasSpec& spec) {
    return {std::string(spec.engine->name), spec.numbers, spec.settings.values, spec.texels, spec.ranges};
  }
  static BiasSpec from_stored(Stored stored) {
    BiasSpec spec = default_target(require_bias_engine(stored.engine));
    spec.numbers = std::move(stored.numbers);
    spec.settings.values = std::move(stored.settings);
    spec.texels = std::move(stored.texels);
    spec.ranges = std::move(stored.ranges);
    return spec;
  }
};

template <>
struct StoredAs<MetricColumn> {
  struct Stored {
    std::string metric, name, unit;
    std::uint64_t other_unit;
  };
  static Stored to_stored(const MetricColumn& column) {
    return {std::string(column.metric->name), column.name, column.unit, column.other_unit};
  }
  static MetricColumn from_stored(Stored stored) {
    const Metric* metric = select_metrics(stored.metric, color_metrics()).at(0);
    return {metric, std::move(stored.name), std::move(stored.unit), stored.other_unit};
  }
};

}  // namespace archive

namespace {

constexpr std::string_view magic = "umbrameter run\n";
constexpr std::size_t hash_digits = 32;

std::string hash_of(std::string_view bytes) { return ContentHash().add(bytes).hex(); }

// Of the version of umbrameter and of every struct in the value: one that has changed is not read wrongly.
const std::string& layout_hash() {
  static const std::string hash = [] {
    std::string layout = UMBRAMETER_VERSION " ";
    archive::add_layout<RunResults>(layout);
    return hash_of(layout);
  }();
  return hash;
}

// Throws std::exception that says what is wrong.
RunResults value_of(std::string_view bytes, std::vector<std::string>& channels) {
  const std::string_view hash = bytes.substr(0, hash_digits);
  bytes.remove_prefix(std::min(bytes.size(), hash_digits));
  if (hash != hash_of(bytes)) throw std::runtime_error("it does not match its checksum");
  archive::Reader head(bytes);
  const auto size = head.get<std::uint64_t>();
  const std::string content = inflate(bytes.substr(sizeof size), size);
  archive::Reader reader(content);
  channels = reader.get<std::vector<std::string>>();
  RunResults results = reader.get<RunResults>();
  if (!reader.is_at_end()) throw std::runtime_error("it goes on after its end");
  return results;
}

// The channels of images.exr in the order in which they were written.
LayeredImage read_layers(const std::filesystem::path& path, const std::vector<std::string>& channels) {
  LayeredImage image = read_exr(path);
  std::vector<Channel> ordered;
  for (const std::string& name : channels) {
    const auto found = std::ranges::find(image.channels, name, &Channel::name);
    if (found == image.channels.end()) {
      throw Error(ExitCode::unreadable_input, path.string(), "it lacks the layer " + name, "rerun the command");
    }
    ordered.push_back(std::move(*found));
  }
  image.channels = std::move(ordered);
  return image;
}

}  // namespace

void write_run_value(const std::filesystem::path& folder, RunResults& results) {
  std::vector<Channel> aside;
  if (results.measurement) aside.swap(results.measurement->layers.channels);
  std::vector<std::string> channels;
  for (const Channel& channel : aside) channels.push_back(channel.name);
  const std::string content = archive::Writer().put(channels).put(results).take();
  if (results.measurement) aside.swap(results.measurement->layers.channels);
  const std::string body = archive::Writer().put(std::uint64_t{content.size()}).take() + deflate(content);
  write_text(folder / run_value_file, std::string(magic) + layout_hash() + hash_of(body) + body);
}

std::optional<RunResults> read_run_value(const std::filesystem::path& folder, bool with_layers) {
  const std::filesystem::path path = folder / run_value_file;
  const std::optional<std::string> file = text_of_file(path);
  const std::string head = std::string(magic) + layout_hash();
  if (!file || !file->starts_with(head)) return std::nullopt;
  std::vector<std::string> channels;
  RunResults results;
  try {
    results = value_of(std::string_view(*file).substr(head.size()), channels);
  } catch (const std::exception& error) {
    throw Error(ExitCode::unreadable_input, path.string(), error.what(), "rerun the command");
  }
  if (with_layers && results.measurement) results.measurement->layers = read_layers(folder / "images.exr", channels);
  return results;
}

}  // namespace umbrameter
