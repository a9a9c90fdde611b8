// What a sweep measures of its cells, by its axes: the quantity, the columns, and what one pass measures at once.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/sweep_plan.h"
#include "results/measurement.h"

namespace umbrameter {

/// The quantity that a sweep measures.
enum class SweptQuantity { visibility, ao, image };
std::string_view quantity_name(SweptQuantity quantity);   ///< as in run.measure: "ao"
std::string_view quantity_title(SweptQuantity quantity);  ///< for sentences: "ambient occlusion"
SweptQuantity quantity_of(const CellStatistics& statistics);

/// Whether an axis varies a parameter whose name begins with `group`: "ao.", "view.scene".
bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group);

/// Whether an axis varies how hard shadows are blurred: the filter, or the technique. Without a filter, PCF and PCSS of
/// a light without extent are the same. `parameters` are of the experiment.
bool varies_filter(const std::vector<SweepAxis>& axes, const Parameters& parameters);
/// Whether an axis varies the reach of the filter, while the constant bias stays the same.
bool needs_biases(const std::vector<SweepAxis>& axes);

/// Whether the parameter changes the reference: the size of a light is not there to be optimised.
bool changes_reference(std::string_view key);

/// Whether an axis changes which pixels or which reference an error is of, so that errors along it cannot be compared.
bool varies_reference(const std::vector<SweepAxis>& axes);

/// The quantity that the axes affect, unless `given` selects one. Throws Error (usage) if they vary
/// both shadows and AO.
SweptQuantity choose_quantity(SweepMeasure given, const std::vector<SweepAxis>& axes);

inline constexpr std::string_view ao_bias_key = "ao.bias";
inline constexpr std::string_view ao_samples_key = "ao.samples";
inline constexpr std::string_view ao_intensity_key = "ao.intensity";
inline constexpr std::string_view ao_power_key = "ao.power";

/// The experiment with these values of the axes.
Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values);

/// Calls take() for one experiment of each combination of the axes' words and truth values, which select techniques.
void for_each_technique(const Experiment& experiment, const std::vector<SweepAxis>& axes,
                        const std::function<void(const Experiment&)>& take);

/// Whether one pass measures every bias, intensity and power: the technique's samples flip at the bias, and no blur
/// or upsampling follows it.
bool is_ao_one_pass(const AoParams& params);

/// The image metrics of each cell, which run.metrics names and the statistics lack. They need the image of each cell.
std::vector<MetricColumn> swept_metrics(const Experiment& experiment, const CellStatistics& statistics);

/// The measured columns of a cell: its statistics, then its image metrics.
std::vector<Column> measured_columns(const Experiment& experiment, CellStatistics statistics);
/// A row with these columns, of values 0.
std::vector<Value> sample_row(const Experiment& experiment, CellStatistics statistics);

/// The parameters whose combinations form a group of cells. Shadows: the biases. Ambient occlusion: what one pass
/// measures, or none if the technique, in any cell, measures each cell alone.
InnerKeys inner_keys(const Experiment& experiment, const std::vector<SweepAxis>& axes, SweptQuantity quantity);

}  // namespace umbrameter
