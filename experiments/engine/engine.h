// Another renderer, driven through its adapter by the engine protocol (docs/engine-protocol.md).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "experiments/engine/engine_protocol.h"

namespace umbrameter {

class ChildProcess;

/// What an engine wrote for one frame: an image for each output that was wanted, linear.
struct EngineFrame {
  std::vector<Image<vec3>> images;  ///< in the order of the outputs; an image of one channel has it in all three
  double milliseconds = 0.0;        ///< 0: unknown
};

/// Where adapters that are named and not given as a command lie, the first that has it:
/// $UMBRAMETER_ENGINES, $XDG_DATA_HOME/umbrameter/engines, the program's own data.
std::vector<std::filesystem::path> engine_folders();

struct InstalledEngine {
  std::string name;
  std::filesystem::path folder;  ///< empty for our own rasteriser
  bool is_set_up = false;        ///< its setup has run
};
std::vector<InstalledEngine> installed_engines();

/// The command that starts the adapter: words of `adapter`, where quotes group words and nothing else is special, or
/// that of the engine of this name. Throws Error (usage) for no word, a quote that does not end, and an engine whose
/// setup has not run.
std::vector<std::string> engine_command(const std::string& adapter);

/// Time limits, seconds.
struct EngineLimits {
  double describe = 60.0;
  double load = 120.0;
  double render = 60.0;
  double frame = 30.0;  ///< more for each frame of a request
};

/// An adapter that ends, is silent or writes what is no reply is started again once; then, and where it refuses a
/// request, these throw Error (partial), one line. Images are read from a folder of the engine's own, and deleted.
class Engine {
 public:
  explicit Engine(std::string adapter, const EngineLimits& limits = {});
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const EngineDescription& description() const { return description_; }
  /// The engine's defaults.
  EngineParams parameters() const;

  /// The scene as it is, with this view and light alone. Does nothing if that is loaded.
  /// `content` distinguishes scenes.
  void load(const Scene& scene, const std::string& content, const View& view, const Light& light);
  /// Images of the loaded view's size; every value that is not NaN is finite.
  std::vector<EngineFrame> render(const std::vector<std::string>& outputs, std::span<const EngineParams> frames);

  /// As it is loaded: with a finite far plane.
  const View& view() const { return loaded_->view; }

  /// Closes the adapter's stdin; whether it then ended by itself in time. Nothing can be asked of it afterwards.
  bool end();

  /// What the adapter warned of, each once, since the last call.
  std::vector<std::string> take_warnings();
  /// Restarts so far.
  int restarts() const { return restarts_; }

 private:
  struct Folder;
  using Read = std::function<void(const std::string& line, int id)>;
  void start();
  void request(const std::function<std::string(int)>& text, double seconds, const Read& read);
  std::string exchange(const std::function<std::string(int)>& text, double seconds, const Read& read);
  void warn(const std::vector<std::string>& warnings);
  Image<vec3> read_image(const std::string& name) const;

  std::string adapter_;
  EngineLimits limits_;
  std::vector<std::string> command_;
  std::unique_ptr<Folder> folder_;
  std::unique_ptr<ChildProcess> process_;
  EngineDescription description_;
  std::optional<EngineLoad> loaded_;
  std::string loaded_key_;
  std::vector<std::string> warnings_, new_warnings_;
  int last_id_ = 0;
  int restarts_ = 0;
};

}  // namespace umbrameter
