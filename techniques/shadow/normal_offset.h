// Normal offsets: receivers move outwards along their normals before the look-up, casters inwards when the map is
// drawn.
#pragma once

#include <array>
#include <string_view>

namespace umbrameter {

/// What a normal offset is multiplied by; θ is the angle between the normal and the direction to the light.
/// sine: sin θ, constant: 1, one_minus_cosine: 1 − max(cos θ, 0), eevee: sin θ + eevee_share.
enum class OffsetProfile : int { sine, constant, one_minus_cosine, eevee };

/// Blender's shadow_normal_offset() adds 0.195 to sin θ / cos 0.534: 0.195 · cos 0.534. (eevee_shadow_tracing_lib.glsl
/// at 0882a98.)
inline constexpr double eevee_share = 0.16785171781851177;

/// normal: along the normal; across: only the part of that which is perpendicular to the direction to the light.
enum class OffsetDirection : int { normal, across };

/// Which normal a double-sided face has where its back is seen: viewer: turned to the viewer, front: that of its front,
/// as in engines that offset in the vertex shader.
enum class OffsetFacing : int { viewer, front };

/// The texel that a normal offset in texels means: at the receiver, or in the middle of a warped map for all receivers.
enum class OffsetTexel : int { receiver, middle };

inline constexpr std::array<std::string_view, 4> offset_profile_names{"sine", "constant", "one-minus-cosine", "eevee"};

/// (texels · texel size + metres) · profile, in metres.
struct NormalOffset {
  double texels = 0.0;
  double metres = 0.0;
  OffsetProfile profile = OffsetProfile::sine;
};

inline bool is_none(const NormalOffset& offset) { return offset.texels == 0.0 && offset.metres == 0.0; }

}  // namespace umbrameter
