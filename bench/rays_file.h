#pragma once
// Recorded rays in a file. Little-endian; nothing is aligned or padded:
//
//   8 bytes   "YATRAYS1"
//   uint32    sets
//   uint32    bytes of the scene's name (at most 255)
//   uint64    triangles
//   bytes     name
//   9 floats  per triangle: its corners, in the frame of the rays
//   per set:
//     uint32    bytes of its name (1 to 255)
//     uint32    1: shadow rays, segments from the origin along `dir`, t in (0, 1); 0: closest hits
//     uint64    rays
//     bytes     name ("camera", "shadow 1", ...)
//     7 floats  per ray: origin, direction (a unit vector for closest hits), t_max

#include <string>
#include <string_view>

#include "record_scene.h"

namespace yat::bench {

/// The bytes of a file.
std::string encode_rays(const Recording& recording);

/// Throws Error "file: error: what, what to do" for anything that encode_rays did not write: counts
/// are held against the size before memory is taken. `name` is shown in messages.
Recording decode_rays(std::string_view bytes, const std::string& name);

/// Reads a file. Throws Error as above, also where it cannot be read.
Recording read_rays(const std::string& file);

/// Writes it whole or not at all. Throws ResourceError.
void write_rays(const std::string& file, const Recording& recording);

}  // namespace yat::bench
