// The error of hemisphere SSAO at every bias, number of samples and tone of some axes, from one pass.
#pragma once

#include <span>
#include <vector>

#include "compare/ao.h"
#include "compare/error_sums.h"
#include "techniques/ao/bias_response.h"

namespace umbrameter {

/// Adds up what each pixel contributes to each cell. A pixel changes between neighbouring biases only where one of its
/// samples flips; only these changes are stored, and their sums over the axis give the cells.
class AoResponse {
 public:
  /// Truth and G-buffer must outlive it.
  AoResponse(const SampledImage& truth, const GBuffer& gbuffer, AoAxes axes);

  /// Each row of the image once, in ascending order.
  void add(std::span<const AoResponseRow> rows);

  /// One for each combination, the tone fastest, then the number of samples. Equal to analyze_ao() of the image but for
  /// the rounding of sums; too_dark, too_bright, max_x and max_y are not computed.
  std::vector<AoStatistics> statistics() const;

 private:
  // The cells' sums over a fixed part of the rows, so that they do not depend on the number of threads.
  struct Part {
    std::vector<double> changes;  // [samples][bias][quantity][tone]: from the bias before, or from an open pixel
    std::vector<double> largest;  // [samples][tone][bias] absolute error
    std::vector<double> floor;    // [samples][tone] the least of these
    double largest_open = 0.0;    // of pixels that no sample occludes
    ErrorSums open;               // as if no sample occluded any pixel
  };
  // What a pixel adds in this run of biases and in the one before: [quantity][tone].
  struct Scratch {
    std::vector<float> tones;
    std::vector<double> now;
    std::vector<double> last;
    std::vector<double> errors;  // [tone], absolute
  };
  struct Pixel;
  void add_row(Part& part, const AoResponseRow& row) const;
  void add_pixel(Part& part, const Pixel& pixel, std::size_t samples, Scratch& scratch) const;
  void raise_largest(Part& part, std::size_t samples, std::size_t tone, std::size_t begin, std::size_t end,
                     double error) const;

  const SampledImage truth_;
  const GBuffer& gbuffer_;
  AoAxes axes_;
  double noise_reach_ = 0.0;
  std::vector<std::vector<float>> counted_tones_;  // [samples][sum of whole weights, tone]
  std::vector<Part> parts_;
};

}  // namespace umbrameter
