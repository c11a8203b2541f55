#include "wavefront/focus.h"

#include "wavefront/reference_parts.h"

namespace yat {

void focus_camera(Scene& scene) {
  if (!scene.autofocus) return;
  CameraView& camera = scene.camera;
  const reference::RaySegment ray = reference::camera_segment(
      camera, CameraKind::kPinhole, .5 * scene.film.width, .5 * scene.film.height, 0, 0);
  const auto hit = reference::nearest(scene, ray);
  if (!hit) return;
  const reference::Vec way =
      hit->position - reference::Vec(camera.origin[0], camera.origin[1], camera.origin[2]);
  camera.focal_distance =
      float(glm::dot(way, reference::Vec(camera.forward[0], camera.forward[1], camera.forward[2])));
}

}  // namespace yat
