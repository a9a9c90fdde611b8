#include "reports/figures/drawing.h"

#include "core/error.h"
#include "reports/figures/svg_drawing.h"
#include "reports/files/output.h"
#include "reports/files/png.h"

namespace umbrameter {

void require_drawing_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".svg" || extension == ".png" || extension == ".pdf") return;
  throw Error(ExitCode::usage, path.string(), "unknown file type", "end its name in .png, .svg or .pdf");
}

void write_drawing(const std::filesystem::path& path, const std::string& svg) {
  require_drawing_name(path);
  if (path.extension() == ".svg") return write_text(path, svg);
  std::string bytes;
  try {
    const SvgDrawing drawing(svg);
    bytes = path.extension() == ".pdf" ? drawing.to_pdf() : to_png(drawing.pixels(1.0));
  } catch (const Error& error) {
    throw Error(ExitCode::partial, "cannot write " + path.string(), error.what());
  }
  write_text(path, bytes);
}

}  // namespace umbrameter
