// Classifies a wrong tap by cause: Cause of techniques/shadow/causes.h.
#include "shadow_filter.glsl"
#include "same_surface.glsl"

// The cause of a tap that is lit where the truth is blocked, or blocked where the truth is lit. The cause does not
// depend on the bias.
int cause_of(Tap tap, bool is_lit_in_truth, Receiver receiver, uvec2 id, Facet own) {
  // The bias can only remove the shadow of a sample that is nearer to the light than the receiver.
  bool is_other_surface = tap.has_blocker && (is_lit_in_truth || tap.critical_bias > 0.0) &&
                    !is_same_surface(receiver, id, own, tap.texel, texelFetch(shadow_ids, tap.texel, 0).rg);
  if (is_lit_in_truth) return is_other_surface ? CAUSE_FALSE_OCCLUSION : CAUSE_ACNE;
  return is_other_surface ? CAUSE_PETER_PANNING : CAUSE_LIGHT_LEAK;
}
