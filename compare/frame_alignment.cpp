#include "compare/frame_alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/frame_fit.h"
#include "core/lists.h"

namespace umbrameter {
namespace {

/// What a remedy must reach: another one than the right one fits by chance on flat scenes, but on few pixels.
constexpr double least_gain = 4.0;

std::string unit_text(double metres) {
  const std::pair<double, const char*> known[] = {{0.01, "cm"}, {0.001, "mm"}, {0.0254, "inches"}, {0.3048, "feet"}};
  for (const auto& [size, name] : known) {
    if (metres == size) return fmt::format("{:g} ({} instead of m)", metres, name);
  }
  return fmt::format("{:.6g}", metres);
}

std::string axes_text(const Remedy& remedy) {
  const auto is = [&](std::array<int, 3> axis, std::array<double, 3> sign) {
    return remedy.axis == axis && remedy.sign == sign;
  };
  if (is({0, 1, 2}, {1, 1, 1})) return {};
  if (is({0, 2, 1}, {1, 1, -1})) return "Z points up";
  if (is({0, 1, 2}, {1, 1, -1})) return "the axes are left-handed: z is negated";
  if (is({0, 1, 2}, {-1, 1, 1})) return "the axes are left-handed: x is negated";
  if (is({0, 2, 1}, {1, 1, 1})) return "Z points up and the axes are left-handed";
  std::string text = "as now read, its ";
  constexpr std::string_view names = "xyz";
  for (std::size_t c = 0; c < 3; ++c) {
    text += (c > 0 ? ", " : "") + std::string(remedy.sign[c] < 0.0 ? "−" : "") +
            names[static_cast<std::size_t>(remedy.axis[c])];
  }
  return text + " are our x, y, z";
}

std::string remedy_text(const Remedy& remedy, bool has_positions, DepthConvention given) {
  std::vector<std::string> parts;
  if (remedy.flips_y) parts.push_back("its rows run the other way");
  if (remedy.flips_x) parts.push_back("left and right are exchanged");
  if (const std::string axes = axes_text(remedy); has_positions && !axes.empty()) parts.push_back(axes);
  if (!has_positions && remedy.convention != given) {
    parts.push_back("its depth is '" + std::string(depth_conventions[static_cast<std::size_t>(remedy.convention)]) +
                    "'");
  }
  if (remedy.scale != 1.0) parts.push_back(fmt::format("its lengths are multiplied by {}", unit_text(remedy.scale)));
  if (glm::length(remedy.shift) > most_shift) {
    parts.push_back(fmt::format("it is shifted by ({:.2f}, {:.2f}) px", remedy.shift.x, remedy.shift.y));
  }
  return joined(parts, ", and ");
}

// Every way to name the axes, the usual ones first.
std::vector<Remedy> axis_remedies() {
  std::vector<Remedy> all;
  std::array<int, 3> axis{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Remedy remedy;
      remedy.axis = axis;
      for (std::size_t c = 0; c < 3; ++c) remedy.sign[c] = (signs >> c & 1) != 0 ? -1.0 : 1.0;
      all.push_back(remedy);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return all;
}

std::vector<Remedy> all_remedies(const Fit& fit, DepthConvention given) {
  std::vector<Remedy> base;
  if (fit.has_positions()) {
    base = axis_remedies();
  } else {
    for (std::size_t c = 0; c < depth_conventions.size(); ++c) {
      Remedy remedy;
      remedy.convention =
          static_cast<DepthConvention>((static_cast<std::size_t>(given) + c) % depth_conventions.size());
      base.push_back(remedy);
    }
  }
  std::vector<Remedy> all;
  for (const bool flips_y : {false, true}) {
    for (const bool flips_x : {false, true}) {
      for (Remedy remedy : base) {
        remedy.flips_x = flips_x, remedy.flips_y = flips_y;
        remedy.scale = fit.unit(remedy);
        all.push_back(remedy);
      }
    }
  }
  return all;
}

}  // namespace

bool FrameAlignment::fits() const {
  // An unknown shift is one that changes nothing that is measured.
  return share_unmatched() <= most_unmatched && !(glm::length(shift) > most_shift);
}

Image<vec3> positions_of(const FrameSurfaces& frame, const View& view) {
  if (!frame.position.empty()) return frame.position;
  const Pixels pixels(view, frame);
  Image<vec3> positions(view.width, view.height, vec3(static_cast<float>(not_a_number)));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = vec3(pixels.position_at(i, frame.depth[i], frame.convention));
  }
  return positions;
}

FrameAlignment align_frame(const FrameSurfaces& frame, const GBuffer& gbuffer, const View& view) {
  const Fit fit(frame, gbuffer, view);
  Remedy as_given;
  as_given.convention = frame.convention;
  FrameAlignment alignment;
  for (std::size_t i = 0; i < fit.size(); ++i) {
    const Fit::Match found = fit.match(i, as_given);
    alignment.surfaces += found != Fit::Match::none ? 1u : 0u;
    alignment.unmatched += found == Fit::Match::alone ? 1u : 0u;
  }
  alignment.shift = fit.shift(as_given);
  if (alignment.fits()) return alignment;
  alignment.median_error = fit.median_error(as_given);

  // Judged within three pixels first, since a shift is known only once the rest is right.
  constexpr double coarse = 3.0;
  const double before = std::max(alignment.share_unmatched(), most_unmatched);
  Remedy best = as_given;
  double least = infinite;
  for (Remedy remedy : all_remedies(fit, frame.convention)) {
    if (fit.share_unmatched(remedy, coarse) > 2.0 * most_unmatched) continue;
    const dvec2 shift = fit.shift(remedy);
    if (glm::length(shift) > most_shift) remedy.shift = shift;
    const double unmatched = fit.share_unmatched(remedy);
    if (!(unmatched < least)) continue;
    least = unmatched;
    best = remedy;
  }
  // A shifted frame matches less along silhouettes.
  const double most = glm::length(best.shift) > most_shift ? 2.0 * most_unmatched : most_unmatched;
  if (least <= most && (least * least_gain <= before || glm::length(best.shift) > most_shift)) {
    alignment.remedy = remedy_text(best, fit.has_positions(), frame.convention);
    alignment.unmatched_with_remedy = least;
  }
  return alignment;
}

std::string misfit_text(const FrameAlignment& alignment) {
  const double percent = 100.0 * alignment.share_unmatched();
  std::string text = fmt::format("{:.3g} % of its pixels show no surface of the scene where it lies", percent);
  if (std::isfinite(alignment.median_error)) {
    text += fmt::format(" (median error {:.3g} px)", alignment.median_error);
  } else {
    text += " (most lie behind the camera, or nowhere)";
  }
  if (percent <= 100.0 * most_unmatched) {
    text = fmt::format("its surfaces are shifted by ({:.2f}, {:.2f}) px", alignment.shift.x, alignment.shift.y);
  }
  if (alignment.remedy.empty() && alignment.median_error < partner_distance) {
    return text +
           "; the camera is right: meshes are missing or others, or most pixels are silhouettes: add a larger --size";
  }
  if (alignment.remedy.empty()) {
    return text + "; no usual convention would make it fit: compare the matrix and the field of view of its camera";
  }
  return text + fmt::format("; it would fit ({:.3g} % unmatched) if {}", 100.0 * alignment.unmatched_with_remedy,
                            alignment.remedy);
}

GBuffer surfels_of_frame(const FrameSurfaces& frame, const GBuffer& gbuffer, const View& view) {
  const Fit fit(frame, gbuffer, view);
  Remedy as_given;
  as_given.convention = frame.convention;
  GBuffer surfels(gbuffer.width, gbuffer.height);
  for (std::size_t i = 0; i < fit.size(); ++i) {
    if (!gbuffer.is_surface(i) || fit.match(i, as_given) != Fit::Match::partner) continue;
    const dvec3 ours(gbuffer.position[i]);
    const dvec3 normal(gbuffer.geometric_normal[i]);
    const dvec3 theirs = fit.position(i, as_given);
    surfels.instance[i] = gbuffer.instance[i];
    surfels.triangle[i] = gbuffer.triangle[i];
    // A frame that agrees to the bit keeps its bits.
    const double off = glm::dot(theirs - ours, normal);
    surfels.position[i] = theirs == ours ? gbuffer.position[i] : vec3(theirs - off * normal);
    surfels.geometric_normal[i] = gbuffer.geometric_normal[i];
    surfels.shading_normal[i] = gbuffer.shading_normal[i];
    surfels.albedo[i] = gbuffer.albedo[i];
    surfels.metallic[i] = gbuffer.metallic[i];
    surfels.specular[i] = gbuffer.specular[i];
    surfels.depth[i] = gbuffer.depth[i];
  }
  return surfels;
}

}  // namespace umbrameter
