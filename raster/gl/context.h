// A headless OpenGL 4.5 core context through EGL: no window, no display, no surface. Software or a GPU.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "raster/gl/objects.h"
#include "raster/gl/program.h"

namespace umbrameter {

/// One way to a context, as `info` lists them.
struct GlDevice {
  int index = 0;
  std::string name;      ///< "/dev/dri/card0", "software", "surfaceless"
  std::string vendor;    ///< what the driver says of itself; empty where no context could be made
  std::string renderer;  ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;   ///< "4.5 (Core Profile) Mesa 22.3.6"
  bool software = false;
};

/// All devices on which an OpenGL 4.5 core context can be made. Empty, never an error, where there is none.
/// Makes and destroys a context on each: call it while no Context of this thread is in use, and after
/// Context::make() where ContextOptions::threads counts.
std::vector<GlDevice> list_gl_devices();

namespace gl {

struct ContextOptions {
  std::string device;  ///< index, part of a name ("nvidia", "llvmpipe") or "software"; empty: the first that works
  int threads = 0;     ///< of the software rasteriser; 0: the number of cores. The first context of a process decides
};

/// The context, current on the thread that made it, and the programs built so far. One thread only; objects made in
/// it must be destroyed before it.
class Context {
 public:
  /// Throws Error (no_backend) when no device gives an OpenGL 4.5 core context, saying which were tried and why not.
  static Context make(const ContextOptions& options = {});
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  const GlDevice& device() const;
  const std::string& note() const;         ///< what its user should know, one line; empty if nothing
  int max_texture_size() const;            ///< texels along a side
  std::size_t max_storage_bytes() const;   ///< of one shader storage buffer
  std::size_t max_buffer_texels() const;   ///< of one buffer texture
  std::size_t memory_limit_bytes() const;  ///< what one set of textures may take: the machine's memory in software

  /// Throws Error (no_backend) with the driver's messages when any command since the last check failed.
  void check(const char* pass) const;

  /// Starts what was dispatched so far.
  void flush() const;

  /// Built on first use, then kept.
  const LinkedProgram& program(const ProgramSource& source) const;

 private:
  struct State;
  explicit Context(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace gl
}  // namespace umbrameter
