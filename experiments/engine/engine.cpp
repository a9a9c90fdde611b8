#include "experiments/engine/engine.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "core/error.h"
#include "experiments/engine/child_process.h"
#include "reports/files/data_folder.h"
#include "reports/files/image_file.h"
#include "reports/files/markup.h"
#include "reports/files/output.h"
#include "scenes/flat_normals.h"
#include "scenes/gltf.h"
#include "scenes/ground.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_warnings = 20;
constexpr const char* own_name = "umbrameter";

// An engine that knows no infinite far plane gets one behind everything.
View with_far_plane(View view, const Bounds& bounds) {
  auto* lens = std::get_if<PerspectiveProjection>(&view.camera.projection);
  if (lens == nullptr || std::isfinite(lens->far_plane)) return view;
  const dvec3 eye(view.camera.world_from_camera[3]);
  lens->far_plane = 2.0 * (glm::length(eye - bounds.center()) + bounds.radius()) + lens->near_plane;
  return view;
}

// What an engine draws: one camera, one light, and a normal at every vertex, as engines differ in what they make of
// none.
Scene with_one_view(const Scene& scene, const View& view, const Light& light) {
  Scene one = scene;
  for (Mesh& mesh : one.meshes) {
    if (mesh.normals.empty()) mesh = with_flat_normals(mesh);
  }
  one.cameras = {view.camera};
  one.lights = {light};
  one.lights.front().emitter = std::monostate{};
  return one;
}

bool is_set_up(const fs::path& folder) {
  std::error_code ignored;
  return !fs::exists(folder / "package.json", ignored) || fs::is_directory(folder / "node_modules", ignored);
}

// A link or a device could lead out of the folder, and a FIFO would be waited for for ever.
void require_regular(const fs::path& path, const std::string& name) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) throw std::runtime_error("it wrote no file " + name);
  if (!S_ISREG(status.st_mode)) throw std::runtime_error(name + " is no regular file");
}

}  // namespace

struct Engine::Folder {
  fs::path path;

  Folder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "umbrameter-engine-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw_write_error(pattern, errno);
    path = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void clear() const {
    std::error_code ignored;
    fs::remove_all(frames(), ignored);
    fs::create_directories(frames(), ignored);
  }
  fs::path frames() const { return path / "frames"; }
};

std::vector<fs::path> engine_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("UMBRAMETER_ENGINES")) folders.emplace_back(given);
  if (const char* home = std::getenv("XDG_DATA_HOME")) {
    folders.push_back(fs::path(home) / "umbrameter" / "engines");
  } else if (const char* user = std::getenv("HOME")) {
    folders.push_back(fs::path(user) / ".local" / "share" / "umbrameter" / "engines");
  }
  folders.push_back(data_folder() / "engines");
  return folders;
}

std::vector<InstalledEngine> installed_engines() {
  std::vector<InstalledEngine> engines = {{own_name, {}, true}};
  for (const fs::path& folder : engine_folders()) {
    std::error_code error;
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (fs::exists(entry.path() / "adapter", error)) found.push_back(entry.path());
    }
    std::ranges::sort(found);
    for (const fs::path& path : found) {
      const std::string name = path.filename().string();
      const auto is_same = [&](const InstalledEngine& each) { return each.name == name; };
      const auto known = std::ranges::find_if(engines, is_same);
      if (known == engines.end()) {
        engines.push_back({name, path, is_set_up(path)});
      } else if (!known->is_set_up && is_set_up(path)) {
        *known = {name, path, true};
      }
    }
  }
  return engines;
}

std::vector<std::string> engine_command(const std::string& adapter) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  bool has_word = false;
  for (const char c : adapter) {
    if (quote != 0 && c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
      has_word = true;
    } else if (quote == 0 && (c == ' ' || c == '\t')) {
      if (has_word) words.push_back(std::exchange(word, {}));
      has_word = false;
    } else {
      word += c;
      has_word = true;
    }
  }
  if (has_word) words.push_back(word);
  const std::string what = "--engine '" + plain_text(adapter) + "'";
  if (quote != 0) throw Error(ExitCode::usage, what, "a quote does not end", "close it");
  if (words.empty()) throw Error(ExitCode::usage, what, "no command", "name an engine: 'umbrameter engine list'");
  if (words.size() > 1 || words.front().find('/') != std::string::npos) return words;
  if (words.front() == own_name) return {fs::read_symlink("/proc/self/exe").string(), "engine", "serve"};
  for (const InstalledEngine& engine : installed_engines()) {
    if (engine.name != words.front()) continue;
    if (!engine.is_set_up) {
      throw Error(ExitCode::usage, what, "it is not set up", "run " + (engine.folder / "setup").string());
    }
    return {(engine.folder / "adapter").string()};
  }
  return words;
}

Engine::Engine(std::string adapter, const EngineLimits& limits)
    : adapter_(std::move(adapter)),
      limits_(limits),
      command_(engine_command(adapter_)),
      folder_(std::make_unique<Folder>()) {
  start();
}

Engine::~Engine() = default;

EngineParams Engine::parameters() const { return {adapter_, description_.title(), description_.parameters}; }

// Empty if all went well, else what did not.
std::string Engine::exchange(const std::function<std::string(int)>& text, double seconds, const Read& read) {
  const int id = ++last_id_;
  process_->write_line(text(id));  // where it fails, reading says why
  const auto limit = std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * seconds));
  const std::optional<std::string> line = process_->read_line(limit);
  if (!line) return process_->problem();
  try {
    read(*line, id);
  } catch (const EngineRefusal& refusal) {
    throw Error(ExitCode::partial, "engine " + adapter_, plain_text(refusal.error),
                "see docs/engine-protocol.md, and the adapter's own messages");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

void Engine::start() {
  process_.reset();
  process_ = std::make_unique<ChildProcess>(command_);
  const bool is_first = description_.name.empty();
  const std::string problem = exchange(describe_request, limits_.describe, [&](const std::string& line, int id) {
    const EngineDescription described = parse_description(line, id);
    if (!is_first &&
        (described.title() != description_.title() || described.parameters.size() != description_.parameters.size())) {
      throw std::runtime_error("started again it describes another engine");
    }
    description_ = described;
  });
  if (problem.empty()) return;
  throw Error(ExitCode::partial, "engine " + adapter_, plain_text(problem),
              "'umbrameter engine check' shows what an adapter does wrong");
}

void Engine::request(const std::function<std::string(int)>& text, double seconds, const Read& read) {
  std::string problem = exchange(text, seconds, read);
  if (!problem.empty() && restarts_ == 0) {
    ++restarts_;
    warn({fmt::format("{} was started again: {}", adapter_, problem)});
    start();
    folder_->clear();
    if (loaded_) {
      problem = exchange([&](int id) { return load_request(id, *loaded_); }, limits_.load,
                         [&](const std::string& line, int id) { warn(parse_loaded(line, id)); });
    } else {
      problem.clear();
    }
    if (problem.empty()) problem = exchange(text, seconds, read);
  }
  if (problem.empty()) return;
  throw Error(ExitCode::partial, "engine " + adapter_, plain_text(problem),
              "'umbrameter engine check' shows what an adapter does wrong");
}

void Engine::warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    const std::string text = description_.name + ": " + plain_text(warning);
    if (warnings_.size() >= most_warnings || std::ranges::find(warnings_, text) != warnings_.end()) continue;
    warnings_.push_back(text);
    new_warnings_.push_back(text);
  }
}

bool Engine::end() { return process_->end(); }

std::vector<std::string> Engine::take_warnings() { return std::exchange(new_warnings_, {}); }

void Engine::load(const Scene& scene, const std::string& content, const View& view, const Light& light) {
  EngineLoad load{(folder_->path / "scene.glb").string(), folder_->frames().string(), view, light, {}};
  const std::string key = content + load_request(0, load);
  if (loaded_ && key == loaded_key_) return;
  const auto require = [&](const std::vector<std::string>& kinds, std::string_view kind, const char* what) {
    if (std::ranges::find(kinds, kind) != kinds.end()) return;
    throw Error(ExitCode::usage, "engine " + adapter_, fmt::format("it draws no {} {}", kind, what),
                fmt::format("choose another {}", what));
  };
  require(description_.lights, kind_of(light), "light");
  const bool is_parallel = std::holds_alternative<OrthographicProjection>(view.camera.projection);
  require(description_.cameras, is_parallel ? "orthographic" : "perspective", "camera");
  load.bounds = bounds_of(scene);
  if (scene.ground) {
    for (const dvec3& corner : {ground_of(scene).min, ground_of(scene).max}) load.bounds.include(corner);
  }
  load.view = with_far_plane(view, load.bounds);
  folder_->clear();
  const std::vector<unsigned char> glb = to_glb(with_one_view(scene, load.view, light));
  write_text(load.scene, {reinterpret_cast<const char*>(glb.data()), glb.size()});
  loaded_.reset();
  request([&](int id) { return load_request(id, load); }, limits_.load,
          [&](const std::string& line, int id) { warn(parse_loaded(line, id)); });
  loaded_ = std::move(load);
  loaded_key_ = key;
}

Image<vec3> Engine::read_image(const std::string& name) const {
  const fs::path path = folder_->frames() / name;
  require_regular(path, name);
  try {
    const ImageFile file(path);
    const View& view = loaded_->view;
    if (file.width() != view.width || file.height() != view.height) {
      throw std::runtime_error(
          fmt::format("{} has {}x{} pixels, not {}x{}", name, file.width(), file.height(), view.width, view.height));
    }
    Image<vec3> image = file.decode().linear;
    for (const vec3& pixel : image.pixels) {
      if (glm::any(glm::isinf(pixel))) throw std::runtime_error(name + " holds an infinite value");
    }
    std::error_code ignored;
    fs::remove(path, ignored);
    return image;
  } catch (const Error& error) {
    throw std::runtime_error(error.what());
  }
}

std::vector<EngineFrame> Engine::render(const std::vector<std::string>& outputs, std::span<const EngineParams> frames) {
  std::vector<EngineFrame> rendered;
  request([&](int id) { return render_request(id, outputs, frames); },
          limits_.render + limits_.frame * static_cast<double>(frames.size()),
          [&](const std::string& line, int id) {
            rendered.clear();
            for (const EngineFrameFiles& written : parse_frames(line, id, outputs, frames.size())) {
              EngineFrame frame;
              frame.milliseconds = written.milliseconds;
              for (const std::string& output : outputs) frame.images.push_back(read_image(written.files.at(output)));
              rendered.push_back(std::move(frame));
              warn(written.warnings);
            }
          });
  return rendered;
}

}  // namespace umbrameter
