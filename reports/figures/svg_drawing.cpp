#include "reports/figures/svg_drawing.h"

#include <cairo-pdf.h>
#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.h"
#include "reports/figures/pdf_images.h"

namespace umbrameter {
namespace {

constexpr double pixels_per_inch = 96.0;  // of CSS
constexpr double points_per_inch = 72.0;
constexpr double max_image_side = 32767.0;  // of an image of cairo's

template <class T>
using Owned = std::unique_ptr<T, void (*)(T*)>;

[[noreturn]] void refuse(const std::string& why) { throw Error(ExitCode::partial, "drawing", why); }

// Takes the error. Its first line: parsers append the place in a line of their own.
[[noreturn]] void refuse(GError* error) {
  const std::string message = error != nullptr ? error->message : "no reason given";
  g_clear_error(&error);
  refuse(message.substr(0, message.find('\n')));
}

void require_drawable(double width, double height) {
  if (width <= max_image_side && height <= max_image_side) return;
  refuse(fmt::format("{:.0f}×{:.0f} pixels are more than {:.0f} along a side", width, height, max_image_side));
}

void require_success(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) refuse(cairo_status_to_string(status));
}

Owned<cairo_t> context_of(const Owned<cairo_surface_t>& surface) {
  return {cairo_create(surface.get()), &cairo_destroy};
}

// Draws the image's marker, where and as large as the image is to be.
void draw_marker(cairo_t* context, std::size_t index, const ImageBelow& image) {
  const ivec2 pixels = marker_size(index);
  const Owned<cairo_surface_t> marker(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels.x, pixels.y),
                                      &cairo_surface_destroy);
  cairo_save(context);
  cairo_translate(context, image.corner.x, image.corner.y);
  cairo_scale(context, double(image.size.x) / pixels.x, double(image.size.y) / pixels.y);
  cairo_set_source_surface(context, marker.get(), 0.0, 0.0);
  cairo_paint(context);
  cairo_restore(context);
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct SvgDrawing::Handle {
  Owned<RsvgHandle> svg{nullptr, [](RsvgHandle* open) { g_object_unref(open); }};
  double width = 0.0;  // px
  double height = 0.0;

  void draw(cairo_t* context, double shown_width, double shown_height) const {
    const RsvgRectangle place{0.0, 0.0, shown_width, shown_height};
    GError* error = nullptr;
    if (rsvg_handle_render_document(svg.get(), context, &place, &error) == 0) refuse(error);
    require_success(cairo_status(context));
  }

  // Over the image, from its top left.
  void draw_over(Image<glm::u8vec3>& image, double shown_width, double shown_height) const {
    std::vector<std::uint32_t> words;  // 0x00RRGGBB, as CAIRO_FORMAT_RGB24 has them
    words.reserve(image.size());
    for (const glm::u8vec3& color : image.pixels) {
      words.push_back(std::uint32_t{color.x} << 16u | std::uint32_t{color.y} << 8u | color.z);
    }
    const Owned<cairo_surface_t> surface(
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(words.data()), CAIRO_FORMAT_RGB24,
                                            image.width, image.height, 4 * image.width),
        &cairo_surface_destroy);
    require_success(cairo_surface_status(surface.get()));
    draw(context_of(surface).get(), shown_width, shown_height);
    cairo_surface_flush(surface.get());
    for (std::size_t i = 0; i < words.size(); ++i) image[i] = {words[i] >> 16u, words[i] >> 8u, words[i]};
  }

  // A rectangle of the viewBox fills the page as preserveAspectRatio has it by default: whole and in the middle.
  void enter_view_box(cairo_t* context) const {
    gboolean has_width = 0, has_height = 0, has_box = 0;
    RsvgLength unused_width{}, unused_height{};
    RsvgRectangle box{};
    rsvg_handle_get_intrinsic_dimensions(svg.get(), &has_width, &unused_width, &has_height, &unused_height, &has_box,
                                         &box);
    if (has_box == 0) return;
    const double scale = std::min(width / box.width, height / box.height);
    cairo_translate(context, 0.5 * (width - scale * box.width), 0.5 * (height - scale * box.height));
    cairo_scale(context, scale, scale);
    cairo_translate(context, -box.x, -box.y);
  }
};

SvgDrawing::SvgDrawing(const std::string& svg) : handle_(std::make_shared<Handle>()) {
  const Owned<GInputStream> stream(
      g_memory_input_stream_new_from_data(svg.data(), static_cast<gssize>(svg.size()), nullptr),
      [](GInputStream* open) { g_object_unref(open); });
  GError* error = nullptr;
  // Without the flag libxml2 refuses texts of more than 10 MB, which an embedded image may have.
  handle_->svg.reset(
      rsvg_handle_new_from_stream_sync(stream.get(), nullptr, RSVG_HANDLE_FLAG_UNLIMITED, nullptr, &error));
  if (!handle_->svg) refuse(error);
  rsvg_handle_set_dpi(handle_->svg.get(), pixels_per_inch);
  if (rsvg_handle_get_intrinsic_size_in_pixels(handle_->svg.get(), &handle_->width, &handle_->height) == 0 ||
      !(handle_->width > 0.0 && handle_->height > 0.0)) {
    refuse("it does not say how large it is");
  }
}

void SvgDrawing::draw_over(Image<glm::u8vec3>& image) const {
  require_drawable(image.width, image.height);
  handle_->draw_over(image, image.width, image.height);
}

Image<glm::u8vec3> SvgDrawing::pixels(double zoom) const {
  const double width = zoom * handle_->width;
  const double height = zoom * handle_->height;
  require_drawable(width, height);
  Image<glm::u8vec3> image(static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height)), glm::u8vec3(255));
  handle_->draw_over(image, width, height);
  return image;
}

std::string SvgDrawing::to_pdf(const std::vector<ImageBelow>& images) const {
  constexpr double scale = points_per_inch / pixels_per_inch;
  std::string pdf;
  const Owned<cairo_surface_t> surface(
      cairo_pdf_surface_create_for_stream(&append, &pdf, scale * handle_->width, scale * handle_->height),
      &cairo_surface_destroy);
  cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);  // with_images() wants it
  // Else it is the time of day, and equal drawings are different files.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
  {
    const Owned<cairo_t> context = context_of(surface);
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
    cairo_scale(context.get(), scale, scale);
    cairo_save(context.get());
    handle_->enter_view_box(context.get());
    for (std::size_t i = 0; i < images.size(); ++i) draw_marker(context.get(), i, images[i]);
    cairo_restore(context.get());
    handle_->draw(context.get(), handle_->width, handle_->height);
  }
  cairo_surface_finish(surface.get());
  require_success(cairo_surface_status(surface.get()));
  if (images.empty()) return pdf;
  std::vector<const DeflatedImage*> pictures;
  for (const ImageBelow& image : images) pictures.push_back(image.image);
  return with_images(pdf, pictures);
}

bool has_fonts() {
  const Owned<FcConfig> config(FcInitLoadConfigAndFonts(), &FcConfigDestroy);
  const FcFontSet* fonts = config ? FcConfigGetFonts(config.get(), FcSetSystem) : nullptr;
  return fonts != nullptr && fonts->nfont > 0;
}

}  // namespace umbrameter
