#include "raster/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/error.h"
#include "raster/gl/api.h"
#include "raster/gl/shader_cache.h"

namespace umbrameter {
namespace {

constexpr const char* install_remedy =
    "install a driver (Debian: libegl1, libegl-mesa0, libgl1 and libgl1-mesa-dri) or see 'umbrameter info' for the "
    "devices";
constexpr const char* choose_remedy = "choose a device that 'umbrameter info' lists, or omit --gl-device";

struct Candidate {
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string name;
};

bool has_client_extension(const char* extension) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension); }

std::string device_name(EGLDeviceEXT device, int index) {
  // epoxy aborts on an entry point that no driver offers, so the extension string is asked first.
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  const std::string all = extensions != nullptr ? extensions : "";
  if (all.find("EGL_MESA_device_software") != std::string::npos) return "software";
  if (all.find("EGL_EXT_device_drm") != std::string::npos) {
    if (const char* file = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT)) return file;
  }
  return "device " + std::to_string(index);
}

// The handle stays open: epoxy opens the library again.
bool can_open(const char* library) { return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != nullptr; }

// What epoxy opens and, where it is missing, aborts without; empty if all of it is there.
std::string missing_library() {
  if (!can_open("libEGL.so.1")) return "libEGL.so.1";
  return can_open("libOpenGL.so.0") || can_open("libGL.so.1") ? "" : "libGL.so.1";
}

std::vector<Candidate> list_candidates(std::string& why_not) {
  std::vector<Candidate> candidates;
  if (const std::string missing = missing_library(); !missing.empty()) {
    why_not = missing + " cannot be loaded";
    return candidates;
  }
  why_not = "EGL offers no device";
  if (!has_client_extension("EGL_EXT_platform_base")) return candidates;
  const bool can_list =
      has_client_extension("EGL_EXT_device_base") ||
      (has_client_extension("EGL_EXT_device_enumeration") && has_client_extension("EGL_EXT_device_query"));
  if (can_list && has_client_extension("EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE) count = 0;
    for (int i = 0; i < count; ++i) {
      const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      candidates.push_back(
          {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr), device_name(device, i)});
    }
  }
  if (has_client_extension("EGL_MESA_platform_surfaceless")) {
    // EGL_DEFAULT_DISPLAY is the null pointer that this platform asks for.
    candidates.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr), "surfaceless"});
  }
  if (!candidates.empty()) why_not.clear();
  return candidates;
}

struct Opened {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  GlDevice device;
};

// The display is left initialised when a context goes: it belongs to the process, and another context may use it.
void close_context(const Opened& opened) {
  eglMakeCurrent(opened.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(opened.display, opened.context);
}

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  std::string copy;
  for (; text != nullptr && *text != 0; ++text) copy += static_cast<char>(*text);
  return copy;
}

std::optional<Opened> open_context(const Candidate& candidate, int index, std::string& why_not) {
  const auto refuse = [&](const std::string& reason) {
    why_not += (why_not.empty() ? "" : ", ") + candidate.name + ": " + reason;
    return std::nullopt;
  };
  EGLint major = 0;
  EGLint minor = 0;
  if (candidate.display == EGL_NO_DISPLAY || eglInitialize(candidate.display, &major, &minor) == EGL_FALSE) {
    return refuse("does not initialise");
  }
  for (const char* needed : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context", "EGL_KHR_create_context"}) {
    if (!epoxy_has_egl_extension(candidate.display, needed)) return refuse(std::string("lacks ") + needed);
  }
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return refuse("has no OpenGL");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                               4,
                               EGL_CONTEXT_MINOR_VERSION_KHR,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                               EGL_CONTEXT_FLAGS_KHR,
                               EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR,
                               EGL_NONE};
  const EGLConfig no_config = nullptr;
  Opened opened{candidate.display, eglCreateContext(candidate.display, no_config, EGL_NO_CONTEXT, attributes), {}};
  if (opened.context == EGL_NO_CONTEXT) return refuse("has no OpenGL 4.5 core");
  if (eglMakeCurrent(opened.display, EGL_NO_SURFACE, EGL_NO_SURFACE, opened.context) == EGL_FALSE) {
    eglDestroyContext(opened.display, opened.context);
    return refuse("does not make its context current");
  }
  opened.device = {index, candidate.name, text_of(GL_VENDOR), text_of(GL_RENDERER), text_of(GL_VERSION), false};
  const std::string& renderer = opened.device.renderer;
  opened.device.software = candidate.name == "software" || renderer.find("llvmpipe") != std::string::npos ||
                           renderer.find("softpipe") != std::string::npos;
  return opened;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_wanted(const GlDevice& device, const std::string& wanted) {
  if (wanted.empty() || wanted == std::to_string(device.index)) return true;
  if (wanted == "software") return device.software;
  if (wanted.find_first_not_of("0123456789") == std::string::npos) return false;
  const std::string name = lower(wanted);
  return lower(device.name + "\n" + device.vendor + "\n" + device.renderer).find(name) != std::string::npos;
}

}  // namespace

std::vector<GlDevice> list_gl_devices() {
  const gl::ShaderCacheGuard cache;
  std::vector<GlDevice> devices;
  std::string why_not;
  int index = 0;
  for (const Candidate& candidate : list_candidates(why_not)) {
    if (const auto opened = open_context(candidate, index++, why_not)) {
      cache.reserve();
      devices.push_back(opened->device);
      close_context(*opened);
    }
  }
  return devices;
}

namespace gl {

struct Context::State {
  Opened opened;
  std::string note;
  std::string first_error;  // since the last check
  std::map<std::string, LinkedProgram> programs;
  int max_texture_size = 0;
  std::size_t max_storage_bytes = 0;
  std::size_t max_buffer_texels = 0;

  ~State() {
    programs.clear();
    close_context(opened);
  }

  static void GLAPIENTRY on_message(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* message,
                                    const void* user) {
    auto& first_error = static_cast<State*>(const_cast<void*>(user))->first_error;
    if (type != GL_DEBUG_TYPE_ERROR || !first_error.empty()) return;
    first_error = length < 0 ? std::string(message) : std::string(message, static_cast<std::size_t>(length));
  }
};

Context::Context(std::unique_ptr<State> state) : state_(std::move(state)) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

Context Context::make(const ContextOptions& options) {
  if (options.threads > 0) setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
  const ShaderCacheGuard cache;
  std::string why_not;
  std::optional<Opened> opened;
  int index = 0;
  const std::vector<Candidate> candidates = list_candidates(why_not);
  for (const Candidate& candidate : candidates) {
    opened = open_context(candidate, index++, why_not);
    if (!opened) continue;
    if (is_wanted(opened->device, options.device)) break;
    why_not += (why_not.empty() ? "" : ", ") + candidate.name + " is " + opened->device.renderer;
    close_context(*opened);
    opened.reset();
  }
  if (!opened) {
    const std::string wanted = options.device.empty() ? "" : " matching '" + options.device + "'";
    throw Error(ExitCode::no_backend, "OpenGL",
                "no EGL device" + wanted + " gives an OpenGL 4.5 core context (" + why_not + ")",
                options.device.empty() || candidates.empty() ? install_remedy : choose_remedy);
  }
  auto state = std::make_unique<State>();
  state->opened = *opened;
  state->note = cache.note();
  cache.reserve();
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(&State::on_message, state.get());
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &state->max_texture_size);
  GLint64 storage = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage);
  state->max_storage_bytes = static_cast<std::size_t>(storage);
  GLint64 texels = 0;
  glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  state->max_buffer_texels = static_cast<std::size_t>(texels);
  return Context(std::move(state));
}

const GlDevice& Context::device() const { return state_->opened.device; }
const std::string& Context::note() const { return state_->note; }
int Context::max_texture_size() const { return state_->max_texture_size; }
std::size_t Context::max_storage_bytes() const { return state_->max_storage_bytes; }
std::size_t Context::max_buffer_texels() const { return state_->max_buffer_texels; }

std::size_t Context::memory_limit_bytes() const {
  if (!device().software) return std::numeric_limits<std::size_t>::max();
  const auto pages = static_cast<std::size_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  return pages * static_cast<std::size_t>(std::max(1L, sysconf(_SC_PAGESIZE)));
}

void Context::check(const char* pass) const {
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
    if (state_->first_error.empty()) state_->first_error = "error code " + std::to_string(error);
  }
  if (state_->first_error.empty()) return;
  // What follows the first error is mostly its consequence.
  const std::string first = std::exchange(state_->first_error, "");
  throw Error(ExitCode::no_backend, std::string("OpenGL pass '") + pass + "' on " + device().renderer, first,
              "use a smaller size or choose another device with --gl-device");
}

void Context::flush() const { glFlush(); }

const LinkedProgram& Context::program(const ProgramSource& source) const {
  std::string key = source.defines;
  for (const std::string& file : source.files) key += "\n" + file;
  const auto found = state_->programs.find(key);
  if (found != state_->programs.end()) return found->second;
  return state_->programs.emplace(key, make_program(source)).first->second;
}

}  // namespace gl
}  // namespace umbrameter
