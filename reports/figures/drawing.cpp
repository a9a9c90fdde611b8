#include "reports/figures/drawing.h"

#include "core/error.h"
#include "reports/files/output.h"

namespace umbrameter {

Filter conversion(const std::string& svg, const char* format, const char* zoom) {
  // SOURCE_DATE_EPOCH: the PDF's date, so that equal drawings are equal files.
  return {{"rsvg-convert", "--unlimited", "--format", format, "--zoom", zoom}, {"SOURCE_DATE_EPOCH=0"}, svg};
}

std::string with_package(const std::string& problem, const char* program, const char* package) {
  const std::string start = std::string("cannot run ") + program + ":";
  return problem.rfind(start, 0) == 0 ? problem + "; install " + package : problem;
}

void require_drawing_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".svg" || extension == ".png" || extension == ".pdf") return;
  throw Error(ExitCode::usage, path.string(), "unknown file type", "end its name in .png, .svg or .pdf");
}

void write_drawing(const std::filesystem::path& path, const std::string& svg) {
  require_drawing_name(path);
  const std::string format = path.extension().string().substr(1);
  if (format == "svg") return write_text(path, svg);
  const FilterResult result = run_filters({conversion(svg, format.c_str(), "1")}, 1).front();
  if (!result.problem.empty()) {
    throw Error(ExitCode::partial, "cannot write " + path.string(),
                with_package(result.problem, "rsvg-convert", "librsvg2-bin"));
  }
  write_text(path, result.output);
}

}  // namespace umbrameter
