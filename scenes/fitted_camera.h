// The camera of a scene that has none, and a check of those that scenes have.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace umbrameter {

/// Rigid frame whose z axis is `towards_viewer`, its y axis up as far as can be.
dmat4 frame_towards(const dvec3& towards_viewer, const dvec3& origin);

struct FittedCamera {
  Camera camera;
  std::string note;  ///< which view it is, and why it is not the usual one
};

/// A camera from which the scene can be measured, for images of that width by height. Usually it looks from 30 degrees
/// beside the front (+Z, glTF 2.0, section 3.4) and 25 degrees above, from where the bounds fill the image. Where that
/// view shows little (nothing, back faces, surfaces that no light faces, a plane with a small thing on it, a room from
/// outside), others are judged by what they show (view_content.h): from around, above and (without a ground) below, of
/// all or of the part with most detail, and from inside a closed room. The first that shows about as much as the best
/// is taken; the usual one wherever it shows half as much. The same scene gives the same camera.
FittedCamera fit_camera(const Scene& scene, double aspect);

/// A line for a camera that looks through back faces in most of its image, as inside an object, or whose near plane
/// cuts surfaces away; empty for others. Within a room the nearest surfaces turn their fronts to the camera.
std::string camera_remark(const Scene& scene, const Camera& camera, double aspect);

}  // namespace umbrameter
