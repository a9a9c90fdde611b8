#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "present/presentation_parts.h"
#include "present/scene_report.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_casters = 12;  // that the page lists

constexpr std::string_view units_note =
    "Metres are straight lines in the scene; texels count only the part perpendicular to the light. Each "
    "column is computed by itself: the largest distance in texels and that in metres may be of different pixels.";

constexpr std::array<std::string_view, 2> soft_titles = {"too dark", "too bright"};

std::string_view title_of(const ErrorShape& shape, std::size_t part) {
  return shape.components ? cause_title(static_cast<Cause>(part)) : soft_titles[part];
}

Table distance_table(const ErrorShape& shape) {
  Table table;
  table.columns = {{"error", "", "part of the error"}};
  for (const auto& [unit, where] :
       {std::pair{"texels", "perpendicular to the light"}, {"px", "in pixels"}, {"m", "in the scene"}}) {
    for (const char* which : {"median", "95th percentile", "largest"}) {
      table.columns.push_back(
          {which, unit,
           fmt::format("distance, measured {}, to the edge of the hard shadow that is nearest in the image", where)});
    }
  }
  table.columns.push_back({"within 1 texel", "%", "share of this error at most one texel from an edge"});
  table.columns.push_back({"within 2 texels", "%", "share of this error at most two texels from an edge"});
  const auto add = [&](std::string_view part, const EdgeDistances& distances) {
    if (!distances.texels) return;
    std::vector<Value> row = {std::string(part)};
    for (const Spread* spread : {&*distances.texels, &*distances.pixels, &*distances.metres}) {
      for (const double value : {spread->median, spread->upper, spread->largest}) {
        row.emplace_back(digits_text(value));
      }
    }
    for (const std::size_t reach : {one_texel, two_texels}) {
      row.emplace_back(share_text(distances.within[reach]));
    }
    table.rows.push_back(std::move(row));
  };
  add("all", shape.all);
  for (std::size_t p = 0; p < shape.parts.size(); ++p) add(title_of(shape, p), shape.parts[p]);
  return table;
}

std::string edges_text(const ErrorShape& shape, bool has_extent) {
  std::string text = fmt::format(
      "\n\nThe hard shadow of the light's centre has {} edges: pairs of adjacent pixels on one surface, one lit and "
      "one "
      "blocked.",
      grouped(shape.edges));
  if (shape.outside_penumbra) {
    text += fmt::format(
        " {} of the error counts as outside the {}. Where the reference is V, from 0 (blocked) to 1 (lit), "
        "4V(1 − V) of a pixel's error counts as inside: all of it at ½, none at 0 and 1.",
        percent(*shape.outside_penumbra), has_extent ? "penumbra" : "partly lit pixels");
    if (has_extent) {
      text +=
          " So a third of an error that is spread evenly over a penumbra counts as outside, if V changes linearly in "
          "it.";
    }
  }
  return text;
}

Table component_table(const ErrorShape& shape) {
  Table table{{{"wrong pixels", "", "regions of wrong pixels that touch at a side or corner"},
               {"regions", "1", "number of regions"},
               {"mean area", "px", "mean pixels per region"},
               {"largest", "px", "pixels of the largest region"},
               {"share of largest", "%", "share of the error in the largest region"},
               {"centre of largest, x", "px", "of the largest region"},
               {"centre of largest, y", "px", "of the largest region"}},
              {}};
  const auto add = [&](std::string_view name, const ComponentStatistics& s) {
    if (s.count == 0) return;
    table.rows.push_back({std::string(name), static_cast<std::int64_t>(s.count), digits_text(s.mean_area),
                          static_cast<std::int64_t>(s.largest_area), share_text(s.largest_share),
                          fmt::format("{:.1f}", s.largest_x), fmt::format("{:.1f}", s.largest_y)});
  };
  add("all", *shape.components);
  for (std::size_t c = 0; c < cause_count; ++c) add(cause_title(static_cast<Cause>(c)), shape.class_components[c]);
  return table;
}

Table caster_table(const SceneFacts& scene, const std::vector<CasterShape>& casters) {
  std::vector<CasterShape> listed = casters;
  const auto size_of = [](const CasterShape& each) { return each.contacts + each.edges + each.unmatched; };
  std::ranges::stable_sort(listed, std::greater(), size_of);
  if (listed.size() > max_casters) listed.resize(max_casters);
  const std::string gap =
      "length of the lit strip between the foot of the caster and its shadow; not beyond the end of the reference's "
      "shadow; ";
  const std::string inset =
      "how far the outline of the shadow lies inside that of the reference; negative: outside; median of the matched "
      "edges";
  Table table{
      {{"caster", "", "object that casts the shadow; most pixels first"},
       {"contacts", "px",
        "pixels where, in the image, the reference shadow begins beside the caster or a pixel away from it"},
       {"without shadow", "px",
        "contacts where the technique shows none of the reference's shadow; the gap is then as long as that shadow"},
       {"median contact gap", "m", gap + "median"},
       {"median contact gap", "texels", gap + "median of the part perpendicular to the light"},
       {"median contact gap", "px", gap + "median"},
       {"largest gap", "m", gap + "largest"},
       {"matched edges", "px", "edges of the reference shadow near which the technique has one, too"},
       {"without match", "px", "edges of the reference shadow near which the technique has none"},
       {"median shadow inset", "m", inset},
       {"median shadow inset", "texels", inset + ", perpendicular to the light"},
       {"median shadow inset", "px", inset}},
      {}};
  for (const CasterShape& caster : listed) {
    const auto cell = [](bool is_known, double value) { return is_known ? digits_text(value) : "—"; };
    const bool touches = caster.contacts > 0;
    const bool has_edges = caster.edges > 0;
    table.rows.push_back({scene.by_object.names[caster.object], static_cast<std::int64_t>(caster.contacts),
                          static_cast<std::int64_t>(caster.lost), cell(touches, caster.gap_median.metres),
                          cell(touches, caster.gap_median.texels), cell(touches, caster.gap_median.pixels),
                          cell(touches, caster.gap_largest.metres), static_cast<std::int64_t>(caster.edges),
                          static_cast<std::int64_t>(caster.unmatched), cell(has_edges, caster.inset_median.metres),
                          cell(has_edges, caster.inset_median.texels), cell(has_edges, caster.inset_median.pixels)});
  }
  return table;
}

ReportTable caster_report(const SceneFacts& scene, const std::vector<CasterShape>& casters) {
  ReportTable report{"Contact gap and shadow inset by caster", caster_table(scene, casters)};
  report.remarks.emplace_back("Acne does not count as shadow here.");
  report.remarks.emplace_back(units_note);
  if (casters.size() <= max_casters) return report;
  report.title += fmt::format(": the {} of {} with most contacts and edges", max_casters, casters.size());
  const auto farthest = std::ranges::max_element(casters, {}, [](const CasterShape& each) {
    return each.contacts > 0 ? each.gap_largest.metres : -std::numeric_limits<double>::infinity();
  });
  if (farthest->contacts == 0) return report;
  const double gap = farthest->gap_largest.metres;
  const auto with_contacts = std::ranges::count_if(casters, [](const CasterShape& each) { return each.contacts > 0; });
  const std::string which =
      gap > 0.0 ? fmt::format("The largest gap of the {} casters with contacts: {} ({} px), {}", with_contacts,
                              metres_text(gap), digits_text(farthest->gap_largest.pixels),
                              scene.by_object.names[farthest->object])
                : fmt::format("None of the {} casters with contacts has a gap", with_contacts);
  report.remarks.push_back(which + ". A gap is any lit strip between foot and shadow, whatever its cause.");
  return report;
}

Table shimmer_table(const Shimmer& shimmer) {
  Table table{{{"what moved", "", ""}, {"change", "%", "mean change of visibility"}, {"over", "", ""}}, {}};
  const auto add = [&](const char* what, double share, const char* over) {
    table.rows.push_back({std::string(what), share_text(share), std::string(over)});
  };
  add("map's grid", shimmer.grid_mean, "counted pixels; mean of four shifts by a quarter or half a texel");
  add("map's grid, worst", shimmer.grid_largest, "counted pixels; largest of the four shifts");
  add("camera", shimmer.camera.share,
      "counted pixels that see the same triangle; mean of four shifts by a quarter or half a pixel");
  if (shimmer.camera_truth) add("camera, reference", shimmer.camera_truth->share, "the same for the reference");
  return table;
}

PlotFigure distance_figure(const std::string& layer, const std::string& title, const ErrorShape& shape, bool is_soft) {
  PlotFigure figure;
  figure.stem = "edge_distance_" + layer;
  figure.title = "Distance of errors from shadow edges: " + title;
  const char* part = shape.components ? "each cause's error" : "the too dark error, and how much of the too bright,";
  const char* reasons =
      shape.components
          ? "As a rule aliasing lies within one or two texels of an edge, or in the pixels beside it where "
            "texels are smaller than pixels; a filter blurs edges over its width, and acne may lie far from any edge."
      : is_soft
          ? "Errors of a cast penumbra lie no farther from an edge than the penumbra is wide; if it is narrower than a "
            "pixel, they lie in the pixels beside the edge. A filter adds its width. Self-shadowing, light leak and "
            "surfaces that face only a part of the light may err far from any edge."
          : "A filter blurs edges over its width; self-shadowing, light leak and missing shadows may err far from any "
            "edge.";
  figure.caption = fmt::format(
      "How much of {} lies within a distance of a shadow edge. Edges are those of the hard shadow{}; the nearest in "
      "the image counts. {} Where a shadow ends at an object's outline or is thinner than a pixel, the image has no "
      "edge, and errors there count as far from one.",
      part, is_soft ? " of the light's centre" : "", reasons);
  figure.x = {"distance", "distance to the nearest edge [texels]", true};
  figure.y = {"share", "share within the distance [%]", false};
  figure.series = "part";
  figure.series_label = shape.components ? "cause" : "error";
  figure.series_colors = {class_colors().begin() + 1, class_colors().begin() + 5};  // the four causes
  figure.data.columns = {{"part", "", "part of the error"},
                         {"distance", "texels", "perpendicular to the light"},
                         {"share", "%", "share of this error at most that far from an edge"}};
  for (std::size_t p = 0; p < shape.parts.size(); ++p) {
    if (!shape.parts[p].texels) continue;
    for (std::size_t k = 0; k < edge_reaches.size(); ++k) {
      figure.data.rows.push_back({std::string(title_of(shape, p)), edge_reaches[k], 100.0 * shape.parts[p].within[k]});
    }
  }
  return figure;
}

Table view_table(const MapLayout& layout, const std::vector<ViewStatistics>& views) {
  Table table{columns_of(ViewStatistics{}), {}};
  const std::size_t name = column_index(table, "view");
  table.columns[name].meaning = "cascade, face of the cube, or paraboloid";
  for (const ViewStatistics& view : views) {
    if (view.pixels == 0) continue;
    table.rows.push_back(row_of(view));
    table.rows.back()[name] = view_name(layout, view.view);
  }
  return in_percent(table);
}

void add_view_tables(ReportSection& section, const MapLayout& layout, const MapViews& views) {
  if (!views.views.empty()) section.tables.push_back({"Error by view of the map", view_table(layout, views.views)});
  if (views.seams) section.tables.push_back(statistics_table("Seams between the views", *views.seams));
  if (views.shimmer) section.tables.push_back(statistics_table("Shimmer of the fit", *views.shimmer));
}

}  // namespace

void present_shape(Presentation& presentation, const SceneFacts& scene, const ShadowMeasurement& shadow) {
  const ShadowShape& shape = *shadow.shape;
  ReportSection& section = presentation.section;
  section.text += edges_text(shape.error, !extent_text(shadow.emitter).empty());
  section.tables.push_back({"Distance of errors from the edges of the hard shadow", distance_table(shape.error)});
  section.tables.back().remarks.emplace_back(units_note);
  if (shape.error.components && shape.error.components->count > 0) {
    section.tables.push_back({"Connected error regions", component_table(shape.error)});
  }
  const std::string missing = shape.contact_search ? missing_contacts_text(*shape.contact_search) : std::string();
  if (!missing.empty()) section.text += fmt::format("\n\nFor this light {}.", missing);
  if (!shape.casters.empty()) {
    section.tables.push_back(caster_report(scene, shape.casters));
  }
  if (shape.shimmer) section.tables.push_back({"Shimmer", shimmer_table(*shape.shimmer)});
  add_view_tables(section, shadow.layout, shape.views);
  if (shape.error.all.texels) {
    add_figure(presentation, distance_figure(scene.layer(shadow.light), scene.title(shadow.light), shape.error,
                                             !std::holds_alternative<std::monostate>(shadow.emitter)));
  }
}

}  // namespace umbrameter
