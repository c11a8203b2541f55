#pragma once
// Matrices of the transform directives (lxs 2.1, 2.2, 3.1). Column vectors; frames right-handed.

#include <optional>
#include <span>
#include <string>

#include "scene/description.h"

namespace yat {

Matrix translation(double x, double y, double z);
Matrix scaling(double x, double y, double z);
/// About the axis, right-handed. Nothing if the axis has no direction.
std::optional<Matrix> rotation(double degrees, double x, double y, double z);
/// YART's Rotate: components are cut to integers; for each that is not 0 a turn by +degrees about
/// its axis, x first, then y, then z (lxs 12.2). Nothing if all are 0.
std::optional<Matrix> yart_rotation(double degrees, double x, double y, double z);

struct LookAtResult {
  Matrix world_to_camera;  ///< camera: +x right, +y up, +z viewing direction
  std::string trouble;     ///< why the numbers could not be used as they are; empty if they could
};
/// From `numbers` = eye, point looked at, up.
LookAtResult look_at(std::span<const double, 9> numbers);

/// 16 numbers, column by column.
Matrix from_columns(std::span<const double, 16> numbers);

bool is_finite(const Matrix& matrix);

}  // namespace yat
